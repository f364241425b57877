#include <sightline/io/write.h>

#include <sightline/io/exact_text.h>
#include <sightline/io/file.h>
#include <sightline/io/obj.h>
#include <sightline/io/off.h>
#include <sightline/io/ply.h>
#include <sightline/io/stl.h>

#include <optional>
#include <sstream>
#include <stdexcept>

namespace sightline {

void write_scene(const Polygon_soup& soup, std::ostream& out, Format format) {
  soup.check_corners();
  switch (format) {
    case Format::obj: return write_obj(soup, out);
    case Format::off: return write_off(soup, out);
    case Format::qoff: return write_qoff(soup, out);
    case Format::ply: return write_ply(soup, out, false);
    case Format::ply_binary: return write_ply(soup, out, true);
    case Format::stl: return write_stl(soup, out);
    case Format::map:
    case Format::bsp: throw Not_representable("levels are read only; write .qoff, which holds any scene without holes");
    case Format::glb:
    case Format::gltf: throw Not_representable("glTF is read only; write .qoff, which holds any scene without holes");
  }
}

void write_scene(const Polygon_soup& soup, const std::filesystem::path& path, Format format) {
  std::ostringstream out;
  write_scene(soup, out, format);
  write_bytes(path, out.view());
}

void write_scene(const Polygon_soup& soup, const std::filesystem::path& path) {
  const std::optional<Format> format = format_of_ending(path);
  if (!format)
    throw std::runtime_error(path.string() + ": no format has this ending; give one of " + supported_formats);
  write_scene(soup, path, *format);
}

}  // namespace sightline
