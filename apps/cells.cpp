// sightline cells: the convex cells of a level, the walls between them, what is solid, and ways out.

#include "support/cell_file.h"
#include "support/drawing.h"
#include "support/page.h"

#include <sightline/algorithms/levels/cells.h>
#include <sightline/io/input.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace sightline::app {

namespace {

struct Cells_arguments {
  Common common;
  std::vector<std::string> seals;
  std::string out, html, mesh;
  Division_arguments division;
};

/// A point from which there should be no way out.
struct Seal {
  std::string text;
  Exact_point point;
  bool is_entity;  ///< of the file, not of the command line: it may stand in something solid
};

/// The points of --seal; for "entities" those of the level.
std::vector<Seal> seals_of(const Cells_arguments& arguments) {
  std::vector<Seal> seals;
  for (const std::string& text : arguments.seals) {
    if (text != "entities") {
      seals.push_back({text, parse_point(text, "--seal"), false});
      continue;
    }
    std::optional<std::vector<Map_place>> places = places_of(arguments.common);
    if (!places) throw Usage_error("--seal entities: SCENE is no .map or .bsp; give a point X,Y,Z");
    for (Map_place& place : *places)
      seals.push_back({place.name + " at " + Page::text(place.origin), std::move(place.origin), true});
  }
  return seals;
}

/// The faces, and cells to walk through: rooms first, then what has no end, then solids; ways out of --seal.
void write_page(const std::string& file, const Level_cells& level, const std::vector<Seal>& seals,
                const std::vector<std::vector<Cell_id>>& ways) {
  const Cell_counters& c = level.counters();
  Page page("cells", level.scene());
  page.add_fact("faces", fmt::format("{}", level.scene().counters().faces));
  page.add_fact("cells", fmt::format("{}: {} solid, {} without end", c.cells, c.solid, c.outside));
  page.add_fact("portals", fmt::format("{}", c.portals));
  page.add_group("faces", "face");
  page.add_pieces(level.scene());
  static constexpr std::array<const char*, 3> kinds{"room", "without end", "solid"};
  const auto kind_of = [&](Cell_id cell) {
    return level.cells()[cell].is_solid ? 2 : level.cells()[cell].is_outside ? 1 : 0;
  };
  std::vector<Cell_id> cells(level.cells().size());
  std::iota(cells.begin(), cells.end(), 0);
  std::stable_sort(cells.begin(), cells.end(), [&](Cell_id a, Cell_id b) { return kind_of(a) < kind_of(b); });
  constexpr std::size_t most_bytes = 500000;
  std::size_t bytes = 0;
  Json list = Json::array();
  for (const Cell_id cell : cells) {
    std::vector<float> walls, portals;
    std::vector<std::uint32_t> neighbours;
    for (const std::uint32_t w : level.cells()[cell].walls) {
      const Cell_wall& wall = level.walls()[w];
      page.append_sides(walls, level.polygon(wall.corners));
      if (wall.behind == no_cell || level.cells()[wall.front].is_solid || level.cells()[wall.behind].is_solid) continue;
      for (const std::vector<std::uint32_t>& part : wall.open) page.append_sides(portals, level.polygon(part));
      if (!wall.open.empty()) neighbours.push_back(wall.front == cell ? wall.behind : wall.front);
    }
    bytes += 200 + 6 * (walls.size() + portals.size());
    if (bytes > most_bytes) {
      page.add_note(fmt::format("{} of {} cells are shown, rooms first", list.size(), cells.size()));
      break;
    }
    list.push_back({{"cell", cell},
                    {"kind", kinds.at(static_cast<std::size_t>(kind_of(cell)))},
                    {"inside", Page::text(level.inside(cell))},
                    {"faces", packed(level.cells()[cell].faces)},
                    {"walls", packed(walls)},
                    {"portals", packed(portals)},
                    {"neighbours", packed(neighbours)}});
  }
  page.more()["cells"] = std::move(list);
  Json leaks = Json::array();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (ways[i].empty() || ways[i][0] == no_cell) continue;
    std::vector<float> way;
    page.append_place(way, seals[i].point);
    for (const Cell_id cell : ways[i]) page.append_place(way, level.inside(cell));
    leaks.push_back({{"from", seals[i].text}, {"cells", packed(ways[i])}, {"way", packed(way)}});
  }
  page.more()["leaks"] = std::move(leaks);
  page.write(file);
}

