#pragma once
// Space divided by given volumes, rooms say, for cells that lie within them. To be read after cells.h.

#include <sightline/algorithms/levels/cells.h>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace sightline {

struct Volume_division {
  Space_tree tree;
  std::uint32_t volumes = 0;
};

/// A tree of given polyhedra, each a connected component of the faces, by points that they share: leaf v is volume v,
/// by first faces, and leaf `volumes` all else. One that is not convex is in several leaves: the cells of its own faces
/// that are inside. Fronts may look outwards or inwards. Degenerate: volumes may touch, as long as they have points of
/// their own; faces of no area are passed over, and sides may be in parts; a hollow in a volume is another component,
/// and overlaps it. Errors: std::invalid_argument, one line that names faces, where a component does not close up, has
/// no inside or goes through itself, or where two have points inside in common. Cost: a tree of n planes with its
/// n log n sides of volumes, where few are cut; n^2 in the worst case. `progress` is told how far it is; what it throws
/// ends it. Exact: yes. Proof: P-88c
Volume_division volume_division(const Polygon_soup& soup,
                                const std::function<void(std::size_t done, std::size_t all)>& progress = {});

}  // namespace sightline
