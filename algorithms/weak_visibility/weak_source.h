#pragma once
// What looks: convex polygons as sources.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstdint>
#include <vector>

namespace sightline {

/// A convex polygon that looks to one side: counterclockwise as seen from there. It may be a face of the scene, touch
/// faces or cross them.
struct Weak_source {
  Near_polygon polygon;
  Near_plane plane;
};

/// A source from points in the file's coordinates. Straight corners and repeated points are dropped. Exact: yes.
/// Errors: std::invalid_argument where it has no inside, is not planar or not convex, saying what to do.
Weak_source weak_source(const Occluders& occluders, const std::vector<Exact_point>& points);

/// A piece that a face of the scene consists of, as a source: it looks to the face's front.
inline Weak_source weak_source(const Occluders& occluders, std::uint32_t piece) {
  return {occluders.polygon(piece), occluders.plane(piece)};
}

}  // namespace sightline
