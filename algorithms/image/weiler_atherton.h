#pragma once
// Weiler and Atherton's algorithm: the nearest polygon cuts all others along its edges, into what is inside and what is
// outside.

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>

namespace sightline {

/// What visible_surface() gives in the given cones, which must have no open set in common: parts that fill them, each
/// showing the same; their cuts differ. Polygons are sorted once, by their nearest corners. The first one is the clip
/// polygon: windows, convex cones of directions, are cut along planes through the eye and its edges. Outside, the next
/// ones are; inside, what is behind it is dropped, and where something turns out to be in front of it, that is the
/// clip polygon there. Polygons that pierce each other are cut by the line where they cross. Clip polygons are convex
/// pieces, of up to 32 corners each; the outside of one is a union of convex windows, each with a list of its own,
/// where Weiler and Atherton have one concave window with holes, so that what is there is cut more often; a polygon is
/// cut by keeping it in the lists of several windows, never by new corners. Degenerate: of polygons in one plane the
/// one seen from its front is the nearer, then by face id, then by number; pieces in whose plane the eye is are not
/// seen; an empty scene is one part for each cone. Cost: windows, each times the polygons that come down to it: all of
/// them at first. Parallel. Exact: filtered. Ref: Weiler and Atherton, Hidden surface removal using polygon area
/// sorting, SIGGRAPH 1977. Proof: P-83
Visible_surface<Exact_view> weiler_atherton(const Exact_view& view, Cones<Exact_view> cones,
                                            const Visible_options& options = {});

}  // namespace sightline
