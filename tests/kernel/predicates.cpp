// The side of a vertex to a plane: which sign, and which stage must decide it.

#include "../sample.h"
#include "grid.h"

#include <sightline/kernel/scene/scene.h>

#include <algorithm>

using namespace kernel_test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Three planes that meet in the point P/q, and more planes through it or a hair beside it.
struct Bundle {
  Integer q;
  std::array<Integer, 3> p;

  Bundle(Random& random, int bits, int denominator_bits) : q(abs(uniform(random, denominator_bits)) + 1) {
    // Inside the grid's range.
    for (auto& x : p) x = uniform(random, bits - 1) * q / 2 + uniform(random, denominator_bits);
  }
  Coefficients plane(Random& random, int normal_bits) const {
    Coefficients h;
    do
      for (std::size_t k = 0; k < 3; ++k) h[k] = q * (random() % 5 == 0 ? Integer(0) : uniform(random, normal_bits));
    while (h[0] == 0 && h[1] == 0 && h[2] == 0);
    h[3] = -(h[0] * p[0] + h[1] * p[1] + h[2] * p[2]) / q;
    return h;
  }
};

Coefficients random_plane(Random& random, int bits, bool small) {
  for (;;) {
    std::array<std::array<Integer, 3>, 3> a;
    for (auto& point : a)
      for (auto& x : point) x = small ? any_size(random, bits) : uniform(random, bits);
    const Coefficients h = through(a[0], a[1], a[2]);
    if (h[0] != 0 || h[1] != 0 || h[2] != 0) return h;
  }
}

/// Asks every stage for the side of a vertex, and all must agree with the oracle's position of it.
void expect_agreement(const Grid& grid, const Predicates& predicates, const Vertex& v, const kernel_test::Position& x,
                      Plane plane, const Coefficients& h) {
  const Sign truth = sign(evaluate(h, x));
  for (const bool opposite : {false, true}) {
    const Plane g = opposite ? plane.opposite() : plane;
    const Sign expected = opposite ? -truth : truth;
    const Prepared_plane prepared = predicates.prepare(g);
    Predicate_counts counts;
    ASSERT_EQ(predicates.side(v, prepared, counts), expected);
    ASSERT_EQ(counts.total(), 1u);
    const CGAL::Uncertain<Sign> filtered = Predicates::side_filtered(v, prepared), fixed = predicates.side_fixed(v, g);
    ASSERT_TRUE(!CGAL::is_certain(filtered) || filtered.inf() == expected);
    ASSERT_EQ(CGAL::is_certain(fixed), predicates.arithmetic() != Arithmetic::gmp);
    ASSERT_TRUE(!CGAL::is_certain(fixed) || fixed.inf() == expected);
    ASSERT_EQ(predicates.side_exact<Integer>(v, g), expected);
    if (grid.planes.budget().side() <= 1024) {
      ASSERT_EQ(predicates.side_exact<Fixed_integer<16>>(v, g), expected);
    }
    if (predicates.incident(v, g.id())) {
      ASSERT_EQ(expected, CGAL::ZERO);
    }
    // The first stage that can decides.
    const bool nonzero_in_doubles = CGAL::is_certain(filtered) && filtered.inf() != CGAL::ZERO;
    ASSERT_EQ(deciding_stage(counts), nonzero_in_doubles               ? "filtered"
                                      : predicates.incident(v, g.id()) ? "combinatorial"
                                      : CGAL::is_certain(filtered)     ? "filtered"
                                      : CGAL::is_certain(fixed)        ? "fixed"
                                                                       : "gmp");
    // The determinant fits the budget: its bits and its sign.
    const std::array<Integer, 4> at = predicates.homogeneous(v), c = predicates.coefficients(g);
    const Integer determinant = c[0] * at[0] + c[1] * at[1] + c[2] * at[2] + c[3] * at[3];
    ASSERT_LE(static_cast<int>(bit_length(determinant)) + 1, grid.planes.budget().side());
    ASSERT_EQ(sgn(determinant), static_cast<int>(expected));
  }
}

/// The doubles of a vertex are within its error of its exact position.
void expect_error_bound(const Grid& grid, const Vertex& v, const kernel_test::Position& x) {
  if (v.error == infinity) return;
  const std::array<double, 3> rounded{v.x, v.y, v.z};
  for (std::size_t k = 0; k < 3; ++k)
    ASSERT_TRUE(abs(exact(rounded[k]) - grid.approximated(x[k])) <= exact(v.error))
        << v.x << ' ' << v.y << ' ' << v.z << " error " << v.error;
}

/// All planes of the grid against each other: every triple's meet, in all orders, against every plane.
void check_all(const Grid& grid, std::size_t most_triples = 60) {
  const Predicates predicates = grid.predicates();
  std::size_t triples = 0;
  for (std::size_t i = 0; i < grid.handles.size(); ++i)
    for (std::size_t j = i + 1; j < grid.handles.size(); ++j)
      for (std::size_t k = j + 1; k < grid.handles.size(); ++k) {
        if (++triples > most_triples) return;
        std::array<std::uint32_t, 3> ids{grid.handles[i].id(), grid.handles[j].id(), grid.handles[k].id()};
        const std::optional<kernel_test::Position> x = meeting_point(grid.made[i], grid.made[j], grid.made[k]);
        std::sort(ids.begin(), ids.end());
        do {
          if (!x) {
            ASSERT_THROW(predicates.meet(ids[0], ids[1], ids[2]), std::domain_error);
            continue;
          }
          const Vertex v = predicates.meet(ids[0], ids[1], ids[2]);
          ASSERT_FALSE(v.is_input());
          ASSERT_EQ(predicates.orientation_exact(v.plane[0], v.plane[1], v.plane[2]), 1);
          expect_error_bound(grid, v, *x);
          const std::array<Integer, 4> h = predicates.homogeneous(v);
          ASSERT_GT(h[3], 0);
          for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(rational(h[axis], h[3]), (*x)[axis]);
          for (const std::size_t l : {i, j, k}) {
            Predicate_counts counts;
            ASSERT_EQ(predicates.side(v, predicates.prepare(grid.handles[l]), counts), CGAL::ZERO);
            ASSERT_EQ(deciding_stage(counts), "combinatorial");
          }
          for (std::size_t l = 0; l < grid.handles.size(); ++l) {
            ASSERT_NO_FATAL_FAILURE(expect_agreement(grid, predicates, v, *x, grid.handles[l], grid.made[l]));
          }
        } while (std::next_permutation(ids.begin(), ids.end()));
      }
}

