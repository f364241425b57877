// sightline cells: the convex cells of a level, the walls between them, what is solid, and ways out.

#include "support/leaves.h"

#include <sightline/algorithms/levels/cells.h>

#include <iostream>

namespace sightline::app {

namespace {

struct Cells_arguments {
  Common common;
  unsigned candidates = 5;
  std::vector<std::string> seals;
  std::string out;
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
  command.footer(
      "Example: sightline cells level.map --seal 64,64,24 --out cells.json\n"
      "A cell is solid where the faces close up and have it behind them; a portal is what faces leave open "
      "of a wall between two cells that are not.");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
