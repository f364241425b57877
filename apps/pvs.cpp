// sightline pvs: for each cell of a level the faces that are visible from it.

#include "support/common.h"

#include <sightline/algorithms/levels/pvs.h>

#include <iostream>

namespace sightline::app {

namespace {

struct Pvs_arguments {
  Common common;
  unsigned candidates = 5;
  bool outside = false;
  std::string out;
};

Exit run(const Pvs_arguments& arguments) {
  const Common& common = arguments.common;
  const Polygon_soup soup = common.read();
  Cell_options cell_options;
  cell_options.candidates = arguments.candidates;
  cell_options.seed = common.seed;
  cell_options.threads = common.threads;
  Stopwatch watch;
  const Level_cells level(soup, cell_options);
  const double cells_seconds = watch.seconds();

  Progress progress("looking");
  Pvs_options options;
  options.outside = arguments.outside;
  options.threads = common.threads;
  options.search.seed = common.seed;
  options.progress = [&](std::size_t done, std::size_t all) { progress(done, all); };
  if (common.budget > 0) options.search.out_of_time = [&] { return watch.seconds() > common.budget; };
  const Pvs pvs = potentially_visible(level, options);
  const double seconds = watch.seconds() - cells_seconds;
  progress.clear();
  const Pvs_counters& c = pvs.counters;
  const Exit exit = c.undecided > 0 ? Exit::undecided : Exit::done;
  const Json result{
      {"cells", c.cells}, {"faces", c.faces}, {"pairs", c.pairs}, {"visible", c.visible}, {"undecided", c.undecided}};
  if (write_json(common, "pvs", level.scene(), result, counters_json(c), {{"cells", cells_seconds}, {"pvs", seconds}}))
    return exit;
  scene_rows(level.scene());
  row("cells", fmt::format("{} of {} are asked about", c.cells, level.counters().cells));
  row("pairs", fmt::format("{}: {} visible ({:.3g}%), {} undecided", c.pairs, c.visible,
                           100.0 * double(c.visible) / double(std::max<std::size_t>(1, c.pairs)), c.undecided));
  row("seen", fmt::format("{} within their cell, {} by a neighbour's sightline, {} searches of which {} found hidden; "
                          "{} pairs not reached",
                          c.within, c.extended, c.searched, c.hidden, c.unreached));
  row("seconds", fmt::format("{:.3f} for cells, {:.3f} for what they see", cells_seconds, seconds));
  return exit;
}

}  // namespace

void add_pvs(Command program) {
  const Command command = program.add_command("pvs", "What each cell of a level can see, exactly");
  auto a = std::make_shared<Pvs_arguments>();
  a->common.add_to(command);
  command.add_option("--candidates", a->candidates, "face planes tried for each node of the tree")
      .check(range(1, 1000))
      .show_default();
  command.add_flag("--outside", a->outside, "ask about cells too from which there is a way out of the level");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