int bits_of(const Integer& n) { return static_cast<int>(bit_length(n)); }

/// One input point, as a corner of planes that no one asks about.
Vertex lone_input(const Predicates& predicates, std::uint32_t point) {
  return predicates.input_vertex(point, Vertex::no_plane, Vertex::no_plane, Vertex::no_plane);
}

kernel_test::Position position_of(const Grid& grid, std::uint32_t point) {
  const std::array<Integer, 3> p = grid.at(point);
  return {p[0], p[1], p[2]};
}

}  // namespace

// ---- Each stage by name

TEST(Side_combinatorial, a_meet_is_on_the_planes_that_made_it) {
  Grid grid(20);
  const Plane p = grid.plane({3, 1, -7, 11}), q = grid.plane({1, -5, 2, 3}), r = grid.plane({-2, 1, 9, 4});
  const Predicates predicates = grid.predicates();
  for (const Plane h : {p, q, r, p.opposite(), q.opposite(), r.opposite()}) {
    Predicate_counts counts;
    EXPECT_EQ(predicates.side(predicates.meet(p.id(), q.id(), r.id()), predicates.prepare(h), counts), CGAL::ZERO);
    EXPECT_EQ(deciding_stage(counts), "combinatorial");
  }
}

TEST(Side_combinatorial, a_meet_is_on_the_fourth_plane_that_it_was_told_of) {
  Grid grid(20);
  const Plane p = grid.plane({3, 0, 0, -1}), q = grid.plane({0, 3, 0, -1}), r = grid.plane({0, 0, 3, -1}),
              s = grid.plane({1, 1, 1, -1}), t = grid.plane({1, 1, -2, 0});
  const Predicates predicates = grid.predicates();
  const Vertex told = predicates.meet(p.id(), q.id(), r.id(), s.id()), untold = predicates.meet(p.id(), q.id(), r.id());
  EXPECT_FALSE(told.is_input());
  EXPECT_FALSE(untold.is_input());
  EXPECT_EQ(told.fourth_plane(), s.id());
  EXPECT_EQ(untold.fourth_plane(), Vertex::no_plane);
  const auto stage = [&](const Vertex& v, Plane h) {
    Predicate_counts counts;
    EXPECT_EQ(predicates.side(v, predicates.prepare(h), counts), CGAL::ZERO);
    return deciding_stage(counts);
  };
  EXPECT_EQ(stage(told, s), "combinatorial");
  EXPECT_EQ(stage(untold, s), "fixed");
  EXPECT_EQ(stage(told, t), "fixed");
}

TEST(Side_combinatorial, every_plane_id_fits_beside_a_meet) {
  for (const std::uint32_t id : {0u, 1u, Plane::max_table_planes - 1, Plane::across(0, 0).id(),
                                 Plane::across(2, Plane::max_axis_point - 1).id()}) {
    Vertex v{};
    v.point = Vertex::with_plane(id);
    EXPECT_FALSE(v.is_input());
    EXPECT_EQ(v.fourth_plane(), id);
  }
  Vertex v{};
  v.point = Plane::max_axis_point - 1;
  EXPECT_TRUE(v.is_input());
}

TEST(Side_combinatorial, an_input_point_is_on_the_planes_of_faces_that_have_it_as_a_corner) {
  Grid grid(60);  // doubles know nothing exactly here
  const std::uint32_t point = grid.point({power_of_two(59) + 1, power_of_two(58) + 3, -power_of_two(57) - 1});
  const std::array<Integer, 3> x = grid.at(point);
  const Plane known = grid.plane({1, 1, 1, -(x[0] + x[1] + x[2])}),
              unknown = grid.plane({1, -1, 1, -(x[0] - x[1] + x[2])});
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs{{point, known.id()}};
  grid.incidences = Point_planes(grid.points.size(), pairs);
  const Predicates predicates = grid.predicates();
  const Vertex v = lone_input(predicates, point);
  Predicate_counts first, second;
  EXPECT_EQ(predicates.side(v, predicates.prepare(known), first), CGAL::ZERO);
  EXPECT_EQ(deciding_stage(first), "combinatorial");
  EXPECT_EQ(predicates.side(v, predicates.prepare(unknown), second), CGAL::ZERO);
  EXPECT_NE(deciding_stage(second), "combinatorial");
}

TEST(Side_filtered, signs_far_from_zero_and_zeros_of_grid_points_need_no_more_than_doubles) {
  Grid grid(20);
  const Plane p = grid.plane({1, 0, 0, -5}), q = grid.plane({0, 1, 0, -6}), r = grid.plane({0, 0, 1, -7});
  const Plane front = grid.plane({1, 2, 3, 1}), behind = grid.plane({1, 2, -30, 1}), on = grid.plane({1, 1, 1, -18});
  const Predicates predicates = grid.predicates();
  const std::uint32_t point = grid.point({5, 6, 7});
  for (const Vertex& v : {predicates.meet(p.id(), q.id(), r.id()), lone_input(predicates, point)})
    for (const auto& [plane, expected] : {std::pair{front, CGAL::POSITIVE},
                                          {front.opposite(), CGAL::NEGATIVE},
                                          {behind, CGAL::NEGATIVE},
                                          {behind.opposite(), CGAL::POSITIVE},
                                          {on, CGAL::ZERO},
                                          {on.opposite(), CGAL::ZERO}}) {
      Predicate_counts counts;
      EXPECT_EQ(v.error, 0.0);
      EXPECT_EQ(predicates.side(v, predicates.prepare(plane), counts), expected);
      EXPECT_EQ(deciding_stage(counts), "filtered");
    }
}