/// By cell a colour of those in turn, another one than its neighbours have where there are enough; cells of one region
/// have one. Greedy.
std::vector<std::size_t> colours_of(const Level_cells& level, const std::vector<std::uint32_t>& regions) {
  const auto number_of = [&](Cell_id cell) {
    return regions.empty() || regions[cell] == no_cell ? cell : regions[cell];
  };
  constexpr std::size_t most = drawing_colours::in_turn.size();
  std::vector<std::vector<std::uint32_t>> neighbours(level.cells().size());
  for (const Cell_wall& wall : level.walls()) {
    if (wall.behind == no_cell || level.cells()[wall.front].is_solid || level.cells()[wall.behind].is_solid) continue;
    const std::uint32_t front = number_of(wall.front), behind = number_of(wall.behind);
    if (front == behind) continue;
    neighbours[front].push_back(behind);
    neighbours[behind].push_back(front);
  }
  std::vector<std::size_t> colours(level.cells().size(), most);  // by number; `most`: none yet
  for (std::uint32_t number = 0; number < colours.size(); ++number) {
    std::array<std::size_t, most> taken{};
    for (const std::uint32_t other : neighbours[number])
      if (colours[other] < most) ++taken[colours[other]];
    const std::size_t first = number % most;  // so that all are used
    std::size_t& own = colours[number] = first;
    for (std::size_t k = 0; k < most; ++k)
      if (taken[(first + k) % most] < taken[own]) own = (first + k) % most;
  }
  std::vector<std::size_t> by_cell;
  for (Cell_id cell = 0; cell < level.cells().size(); ++cell) by_cell.push_back(colours[number_of(cell)]);
  return by_cell;
}

/// Cells as polyhedra, each with its own walls, fronts outwards, and what they are within.
Grouped_polygons drawing_of(const Level_cells& level, const Division& division,
                            const std::vector<std::uint32_t>& regions) {
  Grouped_polygons polygons;
  for (std::size_t k = 0; k < drawing_colours::in_turn.size(); ++k)
    polygons.add_group(fmt::format("room-{}", k), drawing_colours::in_turn.at(k));
  const std::uint32_t outside = polygons.add_group("without-end", {205, 212, 222}),
                      solid = polygons.add_group("solid", drawing_colours::hidden);
  const std::vector<std::size_t> colours = colours_of(level, regions);
  std::vector<std::uint32_t> cells, groups;
  const std::vector<std::uint32_t> group_of =
      division.kind == Division::Kind::regions ? regions : division.groups(level);
  for (Cell_id cell = 0; cell < level.cells().size(); ++cell) {
    const Level_cell& here = level.cells()[cell];
    const std::uint32_t group = here.is_solid     ? solid
                                : here.is_outside ? outside
                                                  : static_cast<std::uint32_t>(colours[cell]);
    for (const std::uint32_t w : here.walls) {
      const Cell_wall& wall = level.walls()[w];
      std::vector<Exact_point> corners = level.polygon(wall.corners);
      if (wall.front == cell) std::reverse(corners.begin(), corners.end());
      polygons.add_polygon(group, Grouped_polygons::no_face, corners);
      cells.push_back(cell);
      groups.push_back(division.kind == Division::Kind::leaves ? here.leaf : group_of[cell]);
    }
  }
  polygons.add_column("cell", std::move(cells));
  switch (division.kind) {
    case Division::Kind::none: break;
    case Division::Kind::leaves: polygons.add_column("leaf", std::move(groups)); break;
    case Division::Kind::boxes: polygons.add_column("box", std::move(groups)); break;
    case Division::Kind::volumes: polygons.add_column("volume", std::move(groups)); break;
    case Division::Kind::regions: polygons.add_column("convex_region", std::move(groups)); break;
  }
  return polygons;
}

/// A way out, by points of its first cells.
std::string words_of(const Level_cells& level, const std::vector<Cell_id>& way) {
  if (way.empty()) return "no way out";
  if (way[0] == no_cell) return "outside of everything";
  if (way.size() == 1) return "a leak: the cell there has no end";
  constexpr std::size_t most = 6;
  std::string words = fmt::format("a leak through {} cells, by ", way.size());
  for (std::size_t i = 1; i < std::min(way.size(), most); ++i)
    words += fmt::format("{}({})", i == 1 ? "" : ", ", Page::text(level.inside(way[i])));
  return words + (way.size() > most ? " and so on; --json - lists all" : "");
}

