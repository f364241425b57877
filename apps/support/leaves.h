#pragma once
// Levels that a game's compiler made: their own tree and leaves, for cells within them.

#include "common.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/io/quake_bsp.h>

#include <string>
#include <vector>

namespace sightline::app {

/// The bytes of SCENE where it is a compiled level. Errors: Usage_error that begins with `wanted` where it is none.
std::string compiled_level(const Common& common, const std::string& wanted);

/// The level's own tree, exactly as its floats say. Errors: Input_error where a node's plane has no normal.
Space_tree space_tree(const Quake_level& level, const std::string& file);

/// What leaves see, as a level has it: rows[l] is of leaf l + 1. Pre: cells are within the leaves of the level's tree.
std::vector<std::vector<bool>> rows_of_level(const Level_cells& level, const Cell_pvs& pvs, const Quake_level& file);

}  // namespace sightline::app