namespace {
/// Four planes through one point that is not on the grid, then the fourth one unit up and down: the signs 0, +, - and
/// the stage that must decide.
void expect_stage(int bits, int normal_bits, int denominator_bits, Arithmetic arithmetic, const std::string& stage,
                  bool also_beside) {
  Random random(static_cast<std::uint64_t>(bits));
  int done = 0;
  while (done < 20) {
    Grid grid(bits);
    const Bundle bundle(random, bits, denominator_bits);
    std::array<Plane, 3> h;
    for (Plane& plane : h) plane = grid.plane(bundle.plane(random, normal_bits));
    Coefficients on = bundle.plane(random, normal_bits);
    if (on[0] == 0 || on[1] == 0 || on[2] == 0) continue;
    Coefficients up = on, down = on;
    // One unit of the reduced row.
    const Integer common = gcd(gcd(on[0], on[1]), gcd(on[2], on[3]));
    up[3] += common;
    down[3] -= common;
    const Plane zero = grid.plane(on), front = grid.plane(up), behind = grid.plane(down);
    if (!meeting_point(grid.made[0], grid.made[1], grid.made[2])) continue;
    const Predicates predicates = grid.predicates();
    const Vertex v = predicates.meet(h[0].id(), h[1].id(), h[2].id());
    if (v.error == 0 || predicates.incident(v, zero.id())) continue;
    ++done;
    ASSERT_EQ(predicates.arithmetic(), arithmetic) << grid.planes.budget().side();
    Predicate_counts counts;
    ASSERT_EQ(predicates.side(v, predicates.prepare(zero), counts), CGAL::ZERO);
    ASSERT_EQ(deciding_stage(counts), stage);
    for (const auto& [plane, expected] : {std::pair{front, CGAL::POSITIVE},
                                          {behind, CGAL::NEGATIVE},
                                          {front.opposite(), CGAL::NEGATIVE},
                                          {behind.opposite(), CGAL::POSITIVE}}) {
      Predicate_counts beside;
      ASSERT_EQ(predicates.side(v, predicates.prepare(plane), beside), expected);
      if (also_beside) {
        ASSERT_EQ(deciding_stage(beside), stage);
      }
    }
  }
}
}  // namespace

TEST(Side_fixed, a_degenerate_meet_is_decided_in_128_bits) {
  expect_stage(12, 15, 6, Arithmetic::bits128, "fixed", false);
}
TEST(Side_fixed, a_degenerate_meet_and_one_unit_beside_it_are_decided_in_256_bits) {
  expect_stage(26, 38, 10, Arithmetic::bits256, "fixed", true);
}
TEST(Side_fixed, a_degenerate_meet_and_one_unit_beside_it_are_decided_in_512_bits) {
  expect_stage(45, 70, 18, Arithmetic::bits512, "fixed", true);
}
TEST(Side_gmp, a_degenerate_meet_and_one_unit_beside_it_are_decided_by_gmp) {
  expect_stage(60, 110, 10, Arithmetic::gmp, "gmp", true);
}
TEST(Side_gmp, a_degenerate_meet_in_a_scene_of_a_thousand_bits_is_decided_by_gmp) {
  expect_stage(1000, 1900, 90, Arithmetic::gmp, "gmp", true);
}

// ---- Every stage against the oracle

/// Bits of the grid's coordinates, and its divisor (see Grid_points).
struct Width {
  int bits;
  Integer divisor = 1;
  friend std::ostream& operator<<(std::ostream& out, const Width& w) {
    return out << w.bits << " bits over " << w.divisor;
  }
};
class Side_at_width : public testing::TestWithParam<Width> {};
INSTANTIATE_TEST_SUITE_P(Predicates, Side_at_width,
                         testing::Values(Width{4}, Width{8}, Width{12}, Width{20}, Width{26}, Width{31}, Width{45},
                                         Width{53}, Width{54}, Width{60}, Width{64}, Width{128}, Width{400},
                                         Width{54, power_of_two(30)}, Width{64, Integer(1000000007)},
                                         Width{128, power_of_two(100)}, Width{400, 3 * power_of_two(390)},
                                         Width{90, power_of_two(1200)}, Width{1500, power_of_two(60)}));

TEST_P(Side_at_width, all_stages_agree_on_random_planes_through_grid_points) {
  Random random(1000 + static_cast<std::uint64_t>(GetParam().bits));
  for (int round = 0; round < (test_scenes::is_sanitized() ? 2 : 6); ++round) {
    Grid grid(GetParam().bits, GetParam().divisor);
    for (int i = 0; i < 5; ++i) grid.plane(random_plane(random, GetParam().bits, round % 2 == 1));
    ASSERT_NO_FATAL_FAILURE(check_all(grid));
  }
}

TEST_P(Side_at_width, all_stages_agree_on_planes_through_one_point_and_one_unit_beside_it) {
  Random random(2000 + static_cast<std::uint64_t>(GetParam().bits));
  for (int round = 0; round < (test_scenes::is_sanitized() ? 2 : 6); ++round) {
    Grid grid(GetParam().bits, GetParam().divisor);
    const Bundle bundle(random, GetParam().bits, round % 3 == 0 ? 1 : std::max(1, GetParam().bits / 4));
    for (int i = 0; i < 4; ++i) grid.plane(bundle.plane(random, GetParam().bits));
    Coefficients beside = grid.made.back();
    beside[3] += round % 2 ? 1 : -1;
    grid.plane(beside);
    ASSERT_NO_FATAL_FAILURE(check_all(grid));
  }
}