Exit run(const Cells_arguments& arguments) {
  const Common& common = arguments.common;
  const Polygon_soup soup = common.read();
  const std::vector<Seal> given = seals_of(arguments);
  const Division division = arguments.division.division(common, soup);
  const Stopwatch watch;
  const Report in_time = common.within_budget();
  const Level_cells level = cells_of(common, soup, division);
  std::vector<std::uint32_t> regions;  // by cell
  if (division.kind == Division::Kind::regions) regions = division.groups(level, in_time);
  std::uint32_t region_count = 0;
  for (const std::uint32_t region : regions)
    if (region != no_cell) region_count = std::max(region_count, region + 1);
  const double seconds = watch.seconds();
  const Scene& scene = level.scene();
  const Cell_counters& c = level.counters();
  Json leaks = Json::array();
  std::vector<Seal> seals;  // but for entities in what is solid
  std::vector<std::vector<Cell_id>> ways;
  for (const Seal& seal : given) {
    const Exact_point& p = seal.point;
    const Cell_id cell = level.at(p);
    if (cell != no_cell && level.cells()[cell].is_solid) {
      if (seal.is_entity) continue;
      throw Usage_error("--seal " + seal.text + ": the point is in a solid cell; give one of a room");
    }
    seals.push_back(seal);
    ways.push_back(cell == no_cell ? std::vector<Cell_id>{no_cell} : level.way_out(p));
    if (ways.back().empty()) continue;
    Json way = Json::array();
    for (const Cell_id on_way : ways.back())
      if (on_way != no_cell) way.push_back({{"cell", on_way}, {"point", point_json(level.inside(on_way))}});
    leaks.push_back({{"from", point_json(p)}, {"way", std::move(way)}});
  }
  if (!given.empty() && seals.empty())
    throw Input_error::of_file(input_path(common.scene).string(),
                               "none of its entities stands in a room, so that nothing is known of leaks; give a "
                               "point of one, --seal X,Y,Z");
  if (!arguments.out.empty()) write_file(arguments.out, cells_text(level, soup, division, regions));
  if (!arguments.mesh.empty()) write_drawings("", arguments.mesh, drawing_of(level, division, regions));
  if (!arguments.html.empty()) write_page(arguments.html, level, seals, ways);
  const Exit exit = leaks.empty() ? Exit::done : Exit::disagreement;
  Json result{{"cells", c.cells},
              {"solid", c.solid},
              {"portals", c.portals},
              {"regions", c.regions},
              {"closed", level.is_closed()},
              {"sealed", seals.size() - leaks.size()},
              {"in_solid", given.size() - seals.size()},
              {"leaks", leaks}};
  if (!regions.empty()) result["convex_regions"] = region_count;
  if (write_json(common, "cells", scene, result, counters_json(c), {{"build", seconds}})) return exit;
  scene_rows(scene);
  row("cells", fmt::format("{}: {} solid{}, {} without end; {} regions", c.cells, c.solid,
                           level.is_closed() ? "" : " (the faces do not close up)", c.outside, c.regions));
  if (!regions.empty())
    row("coarse", fmt::format("{} convex regions of {} cells that are not solid", region_count, c.cells - c.solid));
  row("walls", fmt::format("{}: {} portals between cells that are not solid, {} covered by faces", c.walls, c.portals,
                           c.covered));
  row("tree", fmt::format("{} nodes, {} splits; {} corners of walls in planes that divide them", c.nodes, c.splits,
                          c.contacts));
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (!seals[i].is_entity || !ways[i].empty()) row("seal", seals[i].text + ": " + words_of(level, ways[i]));
  if (std::any_of(given.begin(), given.end(), [](const Seal& seal) { return seal.is_entity; })) {
    std::size_t sealed = 0;
    for (std::size_t i = 0; i < ways.size(); ++i) sealed += seals[i].is_entity && ways[i].empty() ? 1 : 0;
    row("seal", fmt::format("{} entities: no way out; {} stand in solid cells and are passed over", sealed,
                            given.size() - seals.size()));
  }
  row("seconds", fmt::format("{:.3f}", seconds));
  return exit;
}

}  // namespace

void add_cells(Command program) {
  const Command command =
      program.add_command("cells", "The convex cells of a level, solid and empty, the portals between them, and leaks");
  auto a = std::make_shared<Cells_arguments>();
  a->common.add_to(command);
  command.add_option("--seal", a->seals,
                     "a point X,Y,Z of a room from which there should be no way out, or `entities`: all places of a "
                     ".map or .bsp where "
                     "something stands (players, lamps; not those in solid cells). What is on a wall is in each cell "
                     "beside it. May be "
                     "repeated. Exit code 1 where there is a way out");
  a->division.add_to(command);
  command.add_option("--out", a->out, "write points, cells and walls as JSON, which `pvs --cells` reads")
      .writes_file(".json");
  add_mesh_option(command, a->mesh, "cells as polyhedra, neighbours in other colours, with cells' ids,");
  command.add_option("--html", a->html, "write a page to look at: cells to walk through, and ways out of --seal")
      .writes_file(".html");
  command.footer(
      "Example: sightline cells level.map --seal 64,64,24 --out cells.json\n"
      "A cell is solid where the faces close up and have it behind them; a portal is what faces leave open "
      "of a wall between two cells that are not.");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
