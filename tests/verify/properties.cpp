// Orders known by construction, and the test of pairs against a clipping of polygons in space.

#include "../products.h"
#include "../sample.h"
#include "scenes.h"

#include <sightline/algorithms/verify/pairs.h>
#include <sightline/algorithms/verify/polygons.h>

namespace {

using test_scenes::least;
using test_scenes::sample;

using namespace verify_test;

TEST(Newell_normal, of_fractions_with_long_denominators_is_the_sum_of_its_triangles) {
  Dice dice(11);
  for (const std::size_t corners : {3u, 4u, 5u, 8u, 13u}) {
    Points loop;
    for (std::size_t k = 0; k < corners; ++k) {
      Exact_point& p = loop.emplace_back();
      for (Rational& x : p) {
        Integer denominator = 1;
        for (int word = 0; word < 40; ++word) denominator = (denominator << 20) + roll(dice, 1, 1000000);
        x = Rational(Integer(roll(dice, -1000, 1000)), Integer(2 * denominator + 1));
        x.canonicalize();
      }
    }
    Exact_point sum;
    for (std::size_t k = 0; k < corners; ++k) {
      const Exact_point &p = loop[k], &q = loop[(k + 1) % corners];
      for (std::size_t i = 0; i < 3; ++i) sum[i] += p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3];
    }
    EXPECT_EQ(certificate_check::newell_normal(loop), certificate_check::primitive(sum)) << corners;
  }
}

/// An affine map of space with small integers. Post: invertible; sometimes mirrored.
struct Affine {
  std::array<std::array<long, 3>, 3> rows{};
  explicit Affine(Dice& dice) {
    const auto determinant = [&] {
      const auto& m = rows;
      return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    };
    do
      for (auto& row : rows)
        for (long& entry : row) entry = roll(dice, -3, 3);
    while (determinant() == 0);
  }
  Exact_point operator()(const Exact_point& p) const {
    Exact_point q;
    for (std::size_t r = 0; r < 3; ++r)
      q[r] = Rational(rows[r][0] * p[0] + rows[r][1] * p[1] + rows[r][2] * p[2] + static_cast<long>(r));
    return q;
  }
  Points operator()(Points points) const {
    for (Exact_point& p : points) p = (*this)(p);
    return points;
  }
};

TEST(Random_stacks, are_accepted_in_their_order_and_rejected_with_two_exchanged) {
  for (unsigned seed = 0; seed < sample(1000u); ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const bool tilted = roll(dice, 0, 1) == 1;
    const long count = roll(dice, 2, 7);
    const Affine map(dice);
    // Quad k lies strictly between the heights k and k + 1; those on the axis all overlap in the view from the axis.
    std::vector<Points> stack;
    std::vector<std::size_t> on_axis;
    for (long k = 0; k < count; ++k) {
      const bool axis = k < 2 || roll(dice, 0, 2) > 0;
      const long x0 = roll(dice, -6, -1), y0 = roll(dice, -6, -1), shift = axis ? 0 : roll(dice, 2, 9);
      const Rational a = tilted ? ratio(roll(dice, -5, 5), 200) : Rational(0),
                     b = tilted ? ratio(roll(dice, -5, 5), 200) : Rational(0);
      Points quad = rectangle(x0 + shift, roll(dice, 1, 3) + shift, y0, roll(dice, 1, 6), 0);
      for (Exact_point& p : quad) p[2] = k + ratio(1, 2) + a * (p[0] - shift) + b * p[1];
      if (roll(dice, 0, 1)) quad = reversed(quad);
      stack.push_back(map(quad));
      if (axis) on_axis.push_back(static_cast<std::size_t>(k));
    }
    const bool from_above = roll(dice, 0, 1) == 1;
    Scene empty;
    empty.seen_from(map(at(0, 0, from_above ? count + roll(dice, 0, 50) : -roll(dice, 0, 50))));
    for (const Points& quad : stack) empty.face(quad);
    std::vector<Face_id> order;
    for (Face_id f = 0; f < stack.size(); ++f)
      order.push_back(from_above ? f : static_cast<Face_id>(stack.size() - 1 - f));
    const auto drawn = [&] {
      Scene scene = empty;
      for (const Face_id f : order) scene.draw(f, stack[f]);
      return scene;
    };
    expect_accepted(drawn());
    const std::size_t k = dice() % (on_axis.size() - 1);
    std::swap(*std::find(order.begin(), order.end(), on_axis[k]),
              *std::find(order.begin(), order.end(), on_axis[k + 1]));
    const Verdict verdict = drawn().verdict();
    EXPECT_FALSE(verdict.accepted);
    EXPECT_NE(verdict.why.find("is nearer"), std::string::npos) << verdict.why;
    EXPECT_EQ(verdict.fragments.size(), 2u);
  }
}

