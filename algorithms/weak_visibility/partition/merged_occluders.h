#pragma once
// The same surfaces in fewer pieces.

#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

namespace sightline {

/// The pieces of a scene as faces, two of one plane as one where they share an edge and are convex together; on and on.
/// What they hide is the same, up to measure zero: which side is their front is lost. Cost: O(n log n) of what shares
/// edges. Exact: yes. Proof: P-86
Polygon_soup merged_pieces(const Scene& scene);

}  // namespace sightline
