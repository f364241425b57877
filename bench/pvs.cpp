// Levels: cells, and what each sees: bench_pvs [LEVEL ...] [--most N]. One row for each level, or for houses of n x n
// rooms, n = 2, 4, 8 ... N (16): one thread, processor seconds; searches, and microseconds for each; and against asking
// every pair of a portal and a face that looks into a room, of which there are as many as `all pairs`.

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/io/read.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/time_limit.h>

#include <fmt/format.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

using namespace sightline;

namespace {

void measure(const std::string& name, const Polygon_soup& soup) {
  Cell_options cell_options;
  cell_options.threads = 1;
  const double begin = processor_seconds();
  const Level_cells level(soup, cell_options);
  const double divided = processor_seconds();
  Pvs_options options;
  options.threads = 1;
  const Pvs pvs = potentially_visible(level, options);
  const double looked = processor_seconds() - divided;
  const double before_cells = processor_seconds();
  const Cell_pvs mutual = mutually_visible_cells(level, options);
  const double of_cells = processor_seconds() - before_cells;
  std::size_t portals = 0;
  for (Cell_id c = 0; c < level.cells().size(); ++c)
    if (pvs.is_asked[c] != 0) portals += portals_of(level, c).size();
  const Pvs_counters& c = pvs.counters;
  std::cout << fmt::format(
                   "{:<24} {:>7} {:>6} {:>6} {:>9} {:>9} {:>10} {:>9} {:>8.2f} {:>8.2f} {:>6.1f} {:>6} {:>9} {:>9} "
                   "{:>9} {:>8.2f} {:>6}\n",
                   name, level.scene().counters().faces, level.counters().cells, c.cells, c.pairs, c.visible,
                   portals * c.faces, c.searched, divided - begin, looked,
                   1e6 * looked / static_cast<double>(std::max<std::size_t>(1, c.searched)), c.undecided,
                   mutual.counters.pairs, mutual.counters.visible, mutual.counters.searched, of_cells,
                   mutual.counters.undecided)
            << std::flush;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  std::size_t most = 16;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--most" && i + 1 < argc) most = std::strtoul(argv[++i], nullptr, 10);
    else files.push_back(argv[i]);
  }
  std::cout << fmt::format(
      "{:<24} {:>7} {:>6} {:>6} {:>9} {:>9} {:>10} {:>9} {:>8} {:>8} {:>6} {:>6} {:>9} {:>9} {:>9} {:>8} {:>6}\n",
      "level", "faces", "cells", "asked", "pairs", "visible", "all pairs", "searches", "s cells", "s pvs", "us", "open",
      "c pairs", "visible", "searches", "s", "open");
  for (const std::string& file : files) measure(file.substr(file.rfind('/') + 1), read_scene(file));
  if (files.empty())
    for (std::size_t n = 2; n <= most; n *= 2)
      measure(fmt::format("rooms, {0} x {0}", n), generate::make("rooms", n, 1));
}