TEST_P(Side_at_width, all_stages_agree_on_almost_parallel_planes) {
  Random random(3000 + static_cast<std::uint64_t>(GetParam().bits));
  for (int round = 0; round < (test_scenes::is_sanitized() ? 1 : 4); ++round) {
    Grid grid(GetParam().bits, GetParam().divisor);
    const Coefficients h = random_plane(random, GetParam().bits, false);
    for (int i = 0; i < 5; ++i) {
      Coefficients g = h;
      for (Integer& x : g) x += static_cast<long>(random() % 3) - 1;
      if (g[0] != 0 || g[1] != 0 || g[2] != 0) grid.plane(g);
    }
    ASSERT_NO_FATAL_FAILURE(check_all(grid));
  }
}

TEST_P(Side_at_width, all_stages_agree_at_input_points_and_across_axes) {
  const int bits = GetParam().bits;
  Random random(4000 + static_cast<std::uint64_t>(bits));
  Grid grid(bits, GetParam().divisor);
  std::vector<std::uint32_t> points;
  for (int i = 0; i < 12; ++i)
    points.push_back(grid.point({uniform(random, bits), any_size(random, bits), uniform(random, bits)}));
  if (bits_of(grid.points.divisor()) < bits)  // some that the divisor takes back to small integers
    for (int i = 0; i < 6; ++i)
      points[random() % 12] =
          grid.point({uniform(random, bits - bits_of(grid.points.divisor())) * grid.points.divisor(), 0,
                      (any_size(random, bits) / grid.points.divisor()) * grid.points.divisor()});
  for (int i = 0; i < 12; ++i) {
    const Coefficients h =
        through(grid.at(points[random() % 12]), grid.at(points[random() % 12]), grid.at(points[random() % 12]));
    if (h[0] != 0 || h[1] != 0 || h[2] != 0) grid.plane(h);
  }
  const Predicates predicates = grid.predicates();
  for (const std::uint32_t p : points) {
    const Vertex v = lone_input(predicates, p);
    if (bits <= 53 || grid.points.divisor() == 1) {
      ASSERT_EQ(v.error == 0, bits <= 53);
    }
    ASSERT_NO_FATAL_FAILURE(expect_error_bound(grid, v, position_of(grid, p)));
    for (std::size_t l = 0; l < grid.handles.size(); ++l) {
      ASSERT_NO_FATAL_FAILURE(
          expect_agreement(grid, predicates, v, position_of(grid, p), grid.handles[l], grid.made[l]));
    }
    for (const std::uint32_t q : points)
      for (int axis = 0; axis < 3; ++axis) {
        Coefficients h{0, 0, 0, -grid.at(q)[static_cast<std::size_t>(axis)]};
        h[static_cast<std::size_t>(axis)] = 1;
        const Plane across = Plane::across(axis, q);
        ASSERT_NO_FATAL_FAILURE(expect_agreement(grid, predicates, v, position_of(grid, p), across, h));
        // A meet with axis planes, against axis planes.
        const std::size_t i = random() % grid.handles.size();
        Coefficients g{0, 0, 0, -grid.at(p)[static_cast<std::size_t>((axis + 1) % 3)]};
        g[static_cast<std::size_t>((axis + 1) % 3)] = 1;
        const std::optional<kernel_test::Position> x = meeting_point(h, g, grid.made[i]);
        const Plane other = Plane::across((axis + 1) % 3, p);
        if (!x) {
          ASSERT_THROW(predicates.meet(across.id(), other.id(), grid.handles[i].id()), std::domain_error);
          continue;
        }
        const Vertex meet = predicates.meet(across.id(), other.id(), grid.handles[i].id());
        ASSERT_NO_FATAL_FAILURE(expect_error_bound(grid, meet, *x));
        const std::size_t l = random() % grid.handles.size();
        ASSERT_NO_FATAL_FAILURE(expect_agreement(grid, predicates, meet, *x, grid.handles[l], grid.made[l]));
        ASSERT_NO_FATAL_FAILURE(expect_agreement(grid, predicates, meet, *x, across, h));
      }
  }
}

TEST_P(Side_at_width, planes_that_do_not_meet_in_a_point_are_refused) {
  const int bits = GetParam().bits;
  Random random(5000 + static_cast<std::uint64_t>(bits));
  for (int round = 0; round < 10; ++round) {
    Grid grid(bits, GetParam().divisor);
    const Coefficients p = random_plane(random, bits - 2, false), q = random_plane(random, bits - 2, false);
    Coefficients parallel = p, sum;
    parallel[3] += 1;
    for (std::size_t k = 0; k < 4; ++k) sum[k] = 2 * p[k] + q[k];
    if (sum[0] == 0 && sum[1] == 0 && sum[2] == 0) continue;
    sum[3] += 7;  // no common line
    grid.plane(p);
    grid.plane(q);
    grid.plane(parallel);
    grid.plane(sum);
    const Predicates predicates = grid.predicates();
    const auto id = [&](std::size_t i) { return grid.handles[i].id(); };
    EXPECT_THROW(predicates.meet(id(0), id(1), id(2)), std::domain_error);
    EXPECT_THROW(predicates.meet(id(0), id(1), id(3)), std::domain_error);
    EXPECT_THROW(predicates.meet(id(0), id(0), id(1)), std::domain_error);
    EXPECT_THROW(predicates.meet(id(2), id(1), id(0)), std::domain_error);
  }
}

// ---- Bounds