// ---- The oracle: clip polygon a in space by the planes through the eye (the origin) and b's edges

Rational determinant(const Exact_point& a, const Exact_point& b, const Exact_point& c) {
  return test_scenes::dot(test_scenes::cross(a, b), c);
}

Points clipped(Points a, const Points& b) {
  Exact_point middle;
  for (const Exact_point& p : b)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k];
  for (std::size_t j = 0; j < b.size(); ++j) {
    const Exact_point &b0 = b[j], &b1 = b[(j + 1) % b.size()];
    const Exact_point n = test_scenes::cross(b0, b1);
    const int inner = sgn(test_scenes::dot(n, middle));
    std::vector<Rational> values;
    for (const Exact_point& p : a) values.push_back(inner * test_scenes::dot(n, p));
    Points kept;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Exact_point &from = a[i], &to = a[(i + 1) % a.size()];
      const Rational &u = values[i], &v = values[(i + 1) % a.size()];
      if (sgn(u) >= 0) kept.push_back(from);
      if (sgn(u) * sgn(v) < 0) {
        const Rational t = u / (u - v);
        kept.push_back({Rational(from[0] + t * (to[0] - from[0])), Rational(from[1] + t * (to[1] - from[1])),
                        Rational(from[2] + t * (to[2] - from[2]))});
      }
    }
    a = kept;
  }
  return a;
}
bool has_area(const Points& p) {
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    if (sgn(determinant(p[0], p[i], p[i + 1])) != 0) return true;
  return false;
}
/// Whether a is strictly nearer to the origin than b in some direction inside both cones.
bool nearer_by_clipping(const Points& a, const Points& b) {
  const Points common = clipped(a, b);
  if (!has_area(common)) return false;
  const Exact_point u = order_check::minus(b[b.size() / 2], b[0]),
                    v = order_check::minus(b.back(), b[0]);  // never collinear here
  const int eye_side = -sgn(determinant(u, v, b[0]));
  for (const Exact_point& p : common)
    if (sgn(determinant(u, v, order_check::minus(p, b[0]))) * eye_side > 0) return true;
  return false;
}

