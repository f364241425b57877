// What the corners of a source are: held to the definition in rationals.

#include "../sample.h"

#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/vectors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

namespace weak_sources {
namespace {

using namespace sightline;
using generate::Random;

using Corners = std::vector<Exact_point>;

/// The corners at which a polygon turns left around its own normal, if it turns nowhere to the right and each of its
/// corners is to the left of all its edges. By the law, in three dimensions.
std::optional<Corners> strict_by_definition(const Corners& points) {
  Corners corners;
  for (const Exact_point& p : points)
    if (corners.empty() || corners.back() != p) corners.push_back(p);
  while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
  if (corners.size() < 3) return {};
  Exact_point normal{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Exact_point part = cross(corners[i], corners[(i + 1) % corners.size()]);
    for (std::size_t k = 0; k < 3; ++k) normal[k] += part[k];
  }
  if (normal == Exact_point{0, 0, 0}) return {};
  const auto turn = [&](const Exact_point& a, const Exact_point& b, const Exact_point& c) {
    return sgn(dot(normal, cross(minus(b, a), minus(c, b))));
  };
  Corners strict;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (sgn(dot(normal, minus(corners[i], corners[0]))) != 0) return {};
    const Exact_point &before = corners[(i + corners.size() - 1) % corners.size()],
                      &after = corners[(i + 1) % corners.size()];
    const int side = turn(before, corners[i], after);
    if (side < 0 || (side == 0 && sgn(dot(minus(corners[i], before), minus(after, corners[i]))) < 0)) return {};
    if (side > 0) strict.push_back(corners[i]);
  }
  for (std::size_t i = 0; i < strict.size(); ++i)
    for (const Exact_point& p : strict)
      if (turn(strict[i], strict[(i + 1) % strict.size()], p) < 0) return {};
  return strict;
}

/// A polygon of a few points of a lattice, some beside it by so little that doubles do not tell, in any plane.
Corners drawn_polygon(Random& random) {
  const auto small = [&](std::int64_t most) { return Rational(static_cast<long>(random.between(-most, most))); };
  const Exact_point at{small(9), small(9), small(9)}, u{small(3), small(3), small(3)}, v{small(3), small(3), small(3)};
  // Around a square, so that many are convex, with points on its sides; or anywhere.
  static constexpr int around[12][2] = {{0, 0}, {1, 0}, {2, 0}, {4, 0}, {4, 1}, {4, 4},
                                        {3, 4}, {2, 4}, {0, 4}, {0, 2}, {0, 1}, {0, 3}};
  const bool is_any = random.chance(1, 4), runs_back = random.chance(1, 2);
  const Rational scale = generate::power_of_two(static_cast<int>(random.between(-600, 600)));
  Corners corners;
  for (int i = 0; i < 11; ++i) {
    if (random.chance(1, 3)) continue;
    Rational x = is_any ? small(2) : Rational(around[i][0]), y = is_any ? small(2) : Rational(around[i][1]);
    if (random.chance(1, 3)) {
      const Rational little = generate::power_of_two(-static_cast<int>(random.between(40, 90)));
      (random.chance(1, 2) ? x : y) += random.chance(1, 2) ? little : Rational(-little);
    }
    Exact_point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = scale * (at[k] + x * u[k] + y * v[k]);
    corners.push_back(p);
    if (random.chance(1, 12)) corners.push_back(p);
  }
  if (runs_back) std::reverse(corners.begin(), corners.end());
  return corners;
}

TEST(Sources, have_the_strict_corners_of_the_definition_wherever_they_lie) {
  Random random(1);
  std::size_t convex = 0, refused = 0, with_straight_corners = 0;
  const int polygons = test_scenes::is_sanitized() ? 400 : 4000;
  for (int i = 0; i < polygons; ++i) {
    const Corners polygon = drawn_polygon(random);
    const std::optional<Corners> expected = strict_by_definition(polygon);
    std::optional<Corners> found;
    try {
      found = strict_corners(polygon);
    } catch (const std::invalid_argument&) {
    }
    ASSERT_EQ(found, expected) << "polygon " << i;
    ++(expected ? convex : refused);
    with_straight_corners += expected && expected->size() < polygon.size() ? 1u : 0u;
  }
  const std::size_t share = static_cast<std::size_t>(polygons) / 40;
  EXPECT_GT(convex, 3 * share);
  EXPECT_GT(refused, 3 * share);
  EXPECT_GT(with_straight_corners, share);
}

TEST(Sources, that_go_around_twice_are_refused) {
  const Corners triangle{{0, 0, 0}, {4, 0, 1}, {0, 4, 1}},
      square{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  for (const Corners& once : {triangle, square}) {
    EXPECT_EQ(strict_corners(once).size(), once.size() == 3 ? 3u : 4u);
    Corners twice = once;
    twice.insert(twice.end(), once.begin(), once.end());
    EXPECT_THROW(strict_corners(twice), std::invalid_argument);
    std::reverse(twice.begin(), twice.end());
    EXPECT_THROW(strict_corners(twice), std::invalid_argument);
  }
}

}  // namespace
}  // namespace weak_sources
