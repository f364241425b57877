#pragma once
// A region: a convex cone of directions, and how a plane through the eye cuts it.

#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/sign.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sightline::visible_detail {

/// Side k holds rays k and k + 1, the inside in its front.
template <View V>
using Region = typename Visible_surface<V>::Cone;

/// The parts of a region in front of a plane and behind it. Pre: it has parts of the region on both sides; where
/// inexact signs only say so, a part may have fewer than three rays.
template <View V>
std::array<Region<V>, 2> cut(const V& view, const Region<V>& region, const typename V::Plane& w,
                             Predicate_counts& counts) {
  const std::size_t n = region.rays.size();
  std::vector<Sign> sides(n);
  for (std::size_t k = 0; k < n; ++k) sides[k] = view.side(w, region.rays[k], counts);
  std::array<Region<V>, 2> parts;
  const auto add = [&](std::size_t part, const typename V::Ray& ray, const typename V::Plane& side) {
    parts[part].rays.push_back(ray);
    parts[part].sides.push_back(side);
  };
  const typename V::Plane against = view.opposite(w);
  for (std::size_t k = 0; k < n; ++k) {
    const Sign from = sides[k], to = sides[k + 1 == n ? 0 : k + 1];
    // A ray, with the side that follows it.
    if (from != CGAL::NEGATIVE)
      add(0, region.rays[k], from == CGAL::POSITIVE || to == CGAL::POSITIVE ? region.sides[k] : w);
    if (from != CGAL::POSITIVE)
      add(1, region.rays[k], from == CGAL::NEGATIVE || to == CGAL::NEGATIVE ? region.sides[k] : against);
    if (from * to >= 0) continue;
    // The ray where the plane crosses a side.
    const typename V::Ray crossing =
        from == CGAL::POSITIVE ? view.meet(region.sides[k], w, counts) : view.meet(w, region.sides[k], counts);
    add(0, crossing, from == CGAL::POSITIVE ? w : region.sides[k]);
    add(1, crossing, from == CGAL::POSITIVE ? region.sides[k] : against);
  }
  return parts;
}

/// Whether a plane of that name is a side of the region.
template <class Cone>
bool has_side(const Cone& region, Eye_plane_name name) {
  return std::any_of(region.sides.begin(), region.sides.end(), [&](const auto& w) { return w.name == name; });
}

/// A direction inside a region, approximately.
template <View V>
Approximate_vector middle_of(const V& view, const Region<V>& region) {
  Approximate_vector sum{0, 0, 0};
  for (const typename V::Ray& r : region.rays) {
    const Approximate_vector v = view.approximate(r);
    const double size = std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
    if (size > 0) {
      sum.x += v.x / size;
      sum.y += v.y / size;
      sum.z += v.z / size;
    }
  }
  return sum;
}

}  // namespace sightline::visible_detail
