#pragma once
// What the leaves of a compiled level see of each other: exactly, by the table that it came with, and by points.

#include "compare.h"
#include "sightline_files.h"

#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/io/quake_bsp.h>

#include <cstddef>
#include <vector>

namespace sightline::app {

/// Rows of methods, judged by ordered pairs of different leaves that eyes may be in; and for each pair that the table
/// hides wrongly a sightline, which is checked by rationals alone. Where something is undecided, exit says so.
struct Leaves_compared {
  Json rows = Json::array(), sightlines = Json::array();
  std::size_t pairs = 0, visible = 0, undecided = 0;
  std::size_t refuted = 0;  ///< pairs whose sightline passed the check and leaves no leaf that eyes may be in
  /// Pairs whose sightline passed the check, but goes through what the file calls solid or sky and has no face there.
  std::size_t through_solid = 0;
  double seconds = 0;
  Exit exit = Exit::done;
};
/// Pre: the level's cells are within the leaves of the file's tree. With `files` each sightline is one of these.
Leaves_compared compare_leaves(const Compare_arguments& arguments, const Quake_level& file, const Space_tree& tree,
                               const Level_cells& level, const Occluders& occluders, const Sightline_files* files);

/// The leaves whose insides a segment goes through, in order, by the file's own planes, exactly.
std::vector<std::size_t> leaves_along(const Space_tree& tree, const Exact_point& from, const Exact_point& to);

}  // namespace sightline::app
