// Rounded results that are broken, and what snapping makes of them: sound ones are solids again, which has nothing to
// do with how they were found: their volume is what they wind round positively, and somewhere.

#include "shapes.h"

#include "../sample.h"

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/rounding.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/kernel/threads.h>

#include <gtest/gtest.h>

#include <utility>

namespace {

using namespace sightline;
using namespace test_solids;

Polygon_soup united(const std::vector<Polygon_soup>& solids, Inside_rule rule = Inside_rule::positive) {
  Set_options options;
  options.inside = rule;
  return set_operation(Operands(solids), options).soup;
}

/// Cubes askew, far from the origin: floats have few digits left there.
std::vector<Polygon_soup> cubes(int seed, int count, long far) {
  std::vector<Polygon_soup> all;
  for (int k = 0; k < count; ++k) {
    const int n = seed * 31 + k;
    all.push_back(
        generate::translated(generate::rotated(box({-1, -1, -1}, {1, 1, 1}),
                                               generate::rotation(5 + n % 3, n % 7 - 3, n % 5 - 2, n % 11 - 5)),
                             {far + Rational(n % 4, 2), Rational(n % 3, 2), Rational(n % 5, 3)}));
  }
  return all;
}

Rational exact_of_float(const Rational& x) { return exact(static_cast<double>(static_cast<float>(x.get_d()))); }

void expect_solid(const Polygon_soup& surface, const std::string& name) {
  const std::vector<Polygon_soup> one{surface};
  EXPECT_TRUE(flaws(Operands(one)).empty()) << name;
  EXPECT_EQ(volume(surface), volume(united(one))) << name;
  EXPECT_EQ(volume(surface), volume(united(one, Inside_rule::nonzero))) << name;
}

TEST(Snapping, leaves_a_solid_where_rounding_does_not_or_says_that_it_could_not) {
  int broken = 0, mended = 0;
  for (int seed = 0; seed < test_scenes::sample(10); ++seed)
    for (const long far : {100000L, 1L << 19, 1L << 20}) {
      const std::string name = "seed " + std::to_string(seed) + ", " + std::to_string(far);
      const Polygon_soup exact = without_holes(united(cubes(seed, 6, far))).soup;
      const Rounded_surface near = rounded(exact, Rounding::to_float), snap = snapped(exact, Rounding::to_float);
      EXPECT_EQ(near.rounds + near.snapped, 0u);
      if (near.is_sound()) expect_solid(near.soup, name);
      if (near.is_sound() || !snap.is_sound()) {  // then it is what rounding gives
        EXPECT_EQ(snap.rounds, near.is_sound() ? 0u : 40u) << name;
        EXPECT_EQ(snap.faults(), near.faults()) << name;
        EXPECT_EQ(snap.face_of, near.face_of) << name;
        EXPECT_EQ(volume(snap.soup), volume(near.soup)) << name;
      }
      broken += !near.is_sound();
      if (near.is_sound() || !snap.is_sound()) continue;
      ++mended;
      expect_solid(snap.soup, name);
      EXPECT_GT(snap.snapped, 0u) << name;
      EXPECT_EQ(snap.face_of.size(), snap.soup.face_count()) << name;
      EXPECT_LT(snap.farthest, static_cast<double>(far) * 0x1p-18) << name;
      for (Point_id p = 0; p < snap.soup.point_count(); ++p)
        for (const Rational& x : snap.soup.point(p)) EXPECT_EQ(exact_of_float(x), x) << name;
    }
  RecordProperty("broken", broken);
  RecordProperty("mended", mended);
  EXPECT_GT(broken, test_scenes::least(8));
  EXPECT_GT(2 * mended, broken);
}

TEST(Snapping, ends_where_its_progress_throws_and_goes_on_where_it_does_not) {
  const Polygon_soup exact = without_holes(united(cubes(0, 6, 1L << 20))).soup;
  const Rounded_surface whole = snapped(exact, Rounding::to_float);
  ASSERT_GT(whole.rounds, 0u);
  struct Over {};
  Rounded_surface result;
  std::size_t asked = 0, most = ~std::size_t{0};
  const auto count = [&](std::size_t done, std::size_t all) {
    EXPECT_LE(done, all);
    if (++asked > most) throw Over();
  };
  const auto snap = [&] { run_with_threads(1, [&] { result = snapped(exact, Rounding::to_float, false, count); }); };
  snap();
  EXPECT_EQ(result.faults(), whole.faults());
  const std::size_t in_all = std::exchange(asked, 0);
  EXPECT_GT(in_all, 3 * exact.face_count());  // in each of its stages
  for (const std::size_t share : {0, 1, 2, 3, 5, 9}) {
    most = in_all * share / 10;
    asked = 0;
    EXPECT_THROW(snap(), Over) << share;
    EXPECT_EQ(asked, most + 1);
  }
}

TEST(Snapping, what_stood_upon_a_face_may_not_go_through_it) {
  // A tetrahedron on an edge that lies right across the top of a box: no other faces of its cross that.
  int through = 0;
  for (int seed = 0; seed < test_scenes::sample(12); ++seed) {
    Polygon_soup both = box({-2, -2, 0}, {2, 2, 1});
    const auto first = static_cast<Point_id>(both.point_count());
    const Rational third(1, 3);
    for (const Exact_point& p :
         {Exact_point{-3, -1, 1}, Exact_point{3, 1, 1}, Exact_point{-1, 1, 2}, Exact_point{1, -1, 2}})
      both.add_point(p[0], p[1], p[2]);
    for (const std::vector<Point_id>& loop :
         std::vector<std::vector<Point_id>>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
      std::vector<Point_id> corners;
      for (const Point_id p : loop) corners.push_back(first + p);
      both.add_face(corners);
    }
    const Polygon_soup exact = generate::translated(
        generate::rotated(both, generate::rotation(7 + seed % 5, seed % 7 - 3, seed % 3 + 1, seed % 11 - 5)),
        {1 << 19, third, third});
    const std::string name = "seed " + std::to_string(seed);
    ASSERT_EQ(volume(exact), volume(united({exact}))) << name;
    const Rounded_surface near = rounded(exact, Rounding::to_float), snap = snapped(exact, Rounding::to_float);
    for (const Rounded_surface* surface : {&near, &snap})
      if (surface->is_sound()) expect_solid(surface->soup, name);
    through += !near.crossing.empty();
  }
  EXPECT_GT(through, test_scenes::least(2));
}

TEST(Snapping, a_thin_solid_that_is_turned_inside_out_is_told_though_no_normal_turns) {
  // A tetrahedron seen from above is a square; its upper edge is one diagonal, and once rounded it is the lower one.
  const Rational step(1, 1 << 23);
  Polygon_soup thin;
  for (const Exact_point& p : {Exact_point{-1, -1, 1 + step * 2 / 5}, Exact_point{1, -1, 1 + step * 3 / 5},
                               Exact_point{1, 1, 1 + step * 2 / 5}, Exact_point{-1, 1, 1}})
    thin.add_point(p[0], p[1], p[2]);
  for (const std::vector<Point_id>& loop :
       std::vector<std::vector<Point_id>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})
    thin.add_face(loop);
  ASSERT_GT(volume(thin), 0);
  const Rounded_surface near = rounded(thin, Rounding::to_float);
  EXPECT_LT(volume(near.soup), 0);
  EXPECT_EQ(near.collapsed.size() + near.turned.size() + near.crossing.size(), 0u);
  EXPECT_EQ(near.misplaced, (std::vector<Face_id>{0, 1, 2, 3}));
  const Rounded_surface snap = snapped(thin, Rounding::to_float);
  EXPECT_TRUE(snap.is_sound());
  expect_solid(snap.soup, "snapped");
}

TEST(Snapping, merges_what_is_thinner_than_the_numbers_step) {
  // A slab whose two sides are one in floats, beside a cube that stays as it is.
  Polygon_soup slab = box({0, 0, 1}, {1, 1, 1 + Rational(1, 1 << 30)});
  add_box(slab, {2, 0, 0}, {3, 1, 1});
  EXPECT_EQ(rounded(slab, Rounding::to_float).collapsed.size(), 8u);
  const Rounded_surface snap = snapped(slab, Rounding::to_float);
  EXPECT_TRUE(snap.is_sound());
  EXPECT_EQ(snap.rounds, 1u);
  EXPECT_EQ(snap.soup.face_count(), 8u);  // the slab's top and bottom, upon each other
  EXPECT_EQ(volume(snap.soup), 1);
}

}  // namespace
