#include "drawings.h"

#include "../methods/methods.h"
#include "../support/drawing.h"
#include "../support/page.h"

#include <sightline/harness/generate/transform.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace sightline::app {

Grouped_polygons drawing_of_table(const Level_cells& level, const Visibility_table& table,
                                  const std::vector<Cell_id>& cells) {
  const Scene& scene = level.scene();
  Grouped_polygons polygons;
  const std::uint32_t hidden = polygons.add_group("hidden", drawing_colours::hidden),
                      visible = polygons.add_group("visible", drawing_colours::seen),
                      undecided = polygons.add_group("undecided", drawing_colours::open);
  std::vector<std::uint32_t> groups(scene.counters().faces_read, hidden);
  for (const bool sees : {false, true})
    for (const Cell_id cell : cells)
      for (const Face_id face : sees ? table.row_of(cell)->visible : table.row_of(cell)->undecided)
        groups[face] = sees ? visible : undecided;
  add_pieces(polygons, scene, [&](std::uint32_t piece) { return groups[scene.pieces()[piece].face]; });
  for (const Cell_id cell : cells) {
    const std::uint32_t group = polygons.add_group(fmt::format("cell-{}", cell), drawing_colours::source);
    for (const std::uint32_t w : level.cells()[cell].walls)
      polygons.add_polygon(group, Grouped_polygons::no_face, level.polygon(level.walls()[w].corners));
  }
  return polygons;
}

void draw(const Pvs_arguments& arguments, const Polygon_soup& soup, const Level_cells& level,
          const Visibility_table& table) {
  // 1. The faces of rooms, and what is known of them.
  std::vector<char> seen(soup.face_count(), 0);  // 1: hidden, 2: undecided, 3: visible
  for (Cell_id cell = 0; cell < table.cells.size(); ++cell)
    if (table.cells[cell])
      for (const Face_id face : level.cells()[cell].faces) seen[face] = 1;
  for (const Cell_id cell : arguments.show) {
    for (const Face_id face : table.row_of(cell)->undecided) seen[face] = std::max<char>(seen[face], 2);
    for (const Face_id face : table.row_of(cell)->visible) seen[face] = 3;
  }
  std::vector<Face_id> shown;
  for (Face_id face = 0; face < seen.size(); ++face)
    if (seen[face] != 0) shown.push_back(face);
  const Polygon_soup rooms = generate::with_faces(soup, shown);
  Scene scene(rooms);

  // 2. From above, or from where one asks for, farthest first.
  constexpr double room_for_the_legend = 36;
  const Exact_point eye = eye_of(arguments.eye, scene);
  std::vector<Exact_point> corners;
  for (const Piece& piece : scene.pieces())
    for (const Piece_corner& corner : scene.corners(piece)) corners.push_back(scene.position(corner.point));
  const View view = arguments.view.view(eye, scene, corners, room_for_the_legend);
  Task task;
  task.eye = eye;
  task.bsp.threads = arguments.common.threads;
  task.near = near_plane(view, scene);
  std::vector<Drawn> drawn = run_method("exact", scene, task).drawn;
  std::erase_if(drawn, [](const Drawn& item) { return item.side != CGAL::POSITIVE; });
  Svg svg = empty_picture(view);
  paint(svg, view, drawn, true, [&](const Drawn& item, double shade) {
    const Face_id face = shown[item.fragment.face];
    const auto [hue, strength, light] = seen[face] == 3   ? std::tuple(38, 85, 62)
                                        : seen[face] == 2 ? std::tuple(290, 60, 55)
                                                          : std::tuple(215, 12, 60);
    return Look{fmt::format("hsl({},{}%,{:.0f}%)", hue, strength, light + 14 * shade),
                fmt::format("face {}: {}", face,
                            seen[face] == 3   ? "visible"
                            : seen[face] == 2 ? "undecided"
                                              : "hidden")};
  });

  // 3. The cells that look, in outline.
  for (const Cell_id cell : arguments.show)
    for (const std::uint32_t w : level.cells()[cell].walls) {
      std::vector<Flat_point> outline;
      for (const Exact_point& p : level.polygon(level.walls()[w].corners)) outline.push_back(projected(view, p));
      svg.polygon(std::move(outline), "#d0204020", "#d02040", 1.6, fmt::format("cell-{}-{}", cell, w),
                  fmt::format("cell {}", cell));
    }
  svg.label(12, 22, 14, "orange: visible, grey: hidden, violet: undecided, red: the cell that looks", "start",
            ink_on(view.background));
  write_file(arguments.svg, svg.text());
}

void write_page(const Pvs_arguments& arguments, const Level_cells& level, const Visibility_table& table) {
  Page page("pvs", level.scene());
  page.add_fact("faces", fmt::format("{}", level.scene().counters().faces));
  page.add_fact("cells", fmt::format("{} of {} are asked about", table.rows.size(), table.cells.size()));
  for (const auto& [name, role] : {std::pair("visible", "seen"), {"hidden", "hidden"}, {"undecided", "open"}})
    page.add_group(name, role);
  page.add_pieces(level.scene());
  std::vector<Cell_id> cells = arguments.show;
  for (Cell_id cell = 0; cell < table.cells.size(); ++cell)
    if (table.cells[cell] && std::find(arguments.show.begin(), arguments.show.end(), cell) == arguments.show.end())
      cells.push_back(cell);
  constexpr std::size_t most_bytes = 500000;
  std::size_t bytes = 0;
  Json list = Json::array();
  for (const Cell_id cell : cells) {
    const Visibility_table::Row& row = *table.row_of(cell);
    std::vector<float> ends;  // of the sides of its walls
    for (const std::uint32_t w : level.cells()[cell].walls)
      page.append_sides(ends, level.polygon(level.walls()[w].corners));
    bytes += 160 + 6 * ends.size() + 4 * (row.visible.size() + row.undecided.size());
    if (bytes > most_bytes) {
      page.add_note(fmt::format("{} of {} cells are shown: --show CELL, which may be repeated, chooses", list.size(),
                                cells.size()));
      break;
    }
    list.push_back({{"cell", cell},
                    {"inside", Page::text(level.inside(cell))},
                    {"visible", packed(row.visible)},
                    {"undecided", packed(row.undecided)},
                    {"walls", packed(ends)}});
  }
  page.more()["cells"] = std::move(list);
  std::set<std::uint32_t> rooms;  // the faces that look into one of them
  for (const Cell_id cell : cells) rooms.insert(level.cells()[cell].faces.begin(), level.cells()[cell].faces.end());
  page.more()["rooms"] = packed(std::vector<std::uint32_t>(rooms.begin(), rooms.end()));
  page.write(arguments.html);
}

}  // namespace sightline::app
