#include <sightline/kernel/scene/exact_plane.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sightline {

Rational exact_height(const Exact_plane& plane, const Exact_point& p) {
  return Rational(plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3]);
}

Exact_plane exact_plane(std::span<const Exact_point> polygon) {  // Newell's normal
  Exact_plane plane{0, 0, 0, 0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Exact_point part = cross(minus(polygon[i], polygon[0]), minus(polygon[i + 1], polygon[0]));
    for (std::size_t k = 0; k < 3; ++k) plane[k] += part[k];
  }
  for (std::size_t k = 0; k < 3; ++k) plane[3] -= plane[k] * polygon[0][k];
  return plane;
}

Unoriented_plane unoriented(Exact_plane plane) {
  const Rational first = sgn(plane[0]) != 0 ? plane[0] : sgn(plane[1]) != 0 ? plane[1] : plane[2];
  for (Rational& x : plane) x /= first;
  return {std::move(plane), sgn(first) < 0};
}

std::array<Exact_point, 2> exact_box(std::span<const Exact_point> points) {
  std::array<Exact_point, 2> box{points[0], points[0]};
  for (const Exact_point& p : points)
    for (std::size_t k = 0; k < 3; ++k) {
      box[0][k] = std::min(box[0][k], p[k]);
      box[1][k] = std::max(box[1][k], p[k]);
    }
  return box;
}

}  // namespace sightline
