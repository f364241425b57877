#pragma once
// What the sources of `sightline pvs` share: its command line, and the cells that it asks about.

#include "../support/cell_file.h"
#include "../support/picture.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/io/visibility_table.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sightline::app {

constexpr std::uint32_t table_blocks = 64;  // parts that --resume saves what is done in, and that processes share

struct Pvs_arguments {
  Common common;
  View_arguments view;
  std::string out, cells, shard, svg, html, eye, obj, mesh, certificates;
  bool outside = false, resume = false, cells_too = false;
  Division_arguments division;
  std::vector<std::uint32_t> show;
};

/// Whether the budget is over, for what then leaves the rest undecided; empty: there is none.
std::function<bool()> out_of_time(const Common& common, const Stopwatch& watch);

}  // namespace sightline::app
