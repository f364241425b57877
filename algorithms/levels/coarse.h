#pragma once
// Cells put together to fewer convex ones. To be read after cells.h.

#include <sightline/algorithms/levels/cells.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sightline {

/// Cells that are not solid, put together while what they are together is convex and no face is inside, until no more
/// than `most` are left, or none can be put together: for each cell the number of the convex region that it is in, by
/// first cells; `no_cell` for solid ones. Two regions are put together only where what they have in common is open all
/// over; those with the largest common polygons come first. Post: with walls between their cells, regions are convex
/// polyhedra, open and disjoint. Degenerate: at no time more regions than cells; a polygon that a face touches with
/// its boundary alone is open. Cost: rounds, until one changes nothing, of O(walls) tests of the planes of one region
/// with the corners of another. `progress` is told how many cells were put to others, of those that may be, all the
/// time; what it throws ends it. Exact: yes. Proof: P-88d
std::vector<std::uint32_t> convex_regions(const Level_cells& level, std::size_t most,
                                          const std::function<void(std::size_t done, std::size_t all)>& progress = {});

}  // namespace sightline
