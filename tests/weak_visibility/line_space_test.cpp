// Sides in doubles where doubles end: coordinates of all exponents, mixed, against integers.

#include "scenes.h"

#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/search/line_cell.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/families.h>

#include <gtest/gtest.h>

#include <array>

namespace {

using namespace sightline;
using generate::power_of_two;

generate::Posed_scene mixed(std::uint64_t seed) {
  generate::Family_parameters parameters;
  parameters.seed = seed;
  return generate::family("exponents").make(parameters);
}

/// Asks `ask` of 300 of them: seed, occluders and source.
template <class Ask>
void in_each_mixed_scene(Ask ask) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const generate::Posed_scene posed = mixed(seed);
    const Scene scene(posed.soup);
    if (scene.pieces().empty()) continue;
    const Occluders occluders(scene);
    ask(seed, occluders, weak_source(occluders, posed.source));
  }
}

TEST(Near_coordinates, are_at_most_a_half_and_not_all_of_them_small_at_any_scale) {
  for (const int power : {-1060, -500, 0, 500, 1000})
    for (const long odd : {1L, 3L, 999999999999999999L}) {  // the last one: a wide grid
      Polygon_soup soup;
      const Rational size = power_of_two(power);
      soup.add_face({soup.add_point(0, 0, 0), soup.add_point(Rational(size / odd), 0, 0), soup.add_point(0, size, 0)});
      const Scene scene(soup);
      const Occluders occluders(scene);
      double most = 0;
      for (const Near_point& p : occluders.polygon(0)) most = std::max(most, sightline::size(p.near));
      EXPECT_LE(most, 0.5) << power << ' ' << odd;
      EXPECT_GE(most, 1.0 / 16) << power << ' ' << odd;
      for (const Near_point& p : occluders.polygon(0))
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(p.near[k], occluders.frame().near(p.exact[k], p.exact[3]), 0x1p-51 * std::fabs(p.near[k]));
    }
}

TEST(Near_coordinates, of_forms_of_degree_three_are_those_of_rationals_but_for_rounding) {
  std::size_t asked = 0;
  for (const int power : {-900, -60, 0, 500})
    for (const long odd : {1L, 3L, 999999999999999999L}) {
      Polygon_soup soup;
      const Rational size = power_of_two(power);
      soup.add_face({soup.add_point(0, 0, 0), soup.add_point(Rational(size / odd), 0, 0), soup.add_point(0, size, 0)});
      const Scene scene(soup);
      const Near_frame frame(scene);
      const Integer large = Integer(odd) * Integer(odd) * Integer(odd);
      for (const Integer& p : {Integer(1), Integer(-3), Integer(large + 1), Integer(-large * 12345)})
        for (const Integer& w : {Integer(1), Integer(7), Integer(large + 2)}) {
          const Rational exact = frame.near_cubic(p, w);
          const long e = frame.exponent_of_cubic(p, w);
          const Rational scaled = abs(times_power(exact, -e));
          EXPECT_LT(scaled, 1);
          EXPECT_GE(scaled, Rational(1, 4));
          const double near = frame.near_cubic(p, w, -e);
          EXPECT_LE(abs(sightline::exact(near) - times_power(exact, -e)), scaled * power_of_two(-52));
          ++asked;
        }
    }
  EXPECT_EQ(asked, 4u * 3 * 4 * 3);
}

TEST(Side_of_a_near_plane, is_that_of_integers_for_coordinates_of_all_exponents) {
  std::size_t asked = 0;
  in_each_mixed_scene([&](std::uint64_t seed, const Occluders& occluders, const Weak_source& source) {
    for (std::uint32_t f = 0; f < occluders.scene().pieces().size(); ++f)
      for (std::uint32_t g = 0; g <= occluders.scene().pieces().size(); ++g)
        for (const Near_point& p : g < occluders.scene().pieces().size() ? occluders.polygon(g) : source.polygon) {
          ASSERT_EQ(side(occluders.plane(f), p), sgn(value(occluders.plane(f), p))) << seed;
          ++asked;
        }
  });
  EXPECT_GT(asked, 5000u);
}

