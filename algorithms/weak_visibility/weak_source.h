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

/// The corners of a source: without repeated points and straight corners. What a certificate names. Exact: yes.
/// Errors: std::invalid_argument where it has no inside, is not planar or not convex, saying what to do.
std::vector<Exact_point> strict_corners(const std::vector<Exact_point>& points);

/// A source from points in the file's coordinates: of their strict_corners(). Exact: yes. Errors: as there.
Weak_source weak_source(const Occluders& occluders, const std::vector<Exact_point>& points);

/// A piece that a face of the scene consists of, as a source: it looks to the face's front.
inline Weak_source weak_source(const Occluders& occluders, std::uint32_t piece) {
  return {occluders.polygon(piece), occluders.plane(piece)};
}

}  // namespace sightline