TEST_P(Side_at_width, the_bound_of_a_prepared_plane_covers_its_rounding_at_any_doubles_in_range) {
  const int bits = GetParam().bits;
  Random random(6000 + static_cast<std::uint64_t>(bits));
  Grid grid(bits, GetParam().divisor);
  for (int i = 0; i < 30; ++i) grid.plane(random_plane(random, bits, i % 2 == 0));
  const Predicates predicates = grid.predicates();
  const double range = grid.points.range();
  if (range == infinity) return;  // then the bound is infinite too
  double largest_ratio = 0;
  for (const Plane plane : grid.handles) {
    const Prepared_plane h = predicates.prepare(plane);
    const std::array<Integer, 4> c = predicates.coefficients(plane);
    const int width = static_cast<int>(std::max({bit_length(c[0]), bit_length(c[1]), bit_length(c[2])}));
    const long scale = grid.points.shift() == 0 && (grid.points.divisor() == 1 || width <= 53) ? 0 : width;
    std::array<Rational, 4> truth;
    for (std::size_t k = 0; k < 4; ++k) truth[k] = shifted(k == 3 ? grid.approximated(c[k]) : Rational(c[k]), scale);
    ASSERT_GE(exact(h.norm), abs(truth[0]) + abs(truth[1]) + abs(truth[2]));
    for (int i = 0; i < 200; ++i) {
      std::array<double, 3> x;
      for (double& t : x)
        t = std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -62) * range;  // in [-2, 2] ranges
      if (i % 2 == 0) {  // nearly on the plane: solve for one coordinate
        const std::array<double, 3> n{h.a, h.b, h.c};
        const std::size_t k = random() % 3;
        double rest = h.d;
        for (std::size_t j = 0; j < 3; ++j) rest += j == k ? 0 : n[j] * x[j];
        if (n[k] != 0 && std::fabs(rest / n[k]) <= 2 * range) x[k] = -rest / n[k];
      }
      const double value = h.a * x[0] + h.b * x[1] + h.c * x[2] + h.d;
      Rational exactly = truth[3];
      for (std::size_t k = 0; k < 3; ++k) exactly += truth[k] * exact(x[k]);
      const Rational error = abs(exact(value) - exactly);
      ASSERT_LE(error, exact(h.bound));
      largest_ratio = std::max(largest_ratio, Rational(error / exact(h.bound)).get_d());
      // So is the filter at a vertex with these doubles and no error of its own.
      if (!h.exact) {
        const Vertex v{x[0], x[1], x[2], 0, {}, Vertex::no_point};
        const CGAL::Uncertain<Sign> s = Predicates::side_filtered(v, h);
        ASSERT_TRUE(!CGAL::is_certain(s) || s.inf() == sign(exactly));
      }
    }
  }
  if (bits > 20 && range > 0x1p-900) {
    EXPECT_GT(largest_ratio, 1.0 / 1024) << "the bound is far from what happens";
  }
}

TEST_P(Side_at_width, the_error_of_a_meet_covers_its_doubles_and_not_by_far) {
  const int bits = GetParam().bits;
  Random random(7000 + static_cast<std::uint64_t>(bits));
  double largest_ratio = 0, grid_range = 0;
  for (int round = 0; round < (bits < 1000 ? 300 : 60); ++round) {
    Grid grid(bits, GetParam().divisor);
    if (round % 3 == 0) {  // entries of one size: the bound is nearest here
      const Integer n = power_of_two(2 * bits) - 1, d = power_of_two(3 * bits) - 1;
      for (int i = 0; i < 3; ++i) {
        Coefficients h;
        for (std::size_t k = 0; k < 4; ++k)
          h[k] = (k == 3 ? d : n) * (random() % 2 ? 1 : -1) + uniform(random, 2 * bits - 2);
        grid.plane(h);
      }
    } else {
      for (int i = 0; i < 3; ++i) grid.plane(random_plane(random, bits, round % 3 == 1));
    }
    grid_range = grid.points.range();
    const std::optional<kernel_test::Position> x = meeting_point(grid.made[0], grid.made[1], grid.made[2]);
    if (!x) continue;
    const Vertex v = grid.predicates().meet(grid.handles[0].id(), grid.handles[1].id(), grid.handles[2].id());
    ASSERT_NO_FATAL_FAILURE(expect_error_bound(grid, v, *x));
    if (v.error == infinity || v.error == 0) continue;
    const std::array<double, 3> rounded{v.x, v.y, v.z};
    for (std::size_t k = 0; k < 3; ++k)
      largest_ratio = std::max(largest_ratio,
                               Rational(abs(exact(rounded[k]) - grid.approximated((*x)[k])) / exact(v.error)).get_d());
  }
  if (grid_range > 0x1p-900 && grid_range < infinity) {
    EXPECT_GT(largest_ratio, 1.0 / 1024) << "the bound is far from what happens";
  }
}

TEST(Meet, a_grid_point_is_known_to_be_one_and_others_are_not) {
  Grid grid(12);
  const Plane p = grid.plane({2, 0, 0, -6}), q = grid.plane({3, 5, 0, 1}), r = grid.plane({1, 1, 2, 3}),
              half = grid.plane({1, 1, 2, 4});
  const Predicates predicates = grid.predicates();
  const Vertex whole = predicates.meet(p.id(), q.id(), r.id()), broken = predicates.meet(p.id(), q.id(), half.id());
  EXPECT_EQ(whole.error, 0.0);  // (3, -2, -2)
  EXPECT_EQ(whole.x, 3.0);
  EXPECT_EQ(whole.y, -2.0);
  EXPECT_EQ(whole.z, -2.0);
  EXPECT_GT(broken.error, 0.0);  // (3, -2, -5/2)
}

TEST(Meet, and_points_that_the_divisor_makes_exact_see_planes_that_miss_them_by_less_than_doubles_can_say) {
  const Integer d = power_of_two(100);
  Grid grid(128, d);
  const std::uint32_t point = grid.point({5 * d, 6 * d, 7 * d});
  const Plane on = grid.plane({1, 1, 1, -18 * d}), front = grid.plane({1, 1, 1, -18 * d + 1}),
              behind = grid.plane({1, 1, 1, -18 * d - 1});
  const Plane p = grid.plane({1, 0, 0, -5 * d}), q = grid.plane({0, 1, 0, -6 * d}), r = grid.plane({0, 0, 1, -7 * d}),
              almost = grid.plane({0, 0, 1, -7 * d - 1});
  const Predicates predicates = grid.predicates();
  for (const Vertex& v : {lone_input(predicates, point), predicates.meet(p.id(), q.id(), r.id())}) {
    EXPECT_EQ(v.error, 0.0);
    for (const auto& [plane, expected] :
         {std::pair{on, CGAL::ZERO}, {front, CGAL::POSITIVE}, {behind, CGAL::NEGATIVE}}) {
      Predicate_counts counts;
      EXPECT_EQ(predicates.side(v, predicates.prepare(plane), counts), expected);
      EXPECT_EQ(deciding_stage(counts), plane == on ? "filtered" : "fixed");
    }
  }
  const Vertex above = predicates.meet(p.id(), q.id(), almost.id());
  EXPECT_GT(above.error, 0.0);
  Predicate_counts counts;
  EXPECT_EQ(predicates.side(above, predicates.prepare(on), counts), CGAL::POSITIVE);
  ASSERT_NO_FATAL_FAILURE(check_all(grid));
}