TEST(Side_of_a_piece, is_that_of_its_polygon_for_coordinates_of_all_exponents) {
  std::array<std::size_t, 4> found{};
  in_each_mixed_scene([&](std::uint64_t seed, const Occluders& occluders, const Weak_source& source) {
    for (std::uint32_t piece = 0; piece < occluders.scene().pieces().size(); ++piece)
      for (const Near_plane* h : {&source.plane, &occluders.plane(0)}) {
        const int s = side(*h, occluders.polygon(piece));
        EXPECT_EQ(occluders.side_of(piece, *h), s) << seed << ", " << piece;
        ++found[static_cast<std::size_t>(s + 1)];
      }
  });
  for (const std::size_t count : found) EXPECT_GT(count, 0u);
}

TEST(Side_error, bounds_the_sides_of_edges_for_coordinates_of_all_exponents) {
  std::size_t told = 0;
  in_each_mixed_scene([&](std::uint64_t seed, const Occluders& occluders, const Weak_source& source) {
    for (std::uint32_t f = 0; f < occluders.scene().pieces().size(); ++f)
      for (const Near_point& p : source.polygon)
        for (const Near_point& q : occluders.polygon(0))
          for (std::size_t e = 0; e < occluders.size(f); ++e) {
            const std::span<const Triple> ab = occluders.corners(f);
            const double near = dot(pluecker_of_pair(p.near, q.near), occluders.edges(f)[e]),
                         error = side_error(ends(size(p.near), size(q.near)),
                                            ends(size(ab[e]), size(ab[(e + 1) % ab.size()])));
            if (!(std::fabs(near) > error)) continue;
            ++told;
            const Exact_pluecker edge = occluders.exact_pluecker_of(occluders.edge_points(f, e));
            ASSERT_EQ(near > 0 ? 1 : -1, sgn(dot(pluecker_of_pair(p.exact, q.exact), edge))) << seed;
          }
  });
  EXPECT_GT(told, 500u);
}

TEST(Near_point, and_what_it_leaves_are_its_coordinates_twice_as_exactly) {
  std::size_t left = 0;
  in_each_mixed_scene([&](std::uint64_t seed, const Occluders& occluders, const Weak_source& source) {
    const Rational unit = occluders.frame().unit();
    for (std::uint32_t f = 0; f <= occluders.scene().pieces().size(); ++f)
      for (const Near_point& p : f < occluders.scene().pieces().size() ? occluders.polygon(f) : source.polygon)
        for (std::size_t k = 0; k < 3; ++k) {
          if (!std::isfinite(p.near[k])) continue;
          const Rational true_one = Rational(p.exact[k], p.exact[3]) / unit,
                         error = abs(sightline::exact(p.near[k]) + sightline::exact(p.rest[k]) - true_one);
          ASSERT_LE(error, abs(true_one) * power_of_two(-104) + power_of_two(-1074)) << seed;
          left += p.rest[k] != 0;
        }
  });
  EXPECT_GT(left, 100u);
}

/// How many rows are undecided and how many decided, each of them as integers say.
std::array<std::size_t, 2> rows_as_integers_say(const Occluders& occluders, const Weak_source& source) {
  std::array<std::size_t, 2> rows{};
  Edge_lines lines(occluders);
  for (std::uint32_t target = 0; target < occluders.scene().pieces().size(); ++target) {
    Line_domain domain(std::make_shared<const Near_polygon>(source.polygon),
                       std::make_shared<const Near_polygon>(occluders.polygon(target)));
    for (std::uint32_t f = 0; f < occluders.scene().pieces().size(); ++f)
      for (const Edge_lines::Edge& edge : lines.of(f)) {
        const Side_row& row = domain.row(lines, edge.line, occluders.frame());
        const std::vector<Rational>& sides = domain.exact_sides(lines, edge.line, occluders.frame());
        const bool positive = std::any_of(sides.begin(), sides.end(), [](const Rational&x) { return x > 0; }),
                   negative = std::any_of(sides.begin(), sides.end(), [](const Rational&x) { return x < 0; });
        EXPECT_EQ(row.decided, positive == negative ? 0 : positive ? 1 : -1);
        ++rows[row.decided != 0];
        if (row.decided != 0) continue;
        for (std::size_t c = 0; c < sides.size(); ++c) {
          const double value = row.values[c];
          EXPECT_TRUE(std::isfinite(value) &&
                      abs(sightline::exact(value) - times_power(sides[c], row.exponent)) <= sightline::exact(row.error))
              << value << ' ' << row.error;
        }
      }
  }
  return rows;
}

