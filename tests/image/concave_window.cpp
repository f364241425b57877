// Polygons with holes in concave windows with holes: by hand where borders coincide and corners touch, and against sums
// over triangles.

#include "../sample.h"

#include <sightline/algorithms/image/concave_window.h>
#include <sightline/harness/generate/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace concave_window_test {

using namespace sightline;
using generate::Random;

namespace {

using Polygons = std::vector<Image_polygon>;

Image_loop square(const Rational& x, const Rational& y, const Rational& side = 1) {
  return {{x, y}, {Rational(x + side), y}, {Rational(x + side), Rational(y + side)}, {x, Rational(y + side)}};
}
Image_loop turned_back(Image_loop loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

// ---- Oracles, which share nothing with what they judge

Rational turn(const Image_point& p, const Image_point& q, const Image_point& r) {
  return Rational((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
}
/// The part of a convex polygon to the left of a line.
Image_loop left_of(const Image_loop& convex, const Image_point& p, const Image_point& q) {
  Image_loop part;
  for (std::size_t k = 0; k < convex.size(); ++k) {
    const Image_point &a = convex[k], &b = convex[(k + 1) % convex.size()];
    const Rational of_a = turn(p, q, a), of_b = turn(p, q, b);
    if (of_a >= 0) part.push_back(a);
    if (sgn(of_a) * sgn(of_b) < 0) {
      const Rational t = of_a / (of_a - of_b);
      part.push_back({Rational(a[0] + t * (b[0] - a[0])), Rational(a[1] + t * (b[1] - a[1]))});
    }
  }
  return part;
}
Rational shoelace(const Image_loop& loop) {
  Rational twice = 0;
  for (std::size_t k = 2; k < loop.size(); ++k) twice += turn(loop[0], loop[k - 1], loop[k]);
  return twice / 2;
}

/// A triangle with the sense of its edge as seen from the origin: these add up to a polygon.
struct Signed_triangle {
  Image_loop corners;
  int sign;
};
std::vector<Signed_triangle> triangles_of(const Polygons& polygons) {
  std::vector<Signed_triangle> triangles;
  const auto add = [&](const Image_loop& loop, int wanted) {
    const int sense = sgn(shoelace(loop)) * wanted;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Image_loop corners{{0, 0}, loop[k], loop[(k + 1) % loop.size()]};
      const int sign = sgn(shoelace(corners));
      if (sign < 0) std::swap(corners[1], corners[2]);
      if (sign != 0) triangles.push_back({corners, sign * sense});
    }
  };
  for (const Image_polygon& polygon : polygons) {
    add(polygon.outer, 1);
    for (const Image_loop& hole : polygon.holes) add(hole, -1);
  }
  return triangles;
}
Rational common_area(const Polygons& a, const Polygons& b) {
  Rational sum = 0;
  const std::vector<Signed_triangle> of_a = triangles_of(a), of_b = triangles_of(b);
  for (const Signed_triangle& s : of_a)
    for (const Signed_triangle& t : of_b) {
      Image_loop both = s.corners;
      for (std::size_t k = 0; k < 3; ++k) both = left_of(both, t.corners[k], t.corners[(k + 1) % 3]);
      sum += s.sign * t.sign * shoelace(both);
    }
  return sum;
}
Rational total_area(const Polygons& polygons) {
  Rational sum = 0;
  for (const Image_polygon& polygon : polygons) sum += area(polygon);
  return sum;
}

bool are_crossing(const Image_point& a, const Image_point& b, const Image_point& c, const Image_point& d) {
  return sgn(turn(a, b, c)) * sgn(turn(a, b, d)) < 0 && sgn(turn(c, d, a)) * sgn(turn(c, d, b)) < 0;
}

/// What a result has to be, whatever it is a result of.
void expect_regular(const Polygons& polygons, const std::string& label) {
  std::vector<std::pair<Image_point, Image_point>> edges;
  const auto look_at = [&](const Image_loop& loop, int sense) {
    ASSERT_GE(loop.size(), 3u) << label;
    EXPECT_EQ(sgn(shoelace(loop)), sense) << label;
    EXPECT_EQ(std::set<Image_point>(loop.begin(), loop.end()).size(), loop.size()) << label;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      EXPECT_NE(turn(loop[k], loop[(k + 1) % loop.size()], loop[(k + 2) % loop.size()]), 0) << label;
      edges.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
    }
  };
  for (const Image_polygon& polygon : polygons) {
    look_at(polygon.outer, 1);
    EXPECT_GT(area(polygon), 0) << label;
    for (const Image_loop& hole : polygon.holes) {
      look_at(hole, -1);
      EXPECT_EQ(common_area({{polygon.outer, {}}}, {{hole, {}}}), -shoelace(hole)) << label;  // it is in its outer loop
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(are_crossing(edges[i].first, edges[i].second, edges[j].first, edges[j].second)) << label;
}

Clipped_polygons expect_clipped(const Polygons& polygons, const Polygons& window, const std::string& label) {
  const Clipped_polygons made = clip_to_window(polygons, window);
  expect_regular(made.inside, label);
  expect_regular(made.outside, label);
  const Rational common = common_area(polygons, window), whole = common_area(polygons, polygons);
  EXPECT_EQ(total_area(made.inside), common) << label;
  EXPECT_EQ(total_area(made.outside), whole - common) << label;
  // Each where it is said to be: so the areas are not just as large.
  EXPECT_EQ(common_area(made.inside, polygons), common) << label;
  EXPECT_EQ(common_area(made.inside, window), common) << label;
  EXPECT_EQ(common_area(made.outside, polygons), whole - common) << label;
  EXPECT_EQ(common_area(made.outside, window), 0) << label;
  EXPECT_EQ(total_area(clip_to_window(window, polygons).inside), common) << label;
  return made;
}

// ---- By hand

/// A frame: a square of 6 with a hole of 2 in its middle.
const Image_polygon frame{square(0, 0, 6), {turned_back(square(2, 2, 2))}};

TEST(Concave_window, with_a_hole_has_it_outside) {
  const Clipped_polygons made = expect_clipped({{square(1, 1, 4), {}}}, {frame}, "a square over the hole");
  ASSERT_EQ(made.inside.size(), 1u);
  EXPECT_EQ(made.inside[0].holes.size(), 1u);
  EXPECT_EQ(area(made.inside[0]), 12);
  ASSERT_EQ(made.outside.size(), 1u);
  EXPECT_EQ(made.outside[0].outer.size(), 4u);
  EXPECT_EQ(area(made.outside[0]), 4);
}

TEST(Concave_window, that_is_the_polygon_has_all_of_it) {
  for (const Image_polygon& same :
       {frame, Image_polygon{turned_back(frame.outer), {turned_back(frame.holes[0])}}}) {  // in any sense
    const Clipped_polygons made = expect_clipped({frame}, {same}, "itself");
    ASSERT_EQ(made.inside.size(), 1u);
    EXPECT_EQ(made.inside[0].outer.size(), 4u);
    EXPECT_EQ(made.inside[0].holes.size(), 1u);
    EXPECT_TRUE(made.outside.empty());
  }
}

TEST(Concave_window, that_is_the_hole_has_nothing_and_with_it_all) {
  const Polygons hole{{square(2, 2, 2), {}}};
  EXPECT_TRUE(expect_clipped({frame}, hole, "its hole").inside.empty());
  EXPECT_EQ(expect_clipped(hole, {frame}, "in the hole").outside.size(), 1u);
  const Clipped_polygons made = expect_clipped({{square(0, 0, 6), {}}}, {frame, hole[0]}, "frame and hole");
  ASSERT_EQ(made.inside.size(), 1u);  // edges that both share are none
  EXPECT_TRUE(made.inside[0].holes.empty());
  EXPECT_EQ(made.inside[0].outer.size(), 4u);
}

TEST(Concave_window, that_shares_edges_or_touches_in_corners_has_what_has_an_area) {
  const Polygons one{{square(0, 0, 2), {}}};
  EXPECT_TRUE(expect_clipped(one, {{square(2, 0, 2), {}}}, "an edge").inside.empty());
  EXPECT_TRUE(expect_clipped(one, {{square(2, 2, 2), {}}}, "a corner").inside.empty());
  EXPECT_TRUE(expect_clipped(one, {{square(2, 1, 2), {}}}, "half an edge").inside.empty());
  EXPECT_EQ(total_area(expect_clipped(one, {{square(1, 0, 2), {}}}, "parts of two edges").inside), 2);
  EXPECT_EQ(total_area(expect_clipped(one, {{square(0, 0, 1), {}}}, "a corner inside").inside), 1);
  // A corner in the middle of an edge from inside, twice.
  const Image_loop diamond{{1, 0}, {2, 1}, {1, 2}, {0, 1}};
  const Clipped_polygons made = expect_clipped(one, {{diamond, {}}}, "a diamond in a square");
  EXPECT_EQ(total_area(made.inside), 2);
  EXPECT_EQ(made.outside.size(), 4u);
}

TEST(Concave_window, cuts_a_polygon_into_several) {
  // A comb of three teeth over a bar, and the bar through a ring.
  const Image_loop comb{{0, 0}, {10, 0}, {10, 8}, {8, 8}, {8, 2}, {6, 2},
                        {6, 8}, {4, 8},  {4, 2},  {2, 2}, {2, 8}, {0, 8}};
  const Polygons bar{{{{-1, 4}, {11, 4}, {11, 6}, {-1, 6}}, {}}};
  const Clipped_polygons made = expect_clipped(bar, {{comb, {}}}, "a comb");
  EXPECT_EQ(made.inside.size(), 3u);
  EXPECT_EQ(made.outside.size(), 4u);
  const Polygons across{{{{-1, 2}, {7, 2}, {7, 4}, {-1, 4}}, {}}};
  const Clipped_polygons ring = expect_clipped({{square(0, 0, 6), {square(1, 1, 4)}}}, across, "a ring by a bar");
  EXPECT_EQ(ring.inside.size(), 2u);
  EXPECT_EQ(ring.outside.size(), 2u);
}

TEST(Concave_window, with_holes_that_touch_keeps_loops_apart) {
  // Two holes with a corner in common, one of which has a corner on the outer loop.
  const Image_polygon window{square(0, 0, 6), {{{0, 3}, {2, 4}, {2, 2}}, {{2, 2}, {4, 3}, {4, 1}}}};
  const Clipped_polygons made = expect_clipped({{square(0, 0, 6), {}}}, {window}, "touching holes");
  ASSERT_EQ(made.inside.size(), 1u);
  EXPECT_EQ(made.inside[0].holes.size(), 2u);
  EXPECT_EQ(made.outside.size(), 2u);
  // An island in the hole.
  const Polygons island{frame, {square(Rational(5, 2), Rational(5, 2)), {}}};
  EXPECT_EQ(expect_clipped({{square(0, 0, 6), {}}}, island, "an island").inside.size(), 2u);
}

TEST(Concave_window, of_nothing_or_in_nothing_is_no_error) {
  EXPECT_TRUE(clip_to_window({}, std::vector{frame}).inside.empty());
  const Clipped_polygons made = clip_to_window(std::vector{frame}, {});
  EXPECT_TRUE(made.inside.empty());
  EXPECT_EQ(total_area(made.outside), 32);
  const Polygons flat{{{{0, 0}, {3, 3}, {1, 1}}, {}}, {{}, {}}};
  EXPECT_TRUE(clip_to_window(flat, std::vector{frame}).inside.empty());
  // Repeated and straight corners, and a spike.
  const Image_polygon odd{{{0, 0}, {0, 0}, {3, 0}, {6, 0}, {6, 6}, {9, 9}, {6, 6}, {0, 6}}, {}};
  EXPECT_EQ(expect_clipped({odd}, {{square(0, 0, 6), {}}}, "a spike").inside[0].outer.size(), 4u);
}

TEST(Concave_window, refuses_what_overlaps) {
  const Polygons twice{{square(0, 0, 2), {}}, {square(1, 1, 2), {}}};
  EXPECT_THROW(clip_to_window(twice, std::vector{frame}), std::invalid_argument);
  EXPECT_THROW(clip_to_window(std::vector{frame}, twice), std::invalid_argument);
  const Image_polygon bow{{{0, 0}, {2, 2}, {3, 0}, {0, 3}}, {}};
  EXPECT_THROW(clip_to_window(std::vector{bow}, std::vector{frame}), std::invalid_argument);
  EXPECT_THROW(clip_to_window(std::vector{Image_polygon{square(0, 0), {square(2, 2)}}}, {}), std::invalid_argument);
}

// ---- At random

/// Some unit squares of a board, moved and sheared: all that touches touches in edges and corners.
Polygons any_board(Random& random, const Rational& shift, const Rational& slant) {
  Polygons cells;
  for (long x = 0; x < 4; ++x)
    for (long y = 0; y < 4; ++y)
      if (random.chance(1, 2)) {
        Image_polygon& cell = cells.emplace_back(Image_polygon{square(x, y), {}});
        for (Image_point& p : cell.outer) p = {Rational(p[0] + shift + slant * p[1]), Rational(p[1] - 2)};
      }
  return cells;
}
/// A star around the origin with a smaller one as its hole, on a lattice: corners of one lie on the other's edges.
Image_polygon any_star(Random& random) {
  static const Image_loop round{{4, 0},  {4, 2},   {4, 4},   {2, 4},   {0, 4},  {-2, 4}, {-4, 4}, {-4, 2},
                                {-4, 0}, {-4, -2}, {-4, -4}, {-2, -4}, {0, -4}, {2, -4}, {4, -4}, {4, -2}};
  Image_loop outer, hole;
  for (const Image_point& p : round) {
    const Rational far = static_cast<long>(2 + random.below(3)), near = static_cast<long>(1 + random.below(2));
    outer.push_back({Rational(p[0] * far / 2), Rational(p[1] * far / 2)});
    hole.push_back({Rational(p[0] * near / 4), Rational(p[1] * near / 4)});
  }
  return {outer, {hole}};
}

TEST(Concave_window, of_boards_and_stars_has_the_areas_of_all_pairs_of_triangles) {
  const std::uint64_t seeds = test_scenes::sample(60u);
  std::size_t holes = 0, several = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Random random(seed);
    const auto any = [&]() -> Polygons {
      if (random.chance(1, 2)) return {any_star(random)};
      const Rational shift = Rational(static_cast<long>(random.below(5))) / 2 - 3;
      return any_board(random, shift, Rational(static_cast<long>(random.below(3))) / 2);
    };
    const Polygons polygons = any(), window = any();
    const Clipped_polygons made = expect_clipped(polygons, window, "seed " + std::to_string(seed));
    for (const Image_polygon& polygon : made.inside) holes += polygon.holes.size();
    several += made.inside.size() > 1;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(holes, test_scenes::least(8u));
  EXPECT_GT(several, test_scenes::least(20u));
}

}  // namespace

}  // namespace concave_window_test
