#pragma once
// What tests of visible surfaces share: the surface as polygons, and who is seen in a direction.

#include "oracle.h"
#include "scenes.h"

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible.h>

#include <gtest/gtest.h>

namespace sightline::see_test {

/// The parts of each piece, for all pieces.
template <View V>
std::vector<std::vector<std::vector<Exact_point>>> polygons(const V& view, const Visible_surface<V>& surface) {
  std::vector<std::vector<std::vector<Exact_point>>> of(view.scene().pieces().size());
  for (const auto& part : surface.parts)
    if (part.piece != surface.nothing) of[part.piece].push_back(vertices(view, surface, part));
  return of;
}

/// The parts whose closed cone holds a direction, as rationals say.
inline std::vector<std::uint32_t> seen_in(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                          const Exact_point& direction) {
  std::vector<std::uint32_t> found;
  for (const auto& part : surface.parts) {
    const auto rays = surface.of(part);
    bool inside = true;
    for (std::size_t k = 0; k < rays.size() && inside; ++k) {
      const auto a = view.direction(rays[k]), b = view.direction(rays[k + 1 == rays.size() ? 0 : k + 1]);
      Rational determinant = 0;
      for (std::size_t i = 0; i < 3; ++i)
        determinant += direction[i] * (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
      inside = determinant >= 0;
    }
    if (inside) found.push_back(part.piece);
  }
  return found;
}

/// Of each piece the same points, with the same area, in its plane.
template <class Parts, class Others>
void expect_same_points(const oracle::Flats& flats, const Parts& parts, const Others& expected) {
  for (std::size_t i = 0; i < flats.size(); ++i) {
    const Exact_point& normal = flats[i].plane.normal;
    for (const auto& part : parts[i])
      for (std::size_t k = 0; k < part.size(); ++k) {  // in its plane, and counterclockwise as seen from the front
        ASSERT_EQ(flats[i].height(part[k]), 0);
        const Exact_point turn = oracle::cross(oracle::minus(part[(k + 1) % part.size()], part[k]),
                                               oracle::minus(part[(k + 2) % part.size()], part[(k + 1) % part.size()]));
        ASSERT_GE(oracle::dot(turn, normal), 0) << "face " << flats[i].face;
      }
    ASSERT_EQ(oracle::projected_area(parts[i], normal), oracle::projected_area(expected[i], normal))
        << "face " << flats[i].face;
    ASSERT_TRUE(oracle::same_points(parts[i], expected[i], normal)) << "face " << flats[i].face;
  }
}

}  // namespace sightline::see_test