/// A triangle, parallelogram, or parallelogram without a corner, with small coordinates. Post: the origin is not in its
/// plane.
Points random_polygon(Dice& dice, long size, bool flat) {
  while (true) {
    const auto vector = [&] {
      return at(2 * roll(dice, -size, size), 2 * roll(dice, -size, size), flat ? 0 : 2 * roll(dice, -size, size));
    };
    Exact_point o = vector();
    const Exact_point u = vector(), v = vector();
    if (flat) o[2] = 2;
    if (sgn(determinant(o, u, v)) == 0) continue;
    const auto corner = [&](const Rational& s, const Rational& t) {
      return at(o[0] + s * u[0] + t * v[0], o[1] + s * u[1] + t * v[1], o[2] + s * u[2] + t * v[2]);
    };
    const long kind = roll(dice, 0, 3);
    if (kind == 0) return {corner(0, 0), corner(1, 0), corner(0, 1)};
    if (kind == 1) return {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    if (kind == 2) return {corner(0, 0), corner(1, 0), corner(1, ratio(1, 2)), corner(ratio(1, 2), 1), corner(0, 1)};
    return {corner(0, 0), corner(ratio(1, 3), 0), corner(1, 0), corner(0, 1),
            corner(0, ratio(1, 2))};  // with straight corners
  }
}

TEST(Cone, of_a_polygon_with_the_eye_in_its_plane_is_empty) {
  const Points plot = {at(0, 0, 0), at(2, 0, 0), at(4, 0, 0), at(4, 4, 0), at(0, 4, 0)};  // with a straight corner
  for (const Points& polygon : {plot, reversed(plot)})
    for (const Exact_point& foot : {at(1, 1, 0), at(4, 1, 0), at(4, 4, 0), at(9, 1, 0), at(9, 4, 0)}) {
      const order_check::Cone flat(polygon, foot);
      EXPECT_TRUE(flat.edge_on);
      EXPECT_TRUE(flat.rays.empty() && flat.edge_planes.empty());
      EXPECT_EQ(flat.nearness, order_check::Integer_vector{});
      EXPECT_EQ(flat.distance, 0);
      for (const int side : {-1, 1}) {
        const order_check::Cone thin(polygon, at(foot[0], foot[1], Rational(side * tiny(90))));
        EXPECT_FALSE(thin.edge_on);
        EXPECT_EQ(thin.rays.size(), 4u);
        EXPECT_GT(thin.distance, 0);
      }
    }
}

TEST(Pair_check, agrees_with_clipping_in_space) {
  std::size_t trials = 0, nearer = 0, overlapping = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {  // fixed: what is counted below must not depend on luck
    Dice dice(seed);
    for (int trial = 0; trial < sample(50); ++trial) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", trial " + std::to_string(trial));
      const long size = trial % 3 + 1;
      const Points a = random_polygon(dice, size, false), b = random_polygon(dice, size, false);
      const order_check::Cone cone_a(a, at(0, 0, 0)), cone_b(b, at(0, 0, 0));
      order_check::Pair_check check;
      const bool expected = nearer_by_clipping(a, b);
      ASSERT_EQ(check.nearer_somewhere(cone_a, cone_b), expected);
      ++trials;
      nearer += expected;
      overlapping += has_area(clipped(a, b));
      // And through the front door, in both orders.
      Scene scene;
      scene.face(a);
      scene.face(b);
      scene.draw(0, a).draw(1, b);
      ASSERT_EQ(scene.verdict().accepted, !expected);
      std::swap(scene.certificate.fragments[0], scene.certificate.fragments[1]);
      ASSERT_EQ(scene.verdict().accepted, !nearer_by_clipping(b, a));
    }
  }
  RecordProperty("nearer", std::to_string(nearer) + " of " + std::to_string(trials));
  EXPECT_GT(20 * nearer, trials);  // the trials are worth something
  EXPECT_GT(overlapping, nearer);
}

TEST(Pair_check, separation_in_a_plane_agrees_with_clipping) {
  Dice dice(7);
  std::size_t overlapping = 0;
  for (int trial = 0; trial < sample(10000); ++trial) {
    const Points a = random_polygon(dice, trial % 4 + 1, true), b = random_polygon(dice, trial % 4 + 1, true);
    const order_check::Cone cone_a(a, at(0, 0, 0)), cone_b(b, at(0, 0, 0));
    const bool expected = has_area(clipped(a, b));
    ASSERT_EQ(!separates(cone_a, cone_b) && !separates(cone_b, cone_a), expected) << trial;
    overlapping += expected;
  }
  EXPECT_GT(overlapping, least(1000u));
}

