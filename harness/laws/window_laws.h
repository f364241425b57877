#pragma once
// Laws of clipping to concave windows with holes, by brute force: nothing of what clips is used here.

#include <sightline/algorithms/image/concave_window.h>
#include <sightline/harness/laws/subject.h>

#include <span>

namespace sightline::harness {

/// Whether clip_to_window() gives what it says, decided by cells of the plane: upright slabs between all corners and
/// crossings, cut by the edges through them. Each cell has one winding number for each list. Where one is neither 0 nor
/// 1, clipping must refuse, and else not; a point in each cell must be in as many polygons of a result as it has to be,
/// and areas must be those of the cells; loops must be as results have them; and with polygons and window exchanged the
/// inside must be as large. Pre: finite loops. Cost: slabs, edges through them, and edges of results.
Outcome checked_clip(std::span<const Image_polygon> polygons, std::span<const Image_polygon> window);

/// The same of polygons that share edges, touch in corners and have holes that do, and of a scene's faces.
Check windows_check();

}  // namespace sightline::harness
