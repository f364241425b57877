#include <sightline/io/materials.h>

#include <sightline/io/decimal.h>
#include <sightline/io/file.h>
#include <sightline/io/input.h>
#include <sightline/io/text.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace sightline {

namespace {

constexpr std::size_t longest_name = 1000;  // each face gets a copy of it
using Materials = std::map<std::string, Material, std::less<>>;

/// The rest of a line, its words with one blank between them: names may have blanks.
std::string rest_of_line(Text_reader& text) {
  std::string rest;
  for (std::string_view token = text.next_token(); !token.empty(); token = text.next_token())
    (rest += rest.empty() ? "" : " ") += token;
  return rest;
}

double real(const Text_reader& text, std::string_view token) {
  const double value = nearest_double(value_of(parse_decimal(text, token)));
  if (!std::isfinite(value)) text.fail(token, sightline::quoted(token) + " is beyond doubles; write a smaller number");
  return value;
}

void read_colour(Text_reader& text, Material& material) {
  std::string_view token = text.next_token();
  if (token == "spectral" || token == "xyz") return;  // colours of another kind
  for (double& c : material.colour) {
    if (token.empty()) text.fail(token, "a colour has three numbers; write Kd r g b");
    c = real(text, token);
    token = text.next_token();
  }
}

void read_opacity(Text_reader& text, Material& material, bool is_transparency) {
  std::string_view token = text.next_token();
  if (token == "-halo") token = text.next_token();
  const double value = token.empty() ? -1 : real(text, token);
  if (!(value >= 0 && value <= 1)) text.fail(token, "an opacity is a number from 0 to 1; write d 0.5, or Tr 0.5");
  material.opacity = is_transparency ? 1 - value : value;
}

void read_library(const Input& input, Materials& materials) {
  Text_reader text(input, Text_reader::Comments::hash);
  Material* current = nullptr;
  Material repeated;  // of a name that is there already, read and dropped
  while (text.next_line()) {
    const std::string_view statement = text.next_token();
    if (statement == "newmtl") {
      const std::string name = rest_of_line(text);
      if (name.empty()) text.fail(statement, "a material without a name; write newmtl NAME");
      if (name.size() > longest_name) text.fail(statement, "a material's name is longer than 1000 bytes; shorten it");
      const auto [found, is_new] = materials.try_emplace(name, Material{name});
      current = is_new ? &found->second : &repeated;
    } else if (statement == "Kd" || statement == "d" || statement == "Tr") {
      if (current == nullptr)
        text.fail(statement, sightline::quoted(statement) + " before any newmtl; begin with newmtl NAME");
      if (statement == "Kd") read_colour(text, *current);
      else read_opacity(text, *current, statement == "Tr");
    }
  }
}

bool is_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

/// The rest of a line, names with blanks between; one name where there is a file of it, since exporters write names
/// that have blanks.
std::vector<std::string_view> names_of_libraries(Text_reader& text, const std::filesystem::path& folder) {
  std::vector<std::string_view> names;
  for (std::string_view name = text.next_token(); !name.empty(); name = text.next_token()) names.push_back(name);
  if (names.size() < 2) return names;
  const std::string_view all(names.front().data(), names.back().data() + names.back().size());
  if (is_file(folder / std::filesystem::path(all))) return {all};
  return names;
}

}  // namespace

std::vector<std::optional<Material>> read_materials(const std::filesystem::path& obj) {
  const std::string bytes = read_bytes(obj);
  const Input input{obj.string(), bytes};
  Text_reader text(input, Text_reader::Comments::hash, Text_reader::Continuation::backslash);
  Materials materials;
  std::vector<std::optional<Material>> of_faces;
  std::optional<Material> current;
  std::set<std::string, std::less<>> read;  // libraries
  while (text.next_line()) {
    const std::string_view statement = text.next_token();
    if (statement == "mtllib") {
      for (const std::string_view name : names_of_libraries(text, obj.parent_path())) {
        if (!read.emplace(name).second) continue;
        const std::filesystem::path path = obj.parent_path() / std::filesystem::path(name);
        if (!is_file(path))
          text.fail(name,
                    "no file " + sightline::quoted(name) + " beside this one; put the library of materials there");
        const std::string library = read_bytes(path);
        read_library({path.string(), library}, materials);
      }
    } else if (statement == "usemtl") {
      const std::string name = rest_of_line(text);
      const auto found = materials.find(name);
      if (found == materials.end())
        text.fail(statement, "no material " + sightline::quoted(name) +
                                 " in any library so far; name its file with mtllib before");
      current = found->second;
    } else if (statement == "f" || statement == "fo") {
      of_faces.push_back(current);
    }
  }
  return of_faces;
}

}  // namespace sightline
