#pragma once
// Lines that a cell touches and does not hold, and the planes that cut it into sectors around them.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/search/cell_cuts.h>
#include <sightline/algorithms/weak_visibility/search/line_cell.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace sightline {

/// A line in the closure of a cell that meets four of the lines which bound it: lines of its path, edges of its
/// polygons.
struct Touching_line {
  std::array<Integer, 4> from, to;  ///< on the polygons' planes, in homogeneous grid coordinates
  std::vector<Exact_pluecker> met;  ///< all bounding lines that it meets
};

/// The touching lines with rational ends, each once: those that meet four independent bounds, one of two such or the
/// only one, as where the four-edge determinant has a double root. Doubles choose the four, integers make the line.
/// Degenerate: where infinitely many lines meet the four, none of them counts. Cost: as many small eliminations as
/// there are choices of four bounds; none where there are more than 24. Exact: yes, but for lines that doubles pass
/// over. Proof: P-71h
std::vector<Touching_line> touching_lines(const Line_cell& cell, const Near_plane& source_plane,
                                          const Near_plane& target_plane);

/// The plane of a touching line and of a bounding line that it meets, where that cuts source or target; none where all
/// of these are used up. Exact: yes. Proof: P-71h
std::optional<Cell_cut> sector_plane(const Line_cell& cell, const Near_plane& source_plane,
                                     const Near_plane& target_plane);

}  // namespace sightline