TEST(Meet, far_outside_the_range_the_doubles_say_nothing) {
  Grid grid(8);
  const Plane p = grid.plane({1, 0, 0, 0}), q = grid.plane({100, 1, 0, -300}), r = grid.plane({0, 0, 1, 0}),
              near = grid.plane({100, 1, 0, -100});
  const Predicates predicates = grid.predicates();
  EXPECT_EQ(predicates.meet(p.id(), q.id(), r.id()).error, 0.0);  // y = 300, within twice 256
  EXPECT_EQ(predicates.meet(p.id(), near.id(), r.id()).error, 0.0);
  const Plane far = grid.plane({100, 1, 0, -600});
  EXPECT_EQ(grid.predicates().meet(p.id(), far.id(), r.id()).error, infinity);
}

TEST(Meet, a_point_that_underflows_is_within_its_error) {
  // Coordinates of 1, 3, 5 on a grid of 2200 bits: times 2^-2200 they are no doubles.
  Grid grid(2200);
  grid.plane({1, 1, 1, -9});
  grid.plane({1, -1, 2, -8});
  grid.plane({2, 1, -1, 0});
  grid.plane({power_of_two(4300) + 1, 3, 5, -power_of_two(4300) - 35});
  const Predicates predicates = grid.predicates();
  const std::optional<kernel_test::Position> x = meeting_point(grid.made[0], grid.made[1], grid.made[2]);
  const Vertex v = predicates.meet(grid.handles[0].id(), grid.handles[1].id(), grid.handles[2].id());
  ASSERT_NO_FATAL_FAILURE(expect_error_bound(grid, v, *x));
  ASSERT_NO_FATAL_FAILURE(check_all(grid));
}

TEST(Filter, of_sides_of_vertices_in_range_fewer_than_one_in_a_thousand_fail) {
  for (const int bits : {12, 26, 53, 54, 100}) {
    Random random(static_cast<std::uint64_t>(bits));
    std::uint64_t asked = 0, failed = 0;
    for (int round = 0; round < 300; ++round) {
      Grid grid(bits);
      for (int i = 0; i < 8; ++i) grid.plane(random_plane(random, bits, false));
      const Predicates predicates = grid.predicates();
      const double range = grid.points.range();
      for (std::size_t i = 0; i < 6; ++i) {
        const Vertex v = predicates.meet(grid.handles[i].id(), grid.handles[i + 1].id(), grid.handles[i + 2].id());
        if (!(std::fabs(v.x) < range && std::fabs(v.y) < range && std::fabs(v.z) < range) || v.error == infinity)
          continue;
        for (std::size_t l = 0; l < 8; ++l)
          if (l < i || l > i + 2) {
            ++asked;
            failed += !CGAL::is_certain(Predicates::side_filtered(v, predicates.prepare(grid.handles[l])));
          }
      }
    }
    EXPECT_GT(asked, 2000u);
    EXPECT_LT(static_cast<double>(failed), 1e-3 * static_cast<double>(asked))
        << bits << " bits: " << failed << " of " << asked;
  }
}

TEST(Filter, no_vertex_in_range_has_doubles_that_say_nothing_but_for_near_parallel_planes) {
  Random random(77);
  std::uint64_t all = 0, silent = 0;
  for (int round = 0; round < 2000; ++round) {
    Grid grid(26);
    const Bundle bundle(random, 26, 4);
    for (int i = 0; i < 3; ++i) grid.plane(bundle.plane(random, 40));
    if (!meeting_point(grid.made[0], grid.made[1], grid.made[2])) continue;
    ++all;
    silent +=
        grid.predicates().meet(grid.handles[0].id(), grid.handles[1].id(), grid.handles[2].id()).error == infinity;
  }
  EXPECT_LT(static_cast<double>(silent), 1e-3 * static_cast<double>(all));
}

// ---- The bit budget

TEST(Bit_budget, the_narrowest_sufficient_arithmetic_is_chosen) {
  const auto chosen = [](int coordinate, int normal, int offset) {
    return Bit_budget{coordinate, normal, offset}.arithmetic();
  };
  static_assert(Bit_budget{1, 0, 0}.side() == 10);
  static_assert(Bit_budget{26, 53, 80}.side() == 245);
  EXPECT_EQ(chosen(10, 30, 32), Arithmetic::bits128);  // 3 x 30 + 32 + 6
  EXPECT_EQ(chosen(10, 30, 33), Arithmetic::bits256);
  EXPECT_EQ(chosen(33, 30, 10), Arithmetic::bits256);  // an axis plane's offset
  EXPECT_EQ(chosen(10, 60, 70), Arithmetic::bits256);
  EXPECT_EQ(chosen(10, 60, 71), Arithmetic::bits512);
  EXPECT_EQ(chosen(10, 100, 206), Arithmetic::bits512);
  EXPECT_EQ(chosen(10, 100, 207), Arithmetic::gmp);
  EXPECT_EQ(name(Arithmetic::bits128), "128");
  EXPECT_EQ(name(Arithmetic::gmp), "gmp");
}

