#pragma once
// Vectors of rationals, for what is decided rarely.

#include <sightline/kernel/partition_traits.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <vector>

namespace sightline {

namespace priority_detail {

inline Exact_point minus(const Exact_point& a, const Exact_point& b) { return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])}; }
inline Rational dot(const Exact_point& a, const Exact_point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Exact_point cross(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[1] * b[2] - a[2] * b[1]), Rational(a[2] * b[0] - a[0] * b[2]), Rational(a[0] * b[1] - a[1] * b[0])};
}

/// The corners of a polygon.
template <class Traits>
std::vector<Exact_point> positions(const Traits& traits, const Convex_polygon<Traits>& polygon) {
  std::vector<Exact_point> points;
  for (const Corner<Traits>& corner : polygon) points.push_back(traits.position(*corner.vertex));
  return points;
}
}  // namespace priority_detail

}  // namespace sightline
