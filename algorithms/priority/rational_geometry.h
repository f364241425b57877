#pragma once
// Vectors of rationals, for what is decided rarely, and planes through a viewpoint in doubles, for what comes before.

#include <sightline/kernel/partition_traits.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cmath>
#include <vector>

namespace sightline {

namespace priority_detail {

inline Exact_point minus(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
}
inline Rational dot(const Exact_point& a, const Exact_point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Exact_point cross(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[1] * b[2] - a[2] * b[1]), Rational(a[2] * b[0] - a[0] * b[2]),
          Rational(a[0] * b[1] - a[1] * b[0])};
}

/// The corners of a polygon.
template <class Traits>
std::vector<Exact_point> positions(const Traits& traits, const Convex_polygon<Traits>& polygon) {
  std::vector<Exact_point> points;
  for (const Corner<Traits>& corner : polygon) points.push_back(traits.position(*corner.vertex));
  return points;
}

/// The plane through a viewpoint and two points, given by the vectors to them, in doubles that are each within a
/// relative 2^-53.
struct Rounded_plane {
  using Triple = std::array<double, 3>;
  Triple normal, size;

  /// In front is where a, b and the direction are positively oriented.
  Rounded_plane(const Triple& a, const Triple& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t p = (k + 1) % 3, q = (k + 2) % 3;
      normal[k] = a[p] * b[q] - a[q] * b[p], size[k] = std::fabs(a[p] * b[q]) + std::fabs(a[q] * b[p]);
    }
  }
  /// The side of a direction of that kind: 1, -1, or 0 where doubles do not tell. Products of two are off by 3 x 2^-53
  /// of their size, their difference by 4, a product with the direction by 6, the sum of three by 8: 2^-49 covers that;
  /// the last term is for underflow. What is beyond doubles is not told. Proof: P-33
  int side(const Triple& d) const {
    const double value = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
    const double bound =
        0x1p-49 * (size[0] * std::fabs(d[0]) + size[1] * std::fabs(d[1]) + size[2] * std::fabs(d[2])) + 0x1p-900;
    return value > bound ? 1 : value < -bound ? -1 : 0;
  }
};

}  // namespace priority_detail

}  // namespace sightline