TEST(Side_row, is_that_of_integers_within_its_error_for_coordinates_of_all_exponents) {
  std::array<std::size_t, 2> rows{};
  in_each_mixed_scene([&](std::uint64_t seed, const Occluders& occluders, const Weak_source& source) {
    SCOPED_TRACE(seed);
    const std::array<std::size_t, 2> more = rows_as_integers_say(occluders, source);
    for (std::size_t k = 0; k < 2; ++k) rows[k] += more[k];
  });
  EXPECT_GT(rows[0], 1000u);
  EXPECT_GT(rows[1], 1000u);
}

/// Triangles of size 1: about the origin, of doubles that use all of their bits; and so far away that doubles have no
/// eighths, in thirds: all that tells their corners apart is in what doubles leave.
TEST(Side_row, of_small_faces_near_and_far_is_that_of_integers_within_its_error) {
  weak_scenes::Random random(7);
  for (const auto& [far, steps] : {std::pair{0ul, 1ul << 53}, {1000000000000000ul, 3 * 1024ul}}) {
    std::size_t undecided = 0;
    for (int scene_number = 0; scene_number < 20; ++scene_number) {
      std::vector<weak_scenes::Points> faces;
      for (const unsigned long z : {4, 3, 2, 1}) {
        weak_scenes::Points corners;
        for (int k = 0; k < 3; ++k) {
          std::array<Rational, 3> p;
          for (Rational& x : p) {
            const unsigned long drawn = random.below(steps);
            x = Rational(far) + Rational(drawn, steps);
          }
          corners.push_back(weak_scenes::at(p[0], p[1], p[2] + z));
        }
        faces.push_back(corners);
      }
      faces.push_back(weak_scenes::rectangle(0, 1, 0, 1, 0));
      const Scene scene(weak_scenes::soup_of(faces));
      if (scene.pieces().size() < 5) continue;
      ASSERT_EQ(Near_frame(scene).has_exact_points(), far == 0 && scene.points().bits() <= 53);
      const Occluders occluders(scene);
      undecided += rows_as_integers_say(occluders, weak_source(occluders, 3))[0];
    }
    EXPECT_GT(undecided, 100u);
  }
}

TEST(Side_row, of_a_source_beyond_doubles_products_is_rounded_from_integers) {
  const Rational huge = power_of_two(600);
  const Scene scene(
      weak_scenes::soup_of({weak_scenes::rectangle(-1, 1, -1, 1, 1), weak_scenes::rectangle(0, 1, 0, 1, 2)}));
  const Occluders occluders(scene);
  const weak_scenes::Points corners = weak_scenes::rectangle(-huge, huge, -huge, huge, huge);
  EXPECT_GT(rows_as_integers_say(occluders, weak_source(occluders, corners))[0], 4u);
}

/// Faces of a millionth of the scene's size, far from its middle: ways between their points are as exact as if they
/// were all that there is.
TEST(Side_row, of_small_faces_far_from_the_middle_takes_no_integers) {
  const auto square = [](long x, long y, long z) { return weak_scenes::rectangle(x, x + 3, y, y + 3, z); };
  const long far = 10000000;
  const Scene scene(weak_scenes::soup_of({square(far, 0, 10), square(far + 1, 1, 5), square(-far, 0, 0)}));
  const Occluders occluders(scene);
  Edge_lines lines(occluders);
  Line_domain domain(std::make_shared<const Near_polygon>(occluders.polygon(0)),
                     std::make_shared<const Near_polygon>(weak_source(occluders, square(far, 0, 0)).polygon));
  for (const Edge_lines::Edge& edge : lines.of(1)) {
    const Side_row& row = domain.row(lines, edge.line, occluders.frame());
    EXPECT_NE(row.error, 0x1p-52);  // what integers leave
    EXPECT_LT(row.error, 0x1p-35);
    EXPECT_FALSE(lines[edge.line].made);
  }
}

