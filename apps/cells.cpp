// sightline cells: the convex cells of a level, the walls between them, what is solid, and ways out.

#include "support/leaves.h"
#include "support/page.h"

#include <sightline/algorithms/levels/cells.h>

#include <array>
#include <iostream>
#include <numeric>

namespace sightline::app {

namespace {

struct Cells_arguments {
  Common common;
  unsigned candidates = 5;
  std::vector<std::string> seals;
  std::string out, html;
  bool leaves = false;
};

Json ids_json(const std::vector<std::uint32_t>& ids) { return Json(ids); }

/// The whole of it: points once, by number.
Json cells_json(const Level_cells& level) {
  Json points = Json::array(), cells = Json::array(), walls = Json::array();
  for (const Exact_point& p : level.points()) points.push_back(point_json(p));
  for (const Level_cell& cell : level.cells())
    cells.push_back({{"solid", cell.is_solid},
                     {"outside", cell.is_outside},
                     {"winding", cell.winding},
                     {"region", cell.region},
                     {"leaf", cell.leaf},
                     {"faces", ids_json(cell.faces)},
                     {"walls", ids_json(cell.walls)}});
  for (const Cell_wall& wall : level.walls()) {
    Json open = Json::array();
    for (const std::vector<std::uint32_t>& part : wall.open) open.push_back(ids_json(part));
    Json faces = Json::array({ids_json(wall.faces_front), ids_json(wall.faces_behind)});
    walls.push_back({{"cells", Json::array({Json(wall.front), wall.behind == no_cell ? Json() : Json(wall.behind)})},
                     {"corners", ids_json(wall.corners)},
                     {"open", std::move(open)},
                     {"faces", std::move(faces)}});
  }
  return {{"format", "sightline cells 1"},
          {"scene", level.scene().file()},
          {"points", std::move(points)},
          {"cells", std::move(cells)},
          {"walls", std::move(walls)}};
}

/// The faces, and cells to walk through: rooms first, then what has no end, then solids; ways out of --seal.
void write_page(const Cells_arguments& arguments, const Level_cells& level,
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
    page.append_place(way, parse_point(arguments.seals[i], "--seal"));
    for (const Cell_id cell : ways[i]) page.append_place(way, level.inside(cell));
    leaks.push_back({{"from", arguments.seals[i]}, {"cells", packed(ways[i])}, {"way", packed(way)}});
  }
  page.more()["leaks"] = std::move(leaks);
  page.write(arguments.html);
}

Exit run(const Cells_arguments& arguments) {
  const Common& common = arguments.common;
  const Polygon_soup soup = common.read();
  std::vector<Exact_point> seals;
  for (const std::string& text : arguments.seals) seals.push_back(parse_point(text, "--seal"));
  Progress progress("dividing");
  Cell_options options;
  options.candidates = arguments.candidates;
  options.seed = common.seed;
  options.threads = common.threads;
  if (arguments.leaves) {
    const std::string bytes = compiled_level(common, "--leaves");
    options.tree = space_tree(read_quake_level({common.scene, bytes}), common.scene);
  }
  options.progress = common.within_budget([&](std::size_t done, std::size_t all) { progress(done, all); });
  const Stopwatch watch;
  const Level_cells level(soup, options);
  const double seconds = watch.seconds();
  progress.clear();
  const Scene& scene = level.scene();
  const Cell_counters& c = level.counters();
  if (!arguments.out.empty()) write_file(arguments.out, to_text(cells_json(level)) + "\n");

  Json leaks = Json::array();
  std::vector<std::vector<Cell_id>> ways;
  for (const Exact_point& p : seals) {
    const Cell_id cell = level.at(p);
    if (cell != no_cell && level.cells()[cell].is_solid)
      throw Usage_error("--seal: the point is in a solid cell; give one of a room");
    ways.push_back(cell == no_cell ? std::vector<Cell_id>{no_cell} : level.way_out(p));
    if (ways.back().empty()) continue;
    Json way = Json::array();
    for (const Cell_id on_way : ways.back())
      if (on_way != no_cell) way.push_back({{"cell", on_way}, {"point", point_json(level.inside(on_way))}});
    leaks.push_back({{"from", point_json(p)}, {"way", std::move(way)}});
  }
  if (!arguments.html.empty()) write_page(arguments, level, ways);
  const Exit exit = leaks.empty() ? Exit::done : Exit::disagreement;
  const Json result{{"cells", c.cells},
                    {"solid", c.solid},
                    {"portals", c.portals},
                    {"regions", c.regions},
                    {"closed", level.is_closed()},
                    {"leaks", leaks}};
  if (write_json(common, "cells", scene, result, counters_json(c), {{"build", seconds}})) return exit;
  scene_rows(scene);
  row("cells", fmt::format("{}: {} solid{}, {} without end; {} regions", c.cells, c.solid,
                           level.is_closed() ? "" : " (the faces do not close up)", c.outside, c.regions));
  row("walls", fmt::format("{}: {} portals between cells that are not solid, {} covered by faces", c.walls, c.portals,
                           c.covered));
  row("tree", fmt::format("{} nodes, {} splits; {} corners of walls in planes that divide them", c.nodes, c.splits,
                          c.contacts));
  for (std::size_t i = 0; i < ways.size(); ++i)
    row("seal",
        arguments.seals[i] + (ways[i].empty() ? ": no way out"
                              : ways[i][0] == no_cell
                                  ? ": outside of everything"
                                  : fmt::format(": a leak through {} cells; --json - lists them", ways[i].size())));
  row("seconds", fmt::format("{:.3f}", seconds));
  return exit;
}

}  // namespace

void add_cells(Command program) {
  const Command command =
      program.add_command("cells", "The convex cells of a level, solid and empty, the portals between them, and leaks");
  auto a = std::make_shared<Cells_arguments>();
  a->common.add_to(command);
  command.add_option("--candidates", a->candidates, "face planes tried for each node of the tree")
      .check(range(1, 1000))
      .show_default();
  command.add_option(
      "--seal", a->seals,
      "a point X,Y,Z of a room from which there should be no way out; may be repeated. Exit code 1 where "
      "there is one");
  command.add_flag("--leaves", a->leaves, "of a compiled level (.bsp): cells within its own leaves, by number");
  command.add_option("--out", a->out, "write points, cells and walls as JSON").writes_file().check(ending(".json"));
  command.add_option("--html", a->html, "write a page to look at: cells to walk through, and ways out of --seal")
      .writes_file()
      .check(ending(".html"));
  command.footer(
      "Example: sightline cells level.map --seal 64,64,24 --out cells.json\n"
      "A cell is solid where the faces close up and have it behind them; a portal is what faces leave open "
      "of a wall between two cells that are not.");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