TEST(Pairs, hand_on_all_that_overlap_and_few_others) {
  Dice dice(8);
  std::vector<Points> polygons;
  std::vector<order_check::Cone> cones;
  for (int i = 0; i < (test_scenes::is_sanitized() ? 80 : 240); ++i) {
    Points p = random_polygon(dice, 1 + i % 2, false);
    const Rational far = i % 3;  // some far away, so that their cones are thin
    for (Exact_point& q : p) {
      q[0] += 20 * far;
      q[1] += 7 * far;
    }
    const order_check::Cone cone(p, at(0, 0, 0));
    if (cone.edge_on) continue;
    polygons.push_back(p);
    cones.push_back(cone);
  }
  std::set<std::pair<std::size_t, std::size_t>> taken;
  std::vector<std::size_t> all(cones.size()), some;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    all[i] = i;
    if (i % 4 != 0) some.push_back(i);
  }
  double last = 0;
  const std::vector<order_check::Rounded_cone> rounded = order_check::rounded(cones, 1);
  order_check::Pairs(cones, rounded, [&](std::size_t i, std::size_t j) {
    taken.insert({i, j});
  }).each(all, some, 1, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_GT(last, 0.9);
  EXPECT_LE(last, 1);
  std::size_t apart = 0, left_out = 0;
  for (const std::size_t i : all)
    for (const std::size_t j : some) {
      const bool overlap = has_area(clipped(polygons[i], polygons[j])), is_taken = taken.contains({i, j});
      ASSERT_TRUE(is_taken || !overlap) << i << ' ' << j;
      apart += !overlap;
      left_out += !is_taken;
    }
  EXPECT_EQ(std::count_if(taken.begin(), taken.end(), [](const auto& pair) { return pair.second % 4 == 0; }), 0);
  EXPECT_GT(apart, test_scenes::least(20000u));
  EXPECT_GT(left_out, apart / 4);
}

