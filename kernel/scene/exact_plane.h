#pragma once
// Planes and boxes of exact points, where a few are asked about and none is interned.

#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <span>

namespace sightline {

/// a x + b y + c z + d, positive in front; not a = b = c = 0.
using Exact_plane = std::array<Rational, 4>;

/// Positive in front; as far as the plane's normal is long. Exact: yes
Rational exact_height(const Exact_plane& plane, const Exact_point& p);

/// The plane of a polygon, its front where it is counterclockwise; the normal is twice the area. Pre: it is planar, and
/// has three corners. Degenerate: zeros where it has no area. Exact: yes
Exact_plane exact_plane(std::span<const Exact_point> polygon);

/// One name of a plane, whichever side is its front: the first coefficient that is not zero is 1. Pre: it is a plane.
/// Post: `is_turned` where front and back have changed.
struct Unoriented_plane {
  Exact_plane plane;
  bool is_turned;
};
Unoriented_plane unoriented(Exact_plane plane);

/// The least and the largest coordinates. Pre: there is a point.
std::array<Exact_point, 2> exact_box(std::span<const Exact_point> points);

}  // namespace sightline
