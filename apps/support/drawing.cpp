#include "drawing.h"

#include "files.h"

#include <fmt/format.h>

namespace sightline::app {

Option add_mesh_option(Command command, std::string& file, const std::string& what) {
  return command
      .add_option("--mesh", file,
                  fmt::format("write {} for programs that draw: {} with groups and faces' ids", what, drawing_formats))
      .writes_file()
      .check(none_of([](const std::string& name) {
        return drawing_format_of_ending(name) ? std::string()
                                              : fmt::format("{} does not end with one of {}", name, drawing_formats);
      }));
}

void add_pieces(Grouped_polygons& polygons, const Scene& scene,
                const std::function<std::uint32_t(std::uint32_t piece)>& group_of) {
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i)
    polygons.add_polygon(group_of(i), scene.pieces()[i].face, scene.corner_points(scene.pieces()[i]));
}

void write_drawings(const std::string& obj, const std::string& mesh, const Grouped_polygons& polygons) {
  if (!obj.empty()) write_file(obj, drawing_bytes(polygons, Drawing_format::obj));
  if (!mesh.empty()) write_file(mesh, drawing_bytes(polygons, drawing_format_of_ending(mesh).value()));
}

}  // namespace sightline::app