/// A wall of tiles between two squares: lines meet those of the same place, and just so their neighbours.
TEST(Occluders, near_a_shaft_are_those_that_its_planes_do_not_keep_away) {
  const auto tile = [](long x, long y, long z) {
    return weak_scenes::rectangle(10 * x, 10 * x + 10, 10 * y, 10 * y + 10, z);
  };
  std::vector<weak_scenes::Points> faces;
  for (long x = -10; x <= 10; ++x)
    for (long y = -10; y <= 10; ++y) faces.push_back(tile(x, y, 50));
  faces.push_back(weak_scenes::rectangle(1, 9, 1, 9, 100));
  const Scene scene(weak_scenes::soup_of(faces));
  const Occluders occluders(scene);
  const std::uint32_t last = static_cast<std::uint32_t>(faces.size() - 1);
  const auto near = [&](const weak_scenes::Points& source) {
    return occluders.near_shaft(weak_source(occluders, source).polygon, occluders.polygon(last));
  };
  const std::uint32_t middle = 10 * 21 + 10;
  EXPECT_EQ(near(weak_scenes::rectangle(1, 9, 1, 9, 0)), (std::vector<std::uint32_t>{middle, last}));
  EXPECT_EQ(near(weak_scenes::rectangle(11, 19, 1, 9, 0)), (std::vector<std::uint32_t>{middle, middle + 21, last}));
  EXPECT_EQ(near(weak_scenes::rectangle(-59, -51, 41, 49, 0)), (std::vector<std::uint32_t>{middle - 3 * 21 + 2, last}));
}

TEST(Side_error, is_infinite_where_products_might_be) {
  EXPECT_TRUE(std::isinf(side_error(1, 1, 1, 0x1p62)));
  EXPECT_TRUE(std::isinf(side_error(1, 1, 1, std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(std::isinf(side_error(ends(0x1p64, 0), ends(0, 0))));
  EXPECT_TRUE(std::isinf(side_error(ends(1, std::numeric_limits<double>::infinity()), ends(1, 1))));
  EXPECT_LT(side_error(ends(0x1p62, 1), ends(1, 1)), 1e-10 * 0x1p62);
}

/// A wall that leans by so little that a coefficient of its plane is no double, and a source so far away that it
/// counts: 2^-1340 times 2^1000 is more than the wall's distance of 2^-360 from the origin.
TEST(Weakly_visible, is_a_wall_whose_lean_is_below_the_least_double_from_where_it_matters) {
  const Rational x = power_of_two(-360), leaning = x - power_of_two(-1340), far = power_of_two(1000);
  Polygon_soup soup;
  soup.add_face(
      {soup.add_point(x, 0, 0), soup.add_point(leaning, 1, 0), soup.add_point(leaning, 1, 1), soup.add_point(x, 0, 1)});
  const Scene scene(soup);
  const Occluders occluders(scene);
  for (const Rational& width : {power_of_two(-500), Rational(1)}) {
    const std::vector<Exact_point> lamp{{0, far, 0}, {width, far, 0}, {0, far, 1}};  // looks to the wall
    const Weakly_visible found = weakly_visible(occluders, {weak_source(occluders, lamp)});
    EXPECT_EQ(found.visible, std::vector<Face_id>{0});
    const Verdict verdict = verify_weak(soup, weak_certificate(scene, {lamp}, false, found));
    EXPECT_TRUE(verdict.accepted) << verdict.why;
  }
}

TEST(Weakly_visible, proves_what_it_says_for_coordinates_of_all_exponents) {
  std::size_t visible = 0, hidden = 0, undecided = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const generate::Posed_scene posed = mixed(seed);
    const Scene scene(posed.soup);
    const Occluders occluders(scene);
    Weak_options options;
    options.threads = 1;
    options.search.cells = 300;
    const Weakly_visible found = weakly_visible(occluders, {weak_source(occluders, posed.source)}, options);
    const Verdict verdict = verify_weak(posed.soup, weak_certificate(scene, {posed.source}, false, found));
    EXPECT_TRUE(verdict.accepted) << seed << ": " << verdict.why;
    visible += found.visible.size();
    hidden += found.hidden.size();
    undecided += found.undecided.size();
  }
  EXPECT_GT(visible, 20u);
  EXPECT_GT(hidden, 50u);
  EXPECT_LT(10 * undecided, visible + hidden);
}

}  // namespace