TEST(Pairs, of_one_list_are_those_of_it_twice_once) {
  Dice dice(9);
  std::vector<order_check::Cone> cones;
  for (int i = 0; i < 240; ++i) {
    const order_check::Cone cone(random_polygon(dice, 1 + i % 2, false), at(0, 0, 0));
    if (!cone.edge_on) cones.push_back(cone);
  }
  std::vector<std::size_t> all(cones.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  const std::vector<order_check::Rounded_cone> rounded = order_check::rounded(cones, 1);
  std::set<std::pair<std::size_t, std::size_t>> once, twice;
  std::size_t calls_once = 0, calls_twice = 0;
  order_check::Pairs(cones, rounded, [&](std::size_t i, std::size_t j) {
    ++calls_once;
    once.insert(std::minmax({i, j}));
    ASSERT_NE(i, j);
  }).each(all, 1);
  order_check::Pairs(cones, rounded, [&](std::size_t i, std::size_t j) {
    ++calls_twice;
    if (i != j) twice.insert(std::minmax({i, j}));
  }).each(all, all, 1);
  EXPECT_LT(calls_once, calls_twice * 2 / 3);
  for (const auto& [i, j] : twice)
    ASSERT_TRUE(once.contains({i, j}) || separates(cones[i], cones[j]) || separates(cones[j], cones[i]));
  EXPECT_GT(once.size(), cones.size());
}

TEST(Pairs, of_needles_across_are_told_apart_by_planes_where_windows_overlap) {
  const long count = 300;
  std::vector<Points> polygons;
  std::vector<order_check::Cone> cones;
  for (long k = 0; k < count; ++k) {  // from the lower left to the upper right, side by side; each over the next two
    polygons.push_back({at(k - 1000, -1000, 1000), at(k - 998, -1000, 1000), at(k + 2, 1000, 1000)});
    cones.emplace_back(polygons.back(), at(0, 0, 0));
  }
  std::set<std::pair<std::size_t, std::size_t>> taken;
  std::vector<std::size_t> all(cones.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  const std::vector<order_check::Rounded_cone> rounded = order_check::rounded(cones, 1);
  order_check::Pairs(cones, rounded, [&](std::size_t i, std::size_t j) { taken.insert({i, j}); }).each(all, all, 1);
  for (std::size_t i = 0; i < cones.size(); ++i)
    for (std::size_t j = i >= 4 ? i - 4 : 0; j < std::min(i + 5, cones.size()); ++j)
      ASSERT_TRUE(taken.contains({i, j}) || !has_area(clipped(polygons[i], polygons[j]))) << i << ' ' << j;
  EXPECT_LT(taken.size(), static_cast<std::size_t>(count * count / 2));
}

TEST(Pairs, of_squares_side_by_side_are_few) {
  // 30 x 30 of them before the eye, and one cone around all.
  std::vector<order_check::Cone> cones;
  for (int x = -15; x < 15; ++x)
    for (int y = -15; y < 15; ++y)
      cones.emplace_back(Points{at(x, y, 10), at(x + 1, y, 10), at(x + 1, y + 1, 10), at(x, y + 1, 10)}, at(0, 0, 0));
  cones.emplace_back(Points{at(-15, -15, 20), at(15, -15, 20), at(15, 15, 20), at(-15, 15, 20)}, at(0, 0, 0));
  std::vector<std::size_t> all(cones.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::size_t taken = 0, with_itself = 0;
  const std::vector<order_check::Rounded_cone> rounded = order_check::rounded(cones, 1);
  order_check::Pairs(cones, rounded, [&](std::size_t i, std::size_t j) {
    ++taken;
    with_itself += i == j;
  }).each(all, all, 1);
  EXPECT_GE(with_itself, cones.size());
  EXPECT_LT(taken, 20 * cones.size());  // of 901 x 901
}

/// A cone by its rays, and where it meets a side of the cube by planes: the oracle of a window.
std::array<Rational, 4> extent_on(const Points& polygon, std::size_t axis, int sense) {
  Points part = polygon;  // from the origin; clipped where the coordinate of the side is the largest
  for (const std::size_t other : {(axis + 1) % 3, (axis + 2) % 3})
    for (const int way : {1, -1}) {
      Points kept;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const Exact_point &p = part[i], &q = part[(i + 1) % part.size()];
        const auto height = [&](const Exact_point& r) { return Rational(sense * r[axis] + way * r[other]); };
        const Rational at_p = height(p), at_q = height(q);
        if (sgn(at_p) >= 0) kept.push_back(p);
        if (sgn(at_p) * sgn(at_q) >= 0) continue;
        const Rational t = at_p / (at_p - at_q);
        Exact_point cut;
        for (std::size_t k = 0; k < 3; ++k) cut[k] = p[k] + t * (q[k] - p[k]);
        kept.push_back(cut);
      }
      part = kept;
    }
  if (part.size() < 3 || !has_area(part)) return {1, 0, 1, 0};
  std::array<Rational, 4> extent{2, -2, 2, -2};
  for (const Exact_point& p : part)
    for (std::size_t k = 0; k < 2; ++k) {
      const Rational at_side = p[(axis + 1 + k) % 3] / (sense * p[axis]);
      extent[2 * k] = std::min(extent[2 * k], at_side);
      extent[2 * k + 1] = std::max(extent[2 * k + 1], at_side);
    }
  return extent;
}

TEST(Window, is_the_box_around_what_a_cone_covers_of_a_side) {
  Dice dice(9);
  std::size_t there = 0, cut = 0;
  const Rational unit = Rational(1) / (Integer(1) << 60);
  for (int trial = 0; trial < sample(2000); ++trial) {
    Points polygon = random_polygon(dice, 1 + trial % 4, trial % 3 == 0);
    const long far = trial % 5 == 0 ? 1000 : 0, axis_of_far = trial % 3;
    for (Exact_point& p : polygon) p[static_cast<std::size_t>(axis_of_far)] += far;
    const order_check::Cone cone(polygon, at(0, 0, 0));
    if (cone.edge_on) continue;
    std::size_t sides = 0;
    for (std::size_t side = 0; side < order_check::cube_sides; ++side) {
      const auto extent = extent_on(polygon, side / 2, side % 2 == 0 ? 1 : -1);
      const auto window = order_check::window_of(cone, side);
      ASSERT_EQ(window.has_value(), extent[0] < extent[1]) << trial << ' ' << side;
      if (!window) continue;
      ++sides;
      for (std::size_t k = 0; k < 2; ++k) {
        const Rational low = window->low[k] * unit, high = window->high[k] * unit;
        ASSERT_TRUE(low <= extent[2 * k] && extent[2 * k] < low + unit) << trial << ' ' << side;
        ASSERT_TRUE(high - unit < extent[2 * k + 1] && extent[2 * k + 1] <= high) << trial << ' ' << side;
      }
    }
    there += sides;
    cut += sides > 1;
  }
  EXPECT_GT(there, least(2000u));
  EXPECT_GT(cut, least(500u));
}

}  // namespace
