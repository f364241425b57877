// Convex polygons as cycles of lines: exact areas of what is cut.

#include "support.h"

#include <rapidcheck/gtest.h>

#include <sightline/harness/compare/flat_polygon.h>
#include <sightline/harness/generate/random.h>

using namespace compare_test;

namespace {

using Point = Flat_polygon::Point;
using Corners = std::vector<Point>;

Flat_polygon box(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1) {
  return Flat_polygon::hull({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}
Rational area(const std::vector<Flat_polygon>& polygons) {
  Rational sum = 0;
  for (const Flat_polygon& polygon : polygons) sum += polygon.area();
  return sum;
}
/// a ∩ b by clipping.
Flat_polygon common(Flat_polygon a, const Flat_polygon& b) {
  for (const Flat_polygon::Flat_line& h : b.lines()) a = a.clipped(h);
  return a;
}
Corners random_points(generate::Random& random) {
  Corners points(random.below(9));
  const std::int64_t reach = random.chance(1, 2) ? 3 : 40;
  for (Point& p : points)
    for (Rational& x : p)
      x = ratio(static_cast<long>(random.between(-reach, reach)),
                static_cast<long>(random.chance(1, 3) ? random.between(1, 5) : 1));
  return points;
}

TEST(Flat_polygon_hull, of_fewer_than_three_corners_is_empty) {
  EXPECT_TRUE(Flat_polygon::hull({}).empty());
  EXPECT_TRUE(Flat_polygon::hull({{1, 1}}).empty());
  EXPECT_TRUE(Flat_polygon::hull({{1, 1}, {2, 3}}).lines().empty());
  EXPECT_TRUE(Flat_polygon::hull({{1, 1}, {1, 1}, {2, 3}, {2, 3}}).empty());
  EXPECT_TRUE(Flat_polygon::hull({{0, 0}, {2, 2}, {1, 1}, {3, 3}, {3, 3}}).empty());
  EXPECT_TRUE(Flat_polygon::hull({{5, 0}, {5, 2}, {5, 1}}).empty());
  EXPECT_EQ(Flat_polygon::hull({{0, 0}, {2, 2}}).area(), 0);
}

TEST(Flat_polygon_hull, leaves_out_inner_and_straight_points_in_any_order) {
  Corners points{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}, {1, 1}, {0, 0}};
  std::sort(points.begin(), points.end());
  for (int k = 0; k < 50; ++k) {
    std::rotate(points.begin(), points.begin() + 3, points.end());
    std::swap(points[static_cast<std::size_t>(k) % points.size()], points[0]);
    const Flat_polygon hull = Flat_polygon::hull(points);
    ASSERT_EQ(hull.lines().size(), 4u);
    ASSERT_EQ(hull.area(), 4);
  }
  EXPECT_EQ(Flat_polygon::hull({{0, 0}, {3, 0}, {0, 1}}).area(), ratio(3, 2));
  EXPECT_EQ(Flat_polygon::hull({{0, 1}, {3, 0}, {0, 0}}).area(), ratio(3, 2)) << "counterclockwise whatever was given";
}

TEST(Flat_polygon_hull, has_coprime_lines_with_the_inside_positive) {
  const Flat_polygon hull = Flat_polygon::hull({{ratio(1, 3), 0}, {ratio(5, 3), 0}, {1, ratio(7, 11)}});
  for (const Flat_polygon::Flat_line& h : hull.lines()) {
    EXPECT_EQ(gcd(gcd(h[0], h[1]), h[2]), 1);
    EXPECT_GT(Rational(h[0] * Rational(1) + h[1] * ratio(1, 10) + h[2]), 0);
  }
}

TEST(Flat_polygon_clip, by_hand) {
  const Flat_polygon square = box(0, 2, 0, 2);
  EXPECT_EQ(square.clipped({1, 0, -1}).area(), 2);
  EXPECT_EQ(square.clipped({-1, 0, 1}).area(), 2);
  EXPECT_EQ(square.clipped({-1, -1, 1}).area(), ratio(1, 2)) << "a corner";
  EXPECT_EQ(square.clipped({1, 1, -1}).area(), ratio(7, 2)) << "all but a corner";
  EXPECT_EQ(square.clipped({1, -1, 0}).area(), 2) << "through two corners";
  EXPECT_EQ(square.clipped({1, -1, 0}).lines().size(), 3u);
  EXPECT_EQ(square.clipped({2, -1, 0}).area(), 3) << "through one corner";
  EXPECT_EQ(square.clipped({2, -1, 0}).lines().size(), 4u);
  EXPECT_EQ(square.clipped({1, 0, 0}).area(), 4) << "along an edge, inside positive";
  EXPECT_EQ(square.clipped({1, 0, 0}).lines().size(), 4u);
  EXPECT_TRUE(square.clipped({-1, 0, 0}).empty()) << "along an edge, inside negative";
  EXPECT_TRUE(square.clipped({-1, -1, 0}).empty()) << "touching a corner";
  EXPECT_EQ(square.clipped({1, 1, 0}).area(), 4);
  EXPECT_EQ(square.clipped({1, 1, 0}).lines().size(), 4u) << "no line that only touches";
  EXPECT_TRUE(square.clipped({1, 0, -3}).empty());
  EXPECT_EQ(square.clipped({1, 0, 3}).area(), 4);
  EXPECT_TRUE(Flat_polygon().clipped({1, 0, 0}).empty());
}

TEST(Flat_polygon_without, by_hand) {
  const Flat_polygon square = box(0, 3, 0, 3);
  EXPECT_EQ(area(square.without(box(1, 2, 1, 2))), 8);
  EXPECT_EQ(square.without(box(1, 2, 1, 2)).size(), 4u);
  EXPECT_EQ(area(square.without(Flat_polygon())), 9) << "without nothing";
  EXPECT_TRUE(square.without(square).empty());
  EXPECT_TRUE(square.without(box(-1, 4, -1, 4)).empty());
  EXPECT_EQ(area(square.without(box(5, 6, 5, 6))), 9);
  EXPECT_EQ(area(square.without(box(3, 6, 0, 3))), 9) << "they share an edge";
  EXPECT_EQ(area(square.without(box(2, 5, 2, 5))), 8);
  EXPECT_TRUE(Flat_polygon().without(square).empty());
}

RC_GTEST_PROP(Flat_polygon_area, of_a_is_that_of_a_and_b_plus_that_of_a_without_b, ()) {
  generate::Random random(*rc::gen::arbitrary<std::uint64_t>());
  for (int k = 0; k < 30; ++k) {
    const Flat_polygon a = Flat_polygon::hull(random_points(random)), b = Flat_polygon::hull(random_points(random));
    const Rational both = b.empty() ? Rational(0) : common(a, b).area();
    RC_ASSERT(a.area() == Rational(both + area(a.without(b))));
    RC_ASSERT(both == (a.empty() ? Rational(0) : common(b, a).area()));
    RC_ASSERT(sgn(a.area()) == (a.empty() ? 0 : 1));
    for (const Flat_polygon& piece : a.without(b)) {
      if (a.empty()) continue;
      RC_ASSERT(sgn(piece.area()) > 0);
      RC_ASSERT(b.empty() || common(piece, b).area() == 0);
      RC_ASSERT(common(piece, a).area() == piece.area());
    }
  }
}

RC_GTEST_PROP(Flat_polygon_area, is_the_sum_of_the_parts_on_both_sides_of_a_line, ()) {
  generate::Random random(*rc::gen::arbitrary<std::uint64_t>());
  for (int k = 0; k < 30; ++k) {
    const Flat_polygon a = Flat_polygon::hull(random_points(random));
    Flat_polygon::Flat_line h{static_cast<long>(random.between(-3, 3)), static_cast<long>(random.between(-3, 3)),
                              static_cast<long>(random.between(-9, 9))};
    if (h[0] == 0 && h[1] == 0) h[0] = 1;
    const Flat_polygon front = a.clipped(h), behind = a.clipped({Integer(-h[0]), Integer(-h[1]), Integer(-h[2])});
    RC_ASSERT(Rational(front.area() + behind.area()) == a.area());
    RC_ASSERT(front.empty() == (front.area() == 0));
    RC_ASSERT(front.lines().size() <= a.lines().size() + 1);
  }
}

RC_GTEST_PROP(Flat_polygon_area, of_a_hull_is_the_most_that_any_triangle_fan_of_its_points_has, ()) {
  // By Pick's theorem on lattice polygons: 2 area is an integer; and the hull holds every triangle of the points.
  generate::Random random(*rc::gen::arbitrary<std::uint64_t>());
  const Corners points = random_points(random);
  const Flat_polygon hull = Flat_polygon::hull(points);
  for (const Point& p : points) {
    for (const Flat_polygon::Flat_line& h : hull.lines()) RC_ASSERT(Rational(h[0] * p[0] + h[1] * p[1] + h[2]) >= 0);
    if (points.size() < 3) continue;
    const Flat_polygon triangle = Flat_polygon::hull({p, points[0], points[1]});
    RC_ASSERT(triangle.area() <= hull.area());
    if (!triangle.empty()) RC_ASSERT(area(triangle.without(hull)) == 0);
  }
}

}  // namespace
