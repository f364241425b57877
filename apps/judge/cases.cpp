// Cases for judging: the scene as programs get it, and the query.

#include "cases.h"

#include "../support/common.h"
#include "../support/journal.h"
#include "../support/limited_process.h"

#include <sightline/io/file.h>
#include <sightline/io/read.h>
#include <sightline/io/visibility_table.h>

#include <charconv>
#include <filesystem>
#include <fstream>

namespace sightline::app {

namespace {

std::int64_t ulps_of(const std::string& text) {
  if (text == "far") return generate::far_ulps;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw Usage_error("--ulps wants whole numbers or `far`, with commas; '" + text + "' is none");
  return value;
}

/// So many ulps of the scene's size, askew to the axes.
Exact_point askew(const Polygon_soup& scene, std::int64_t ulps) {
  const Rational by = generate::ulps_of_size(ulps, generate::size_bits(scene));
  return {by * 3, by * -2, by};
}

namespace fs = std::filesystem;

/// The query of a file, as programs get it.
judge::Query query_of(const std::string& file, judge::Question question) {
  judge::Query query;
  try {
    const std::string text = read_input(file);
    query = judge::query_from_json(parse_json(text, file));
    judge::check_integers(text);
  } catch (const std::invalid_argument& error) {
    throw Input_error::of_file(file, "no query: " + printable(error.what(), 400, true) + "; write it as --keep does");
  }
  if (query.question != question) throw Usage_error("--ask " + file + ": another question than is asked here");
  return query;
}

std::vector<Case_group> groups_of_scenes(const Case_choice& choice, const Case_options& options) {
  if (!fs::exists(choice.scenes))
    throw Input_error::of_file(choice.scenes, "there is no such folder or file; check the path");
  std::vector<fs::path> files;
  if (fs::is_directory(choice.scenes)) {
    for (const auto& entry : fs::recursive_directory_iterator(choice.scenes))
      if (entry.is_regular_file() && format_of_ending(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    if (files.empty())
      throw Input_error::of_file(choice.scenes,
                                 std::string("the folder holds no scene; give one with ") + supported_formats);
  } else {
    files.push_back(choice.scenes);
  }
  std::optional<judge::Query> query;
  if (!choice.ask.empty()) query = query_of(choice.ask, options.question);
  std::vector<Case_group> groups;
  for (const fs::path& file : files) {
    will_be_read(file);  // whatever is written before that
    const auto make = [file, query, options](std::uint64_t seed) {
      return query ? case_of(read_scene(file), *query, options) : case_of(read_scene(file), seed, options);
    };
    groups.push_back({file.filename().string(), "-",
                      "--scenes " + shell_word(file.string()) + (query ? " --ask " + shell_word(choice.ask) : ""), make,
                      0, "as it is given",
                      [make, options](std::uint64_t seed, std::int64_t ulps) {
                        const Judge_case given = make(seed);
                        if (!given.not_asked.empty()) return given;
                        return judge::moved(given, askew(given.soup, ulps), options);
                      },
                      file.string()});
  }
  return groups;
}

std::vector<Case_group> groups_of_families(const Case_choice& choice, const Case_options& options) {
  std::vector<std::string> names = choice.families;
  if (names.empty())
    for (const generate::Family& family : generate::families())
      if (!family.holes) names.push_back(family.name);  // programs get files
  std::vector<Case_group> groups;
  for (const std::string& name : names)
    for (const std::string& distance : choice.ulps) {
      generate::Family_parameters parameters;
      parameters.ulps = ulps_of(distance);
      const generate::Family* family = nullptr;
      try {
        family = &generate::family(name);
      } catch (const std::invalid_argument& error) {
        throw Usage_error(std::string("--families: ") + error.what());
      }
      parameters.size = choice.size > 0 ? choice.size : family->small_size;
      const auto make = [family, parameters, options](std::uint64_t seed) mutable {
        parameters.seed = seed;
        return case_of(*family, parameters, options);
      };
      groups.push_back({name,
                        distance == "far"      ? "far"
                        : parameters.ulps == 0 ? "exact"
                                               : fmt::format("{:+} ulps", parameters.ulps),
                        fmt::format("--families {} --ulps {}{}", shell_word(name), distance,
                                    choice.size > 0 ? fmt::format(" --size {}", choice.size) : ""),
                        make, parameters.ulps, "exactly degenerate",
                        [family, parameters, options](std::uint64_t seed, std::int64_t ulps) mutable {
                          parameters.seed = seed;
                          parameters.ulps = ulps;
                          return case_of(*family, parameters, options);
                        },
                        ""});
    }
  return groups;
}

}  // namespace

std::string identity(const Case_group& group) {
  if (group.file.empty()) return group.family + ' ' + group.distance;
  std::string of = group.family + ' ' + content_hash(group.file);
  if (format_of_ending(group.file) == Format::gltf)  // its corners may be in other files
    of += fmt::format(" {:016x}", fingerprint(read_scene(group.file)));
  return of;
}

std::vector<Case_group> groups_of(const Case_choice& choice, const Case_options& options) {
  return choice.scenes.empty() ? groups_of_families(choice, options) : groups_of_scenes(choice, options);
}

}  // namespace sightline::app
