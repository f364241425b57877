#pragma once
// The leaves of a compiled level, as a division of space for cells.

#include <sightline/algorithms/levels/cells.h>
#include <sightline/io/quake_bsp.h>

#include <string>

namespace sightline {

/// The level's own tree, exactly as its floats say; leaves keep their numbers. Errors: std::runtime_error, which names
/// the file, where a node's plane has no normal.
Space_tree space_tree(const Quake_level& level, const std::string& file);

}  // namespace sightline
