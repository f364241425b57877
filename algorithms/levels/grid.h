#pragma once
// Space divided into even boxes, for cells that lie within them. To be read after cells.h.

#include <sightline/algorithms/levels/cells.h>

#include <array>
#include <cstdint>

namespace sightline {

/// The box about all corners of faces, divided evenly along each axis: leaf x + counts[0] (y + counts[1] z) is box
/// (x, y, z), counted from the least coordinates. Boxes at the rim go on without end. Pre: counts are positive, and
/// their product is below 2^31. Degenerate: boxes are open, and what lies between two is in walls. Errors:
/// std::invalid_argument, which names the axis, where a scene that has no extent along it is to be divided there. Cost:
/// a node for each box but one, as deep as their number's logarithm. Exact: yes.
Space_tree even_boxes(const Polygon_soup& soup, const std::array<std::uint32_t, 3>& counts);

}  // namespace sightline
