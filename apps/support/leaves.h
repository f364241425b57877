#pragma once
// What divides space before faces do: a compiled level's own tree and leaves, or even boxes.

#include "common.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/io/quake_bsp.h>
#include <sightline/own_leaves.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sightline::app {

/// Options --leaves and --grid, of which there may be one.
struct Division_arguments {
  bool leaves = false;
  std::string grid;  // "NX,NY,NZ", or empty

  void add_to(Command command);
  /// The tree that they ask for; none by default. Errors: Usage_error.
  Space_tree tree(const Common& common, const Polygon_soup& soup) const;
  /// Of --grid. Errors: Usage_error.
  std::array<std::uint32_t, 3> counts() const;
  /// What a table has to name: it is another one without.
  std::string question() const { return leaves ? ", leaves" : grid.empty() ? "" : ", grid " + grid; }
};

/// The bytes of SCENE where it is a compiled level. Errors: Usage_error that begins with `wanted` where it is none.
std::string compiled_level(const Common& common, const std::string& wanted);

/// What leaves see, as a level has it: rows[l] is of leaf l + 1. Pre: cells are within the leaves of the level's tree.
std::vector<std::vector<bool>> rows_of_level(const Level_cells& level, const Cell_pvs& pvs, const Quake_level& file);

}  // namespace sightline::app