TEST(Bit_budget, the_widest_determinants_of_every_width_are_exact_in_the_arithmetic_chosen) {
  // Hadamard's rows: 16 products of the same sign.
  const int sign_of_entry[4][4] = {{1, 1, 1, 1}, {1, -1, 1, -1}, {1, 1, -1, -1}, {1, -1, -1, 1}};
  std::array<int, 4> seen{};
  for (int normal = 20; normal <= 130; normal += test_scenes::is_sanitized() ? 5 : 1)
    for (int extra = 0; extra < 3; ++extra) {
      Grid grid(normal / 2 + 1);
      const int offset = std::min(normal + extra + normal / 2, 3 * grid.points.bits());
      const Integer n = power_of_two(normal) - 1;
      Integer d = power_of_two(offset) - 1;
      while (gcd(n, d) != 1) --d;
      for (const auto& row : sign_of_entry) grid.plane({n * row[0], n * row[1], n * row[2], d * row[3]});
      const Predicates predicates = grid.predicates();
      ++seen[static_cast<std::size_t>(predicates.arithmetic())];
      ASSERT_EQ(grid.planes.budget().normal, normal);
      ASSERT_NO_FATAL_FAILURE(check_all(grid)) << normal;
    }
  for (const int n : seen) EXPECT_GT(n, 0);
}

TEST(Bit_budget, no_determinant_of_planes_through_the_corners_of_the_grid_exceeds_it) {
  for (const int bits : {3, 10, 12, 13, 25, 26, 27, 53, 54, 55}) {
    const Integer m = power_of_two(bits) - 1;
    std::vector<std::array<Integer, 3>> corners;
    for (int i = 0; i < 8; ++i)
      corners.push_back({i & 1 ? m : Integer(-m), i & 2 ? m : Integer(-m), i & 4 ? m : Integer(-m)});
    corners.push_back({m - 1, -m, 1 - m});
    corners.push_back({-m, m - 1, m});
    corners.push_back({m, 1 - m, -m});
    Random random(static_cast<std::uint64_t>(bits));
    for (int round = 0; round < 6; ++round) {
      Grid grid(bits);
      while (grid.handles.size() < 5) {
        const Coefficients h = through(corners[random() % corners.size()], corners[random() % corners.size()],
                                       corners[random() % corners.size()]);
        if (h[0] != 0 || h[1] != 0 || h[2] != 0) grid.plane(h);
      }
      ASSERT_LE(grid.planes.budget().normal, 2 * bits + 3);
      ASSERT_LE(grid.planes.budget().offset, 3 * bits + 5);
      ASSERT_NO_FATAL_FAILURE(check_all(grid, 12));
    }
  }
}

TEST(Bit_budget, narrow_planes_on_a_wide_grid_are_read_from_more_limbs_than_the_arithmetic_has) {
  // 50-bit points but axis-parallel planes only: 128 bits suffice, and offsets are stored in three limbs.
  Grid grid(50);
  const Integer m = power_of_two(50) - 1;
  for (int k = 0; k < 3; ++k)
    for (const Integer& x : {m, Integer(-m), Integer(5)}) {
      Coefficients h{0, 0, 0, -x};
      h[static_cast<std::size_t>(k)] = 1;
      grid.plane(h);
    }
  EXPECT_EQ(grid.predicates().arithmetic(), Arithmetic::bits128);
  EXPECT_EQ(grid.planes.offset_limbs(), 3);
  ASSERT_NO_FATAL_FAILURE(check_all(grid));
}

// ---- Points that are not of the scene

namespace {
/// The point (x, y, z) / w of the grid, with doubles and their error as Scene::locate makes them.
Located_point located(const Grid& grid, const std::array<Integer, 3>& x, const Integer& w) {
  Located_point q{x[0], x[1], x[2], w, 0, 0, 0, 0};
  const std::array<double*, 3> rounded{&q.ax, &q.ay, &q.az};
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational truth = grid.approximated(rational(x[k], w));
    *rounded[k] = nearest_double(truth);
    if (exact(*rounded[k]) != truth) q.error = std::max(q.error, std::fabs(*rounded[k]) * 0x1p-52 + 0x1p-1000);
  }
  return q;
}
TEST(Orientation, of_small_planes_is_decided_by_doubles_and_of_others_exactly) {
  // Of the planes of a corner; and of three that nearly have a direction in common.
  for (const bool flat : {false, true}) {
    const Integer far = flat ? Integer(1) << 60 : Integer(1);
    Polygon_soup soup;
    const auto face = [&](const Exact_point& p, const Exact_point& q, const Exact_point& r) {
      std::vector<Point_id> loop;
      for (const Exact_point& at : {p, q, r}) loop.push_back(soup.add_point(at[0], at[1], at[2]));
      soup.add_face(loop);
    };
    const Rational x = far;
    face({0, 0, 0}, {x, 0, flat ? 1 : 0}, {0, x, 0});
    face({0, 0, 0}, {0, x, 0}, {flat ? x : Rational(0), 0, flat ? Rational(0) : x});
    face({0, 0, 0}, {flat ? x : Rational(0), 0, flat ? Rational(0) : x}, {x, flat ? x : Rational(0), flat ? 2 : 0});
    const Scene scene(soup);
    const Predicates predicates = scene.predicates();
    const auto plane = [&](std::size_t k) { return scene.pieces()[k].support; };
    ASSERT_EQ(scene.pieces().size(), 3u);
    Predicate_counts counts;
    const Sign sign = predicates.orientation(plane(0), plane(1), plane(2), counts);
    EXPECT_NE(sign, CGAL::ZERO);
    EXPECT_EQ(predicates.orientation(plane(1), plane(0), plane(2), counts), -sign);
    EXPECT_EQ(predicates.orientation(plane(1), plane(1), plane(2), counts), CGAL::ZERO);
    EXPECT_EQ(counts.filtered, flat ? 0u : 2u);
    EXPECT_EQ(counts.gmp, flat ? 2u : 0u);
    EXPECT_EQ(counts.combinatorial, 1u);
  }
}

}  // namespace

