#pragma once
// Lines that a cell touches although none is in it: planes through them, by which it is cut into sectors.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/search/cell_cuts.h>
#include <sightline/algorithms/weak_visibility/search/line_cell.h>

#include <optional>

namespace sightline {

std::optional<Cell_cut> plane_at_touching_line(const Line_cell& cell, const Near_plane& source_plane,
                                               const Near_plane& target_plane, bool between);

}  // namespace sightline
