#include <sightline/io/read.h>

#include <sightline/io/file.h>
#include <sightline/io/gltf.h>
#include <sightline/io/obj.h>
#include <sightline/io/off.h>
#include <sightline/io/ply.h>
#include <sightline/io/quake_bsp.h>
#include <sightline/io/quake_map.h>
#include <sightline/io/stl.h>
#include <sightline/io/text.h>

#include <limits>

namespace sightline {
std::optional<Format> format_of_content(const Input& input) {
  if (is_stl(input)) return Format::stl;
  if (looks_like_quake_level(input.bytes)) return Format::bsp;
  if (looks_like_glb(input.bytes)) return Format::glb;
  Text_reader text(input, Text_reader::Comments::hash);
  const std::string_view word = text.next_token_of_any_line();
  if (word == "ply") return Format::ply;
  if (word == "{" || word.starts_with("//")) return Format::map;
  if (word.size() < 10 && word.ends_with("OFF")) return Format::off;
  for (const std::string_view statement : {"v", "vt", "vn", "f", "g", "o", "s", "usemtl", "mtllib"})
    if (word == statement) return Format::obj;
  return std::nullopt;
}

/// `neighbour`: as read_gltf() has it.
static Polygon_soup read_beside(std::string_view bytes, Format format, const std::string& name,
                                const Read_options& options, const Gltf_neighbour& neighbour) {
  const Input input{name, bytes};
  if (bytes.find_first_not_of(" \t\v\f\r\n", bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0) ==
      std::string_view::npos)
    input.fail(bytes.data(), "the file is empty; give a scene");
  Polygon_soup soup = [&] {
    switch (format) {
      case Format::obj: return read_obj(input, options);
      case Format::off: return read_off(input, options);
      case Format::qoff: return read_qoff(input, options);
      case Format::stl: return read_stl(input, options);
      case Format::map: return read_map(input, options);
      case Format::bsp: return read_quake_bsp(input);
      case Format::glb: return read_glb(input, options, neighbour);
      case Format::gltf: return read_gltf(input, options, neighbour);
      default: return read_ply(input, options);
    }
  }();
  if (soup.point_count() > std::numeric_limits<Point_id>::max() ||
      soup.face_count() > std::numeric_limits<Face_id>::max())
    throw Input_error::of_file(name, "more points or faces than ids of 32 bits can number; cut the scene into parts");
  soup.file = name;
  return soup;
}

Polygon_soup read_scene(std::string_view bytes, Format format, const std::string& name, const Read_options& options) {
  return read_beside(bytes, format, name, options, {});
}

Polygon_soup read_scene(const std::filesystem::path& path, const Read_options& options) {
  const std::string bytes = read_bytes(path);
  const std::string name = path.string();
  std::optional<Format> format = format_of_ending(path);
  if (!format) format = format_of_content({name, bytes});
  if (!format)
    throw Input_error::of_file(
        name, std::string("neither its ending nor its content is of a known format; give one of ") + supported_formats +
                  ", or of " + read_only_formats);
  return read_beside(bytes, *format, name, options,
                     [&](const std::string& neighbour) { return read_bytes(path.parent_path() / neighbour); });
}

}  // namespace sightline