TEST(Side_of_a_located_point, agrees_with_rationals_on_the_plane_and_beside_it) {
  for (const int bits : {10, 26, 53, 54, 120}) {
    Random random(static_cast<std::uint64_t>(bits));
    std::uint64_t filtered = 0, by_gmp = 0;
    for (int round = 0; round < 100; ++round) {
      Grid grid(bits);
      const Bundle bundle(random, bits, 30);
      for (int i = 0; i < 3; ++i) grid.plane(bundle.plane(random, bits < 20 ? 20 : bits));
      grid.plane(random_plane(random, bits, false));
      const Predicates predicates = grid.predicates();
      for (const int shift : {0, 1, 300}) {
        std::array<Integer, 3> x = bundle.p;
        Integer w = bundle.q;
        for (Integer& t : x) t <<= static_cast<unsigned>(shift);
        w <<= static_cast<unsigned>(shift);
        if (shift != 0) x[random() % 3] += random() % 2 ? 1 : -1;  // a hair beside
        const Located_point q = located(grid, x, w);
        for (std::size_t l = 0; l < grid.handles.size(); ++l)
          for (const bool opposite : {false, true}) {
            Predicate_counts counts;
            const Sign truth = sign(evaluate(grid.made[l], {rational(x[0], w), rational(x[1], w), rational(x[2], w)}));
            ASSERT_EQ(predicates.side(q, opposite ? grid.handles[l].opposite() : grid.handles[l], counts),
                      opposite ? -truth : truth);
            filtered += counts.filtered;
            by_gmp += counts.gmp;
            if (truth == CGAL::ZERO) {
              ASSERT_EQ(deciding_stage(counts), "gmp");
            }
          }
      }
    }
    EXPECT_GT(filtered, 100u);
    EXPECT_GT(by_gmp, 100u);
  }
}

TEST(Side_of_a_located_point, is_filtered_in_general_position) {
  Grid grid(20);
  const Plane h = grid.plane({1, 2, 3, 4});
  Predicate_counts counts;
  EXPECT_EQ(grid.predicates().side(located(grid, {1, 1, 1}, 3), h, counts), CGAL::POSITIVE);
  EXPECT_EQ(grid.predicates().side(located(grid, {-10, 1, 1}, 1), h, counts), CGAL::NEGATIVE);
  EXPECT_EQ(counts.filtered, 2u);
  EXPECT_EQ(grid.predicates().side(located(grid, {-9, 1, 1}, 1), h, counts), CGAL::ZERO);
  EXPECT_EQ(counts.gmp, 1u);
}

TEST(Side_of_a_located_point, is_right_where_products_underflow) {
  // On a wide grid planes have doubles below 1, so products of subnormal coordinates round by whole units: 0.375 x 4 is
  // 2 units, 0.8125 x 4 is 3.
  Grid grid(60);
  const Plane h = grid.plane({6, 6, -13, 0});
  for (const int m : {1, 2, 3, 4, 5, 6, 7, 12, -4, -1}) {
    const Integer w = power_of_two(1074 - 60);
    Predicate_counts counts;
    ASSERT_EQ(grid.predicates().side(located(grid, {m, m, m}, w), h, counts), m > 0 ? CGAL::NEGATIVE : CGAL::POSITIVE)
        << m;
  }
}

TEST(Side_of_a_located_point, is_right_where_a_coefficient_underflows_and_the_point_is_far_away) {
  Grid grid(600);
  const Plane h = grid.plane({1, 0, power_of_two(1100), 0});  // in doubles 0, 0, 1/2
  // x = -2^1020 ranges, z = 2^-90 ranges: x + 2^1100 z < 0.
  const std::array<Integer, 3> x{-power_of_two(1020 + 600 + 90), 0, power_of_two(600)};
  Predicate_counts counts;
  EXPECT_EQ(grid.predicates().side(located(grid, x, power_of_two(90)), h, counts), CGAL::NEGATIVE);
  EXPECT_EQ(grid.predicates().side(located(grid, x, power_of_two(90)), h.opposite(), counts), CGAL::POSITIVE);
}

TEST(Side_of_a_located_point, is_right_beyond_the_range_of_doubles) {
  Grid grid(20);
  const Plane h = grid.plane({1, -1, 0, 1}), g = grid.plane({1, 1, 1, 1});
  const Integer huge = power_of_two(1023) - 1;
  Located_point q{huge * 2, huge * 2 + 1, 0, 1, 0, 0, 0, infinity};
  Predicate_counts counts;
  EXPECT_EQ(grid.predicates().side(q, h, counts), CGAL::ZERO);
  EXPECT_EQ(grid.predicates().side(q, g, counts), CGAL::POSITIVE);
  EXPECT_EQ(counts.gmp, 2u);
  // Doubles whose products and sums overflow.
  EXPECT_EQ(grid.predicates().side(located(grid, {power_of_two(1023), power_of_two(1023) + 1, 0}, 1), h, counts),
            CGAL::ZERO);
  EXPECT_EQ(grid.predicates().side(located(grid, {power_of_two(1023), power_of_two(1023), -power_of_two(1023)}, 1), g,
                                   counts),
            CGAL::POSITIVE);
}

// ---- Known incidences

TEST(Point_planes, hold_the_pairs_that_they_were_made_of) {
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs{{2, 9}, {0, 4}, {2, 1}, {0, 4}, {3, 9}, {2, 4}};
  const Point_planes table(4, pairs);
  for (std::uint32_t point = 0; point < 6; ++point)
    for (std::uint32_t plane = 0; plane < 12; ++plane)
      EXPECT_EQ(table.contains(point, plane),
                std::find(pairs.begin(), pairs.end(), std::pair{point, plane}) != pairs.end())
          << point << ' ' << plane;
  EXPECT_EQ(table.other_plane(2, 3, 4), 9u);
  EXPECT_EQ(table.other_plane(2, 3, 9), Vertex::no_plane);
  EXPECT_EQ(table.other_plane(0, 2, 9), 4u);
  EXPECT_EQ(table.other_plane(1, 2, 9), Vertex::no_plane);
  EXPECT_FALSE(Point_planes().contains(0, 0));
}
