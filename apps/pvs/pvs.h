#pragma once
// What the sources of `sightline pvs` share: its command line, and the cells that it asks about.

#include "../support/cell_file.h"
#include "../support/picture.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/io/visibility_table.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sightline::app {

constexpr std::uint32_t table_blocks = 64;  // parts that --resume saves what is done in, and that processes share

struct Pvs_arguments {
  Common common;
  View_arguments view;
  std::string out, table, cells, shard, svg, html, eye, obj, mesh, certificates;
  bool outside = false, resume = false, cells_too = false;
  Division_arguments division;
  std::vector<std::string> shown;  // as --show has them: a cell, or a point of one
  std::vector<Cell_id> show;       // the same as cells, once these are known
};

}  // namespace sightline::app
