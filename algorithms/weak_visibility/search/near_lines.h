#pragma once
// Lines between two polygons where these are close to each other: of large ones most others miss what stands upon them.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/search/cell_line.h>

#include <vector>

namespace sightline {

/// Lines from beside the point of the source that is nearest to the target's middle, a little in front of the target's
/// plane, and to beside that of the target nearest to the source's middle. In doubles, for proposals; none where these
/// overflow. Pre: convex polygons with area, each partly in front of the other's plane.
std::vector<Line_weights> near_lines(const Near_polygon& source, const Near_plane& source_plane,
                                     const Near_polygon& target, const Near_plane& target_plane);

/// Lines beside another one: from the point of the source that is nearest to p to points near the target's nearest to
/// q, ever farther from its border. In doubles, for proposals.
std::vector<Line_weights> lines_beside(const Near_polygon& source, const Near_polygon& target, const Triple& p,
                                       const Triple& q);

}  // namespace sightline
