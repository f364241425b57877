// Rounded results that are broken, and what snapping makes of them: sound ones are solids again, which has nothing to
// do with how they were found: their volume is what they wind round positively, and somewhere.

#include "shapes.h"

#include "../sample.h"

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/rounding.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/solid_oracle.h>
#include <sightline/io/off.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
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

Polygon_soup point_alone(const Exact_point& p) {
  Polygon_soup soup;
  soup.add_point(p[0], p[1], p[2]);
  return soup;
}

Polygon_soup face_alone(const Polygon_soup& soup, Face_id face) {
  Polygon_soup alone;
  std::vector<Point_id> corners;
  for (const Point_id p : soup.loop(face)) {
    const Exact_point at = soup.point(p);
    corners.push_back(alone.add_point(at[0], at[1], at[2]));
  }
  alone.add_face(corners);
  return alone;
}

Rational exact_of_float(const Rational& x) { return exact(static_cast<double>(static_cast<float>(x.get_d()))); }

void expect_solid(const Polygon_soup& surface, const std::string& name) {
  const std::vector<Polygon_soup> one{surface};
  EXPECT_TRUE(flaws(Operands(one)).empty()) << name;
  EXPECT_EQ(volume(surface), volume(united(one))) << name;
  EXPECT_EQ(volume(surface), volume(united(one, Inside_rule::nonzero))) << name;
}

using Place = std::array<float, 3>;
Place place_in_floats(const Exact_point& p) {
  Place place;
  for (std::size_t k = 0; k < 3; ++k) place[k] = static_cast<float>(p[k].get_d());
  return place;
}

/// Whether a cube around p, 2 reach wide, is seen to meet no face: by its box, or its plane.
bool is_off(const Polygon_soup& surface, const Exact_point& p, const Rational& reach) {
  for (Face_id f = 0; f < surface.face_count(); ++f) {
    const auto loop = surface.loop(f);
    bool apart = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto above = [&](Point_id q) { return surface.point(q)[k] > p[k] + reach; };
      const auto below = [&](Point_id q) { return surface.point(q)[k] < p[k] - reach; };
      apart = apart || std::all_of(loop.begin(), loop.end(), above) || std::all_of(loop.begin(), loop.end(), below);
    }
    const Exact_point o = surface.point(loop[0]);
    Exact_point normal;
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const Exact_point part = cross(minus(surface.point(loop[i]), o), minus(surface.point(loop[i + 1]), o));
      for (std::size_t k = 0; k < 3; ++k) normal[k] += part[k];
    }
    const Rational height = abs(dot(normal, minus(p, o)));
    if (!apart && height <= reach * (abs(normal[0]) + abs(normal[1]) + abs(normal[2]))) return false;
  }
  return true;
}

/// That the two have the same inside farther from the one than that; how many points could be asked.
int expect_same_inside(const Polygon_soup& before, const Rounded_surface& after, int points, generate::Random& random,
                       const std::string& name) {
  const harness::Solid_oracle then(before), now(after.soup);
  const Rational reach = exact(after.farthest);
  int asked = 0;
  for (int i = 0; i < points; ++i) {
    // Beside a corner, some times as far as anything was moved.
    Exact_point p = before.point(static_cast<Point_id>(random.below(before.point_count())));
    for (Rational& x : p) x += reach * static_cast<long>(random.between(-12, 12)) / 4;
    if (!is_off(before, p, reach)) continue;
    ++asked;
    if (now.is_on_a_face(p)) ADD_FAILURE() << name << ": the surface is there";
    else EXPECT_EQ(now.winding(p, random), then.winding(p, random)) << name;
  }
  return asked;
}

/// That each point before is where its nearest numbers are, or said to have vanished, and that all others are said to
/// be new.
void expect_points_told(const Polygon_soup& before, const Rounded_surface& after, const std::string& name) {
  std::set<Place> nearest, now;
  std::size_t vanished = 0, added = 0;
  for (Point_id p = 0; p < after.soup.point_count(); ++p) {
    for (const Rational& x : after.soup.point(p)) EXPECT_EQ(exact_of_float(x), x) << name;
    now.insert(place_in_floats(after.soup.point(p)));
  }
  for (Point_id p = 0; p < before.point_count(); ++p) {
    const Rounded_surface alone = rounded(point_alone(before.point(p)), Rounding::to_float);
    nearest.insert(place_in_floats(alone.soup.point(0)));
    vanished += now.count(place_in_floats(alone.soup.point(0))) == 0;
  }
  for (Point_id p = 0; p < after.soup.point_count(); ++p)
    added += nearest.count(place_in_floats(after.soup.point(p))) == 0;
  EXPECT_EQ(now.size(), after.soup.point_count()) << name << ": each point is there once";
  EXPECT_EQ(after.vanished.size(), vanished) << name;
  EXPECT_EQ(after.added.size(), added) << name;
  for (const Point_id p : after.added)
    EXPECT_EQ(nearest.count(place_in_floats(after.soup.point(p))), 0u) << name << ", " << p;
}

TEST(Snapping, keeps_no_point_of_faces_that_vanish) {
  // A cube, and a tetrahedron that is smaller than the step of floats.
  std::string text = "OFF\n12 10 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n";
  text += "10 10 10\n10.0000000000000000001 10 10\n10 10.0000000000000000001 10\n10 10 10.0000000000000000001\n";
  text += "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  text += "3 8 10 9\n3 8 9 11\n3 9 10 11\n3 10 8 11\n";
  const Rounded_surface after = snapped(read_off({"tiny.off", text}), Rounding::to_float);
  EXPECT_TRUE(after.is_sound());
  EXPECT_EQ(after.soup.point_count(), 8u);
  EXPECT_EQ(after.soup.face_count(), 6u);
  EXPECT_EQ(after.vanished, (std::vector<Point_id>{8, 9, 10, 11}));
}

TEST(Snapping, leaves_a_solid_wherever_rounding_does_not) {
  int broken = 0, asked = 0;
  std::size_t vanished = 0, added = 0, of_grid = 0, most_rounds = 0, turned = 0;
  generate::Random random(7);
  for (int seed = 0; seed < test_scenes::sample(20); ++seed)
    for (const long far : {100000L, 1L << 20, 10000000L}) {
      const std::string name = "seed " + std::to_string(seed) + ", " + std::to_string(far);
      const Polygon_soup exact = without_holes(united(cubes(seed, 6, far))).soup;
      const Rounded_surface near = rounded(exact, Rounding::to_float), snap = snapped(exact, Rounding::to_float);
      EXPECT_EQ(near.rounds + near.vanished.size() + near.added.size(), 0u);
      EXPECT_TRUE(snap.is_sound()) << name;
      expect_solid(snap.soup, name);
      if (near.is_sound()) {  // then it is what rounding gives
        EXPECT_EQ(snap.rounds, 0u) << name;
        EXPECT_EQ(snap.face_of, near.face_of) << name;
        EXPECT_EQ(volume(snap.soup), volume(near.soup)) << name;
        continue;
      }
      ++broken;
      EXPECT_GT(snap.rounds, 0u) << name;
      EXPECT_EQ(snap.face_of.size(), snap.soup.face_count()) << name;
      EXPECT_EQ(snap.moved, near.moved) << name;
      if (far < 10000000) EXPECT_LT(4 * snap.vanished.size(), exact.point_count()) << name << ": most points stay";
      EXPECT_GE(snap.farthest, near.farthest) << name;
      const double step = std::ldexp(1.0, std::ilogb(static_cast<double>(far) + 4) - 23);
      if (snap.rounds <= 3)
        EXPECT_LE(snap.farthest, near.farthest + (static_cast<double>(snap.rounds) - 1) * step / 2 + step / 1024)
            << name;
      EXPECT_LT(snap.farthest, 10 * static_cast<double>(far) * 0x1p-23) << name;
      expect_points_told(exact, snap, name);
      if (seed < 6) asked += expect_same_inside(exact, snap, 40, random, name);
      vanished += snap.vanished.size();
      added += snap.added.size();
      for (const Point_id p : snap.added) {
        const Exact_point at = snap.soup.point(p);
        of_grid += std::all_of(at.begin(), at.end(),
                               [&](const Rational& x) { return Rational(x / sightline::exact(step)).get_den() == 1; });
      }
      most_rounds = std::max(most_rounds, snap.rounds);
      turned += snap.turned.size();
      // Faces lie along those that they are said to be parts of.
      for (Face_id f = 0; f < snap.soup.face_count(); ++f)
        for (const Point_id p : snap.soup.loop(f)) {
          const Polygon_soup face = face_alone(exact, snap.face_of.at(f));
          EXPECT_FALSE(is_off(face, snap.soup.point(p), sightline::exact(snap.farthest))) << name << ", face " << f;
        }
    }
  RecordProperty("broken", broken);
  EXPECT_GT(turned, test_scenes::least(20u));
  EXPECT_GT(broken, test_scenes::least(25));
  EXPECT_GT(asked, test_scenes::least(100));
  EXPECT_GT(vanished, 0u);
  EXPECT_GT(added, 0u);
  EXPECT_GT(10 * of_grid, 9 * added) << "new points are of a grid in all coordinates, but for those that were numbers";
  EXPECT_GT(most_rounds, 2u);
}

TEST(Snapping, of_doubles_too) {
  int broken = 0;
  for (int seed = 0; seed < test_scenes::sample(10); ++seed) {
    const std::string name = "seed " + std::to_string(seed);
    const Polygon_soup exact = without_holes(united(cubes(seed, 6, 1000000000000000))).soup;
    broken += !rounded(exact, Rounding::to_double).is_sound();
    const Rounded_surface snap = snapped(exact, Rounding::to_double, true);
    EXPECT_TRUE(snap.is_sound()) << name;
    expect_solid(snap.soup, name);
    for (Face_id f = 0; f < snap.soup.face_count(); ++f) EXPECT_EQ(snap.soup.loop(f).size(), 3u) << name;
  }
  EXPECT_GT(broken, test_scenes::least(5));
}

TEST(Snapping, ends_where_the_nearest_numbers_come_again_and_again) {
  // Two spheres far off, of which three faces go round in a circle of rounds unless some points are put aside.
  std::size_t most_rounds = 0;
  for (int seed = 0; seed < test_scenes::sample(180); ++seed) {
    const Polygon_soup one = generate::triangulated_sphere(16, 9, 0),
                       other = generate::triangulated_sphere(16, 9, 0.3 + 0.007 * seed);
    Set_options options;
    options.operation = set_operations[static_cast<std::size_t>(seed) % 4];
    const Set_result result = set_operation(Operands(std::vector<Polygon_soup>{one, other}), options);
    const Polygon_soup exact = generate::translated(without_holes(result.soup).soup, {100000, 0, 0});
    const Rounded_surface snap = snapped(exact, Rounding::to_float);
    EXPECT_TRUE(snap.is_sound()) << seed;
    most_rounds = std::max(most_rounds, snap.rounds);
  }
  if (!test_scenes::is_sanitized()) EXPECT_GT(most_rounds, 6u);
}

TEST(Snapping, moves_nothing_that_the_numbers_hold) {
  const Polygon_soup cube = box({0, -1, 2}, {3, 1, 4});
  for (const Rounded_surface& same : {rounded(cube, Rounding::to_float), snapped(cube, Rounding::to_float)}) {
    EXPECT_TRUE(same.is_sound());
    EXPECT_EQ(same.moved, 0u);
    EXPECT_EQ(same.farthest, 0);
    EXPECT_EQ(volume(same.soup), volume(cube));
  }
}

TEST(Snapping, rounds_to_floats_once) {
  // The nearest doubles are halfway between two floats, and the even one of these is not the nearer one.
  const Rational half(1, 1 << 24), little = generate::power_of_two(-80);
  const Exact_point p{1 + half + little, 1 + 3 * half - little, -1 - half - little};
  const Rounded_surface near = rounded(point_alone(p), Rounding::to_float);
  EXPECT_EQ(near.soup.point(0), (Exact_point{1 + 2 * half, 1 + 2 * half, -1 - 2 * half}));
  const Exact_point ties{1 + half, 1 + 3 * half, -1 - half};
  EXPECT_EQ(rounded(point_alone(ties), Rounding::to_float).soup.point(0), (Exact_point{1, 1 + 4 * half, -1}));
  // Likewise between the greatest float and what would be the next.
  const Rational greatest = exact(std::numeric_limits<float>::max()), beyond = greatest + generate::power_of_two(103);
  const Exact_point last{beyond - little, little - beyond, 0};
  EXPECT_EQ(rounded(point_alone(last), Rounding::to_float).soup.point(0), (Exact_point{greatest, -greatest, 0}));
  EXPECT_THROW(rounded(point_alone({0, beyond, 0}), Rounding::to_float), std::domain_error);
}

TEST(Snapping, takes_coarser_grids_after_as_many_rounds_as_it_is_allowed) {
  const Polygon_soup exact = without_holes(united(cubes(0, 6, 1L << 20))).soup;
  const Rounded_surface whole = snapped(exact, Rounding::to_float);
  ASSERT_GT(whole.rounds, 1u);
  EXPECT_EQ(whole.coarser, 0);
  generate::Random random(3);
  int asked = 0;
  for (std::size_t most = 1; most < whole.rounds; ++most) {
    const std::string name = std::to_string(most) + " rounds";
    const Rounded_surface coarse = snapped(exact, Rounding::to_float, false, {}, most);
    EXPECT_TRUE(coarse.is_sound()) << name;
    expect_solid(coarse.soup, name);
    ASSERT_GT(coarse.coarser, 0) << name;
    EXPECT_GT(coarse.rounds, most) << name;
    EXPECT_EQ(coarse.moved, whole.moved);
    const Rational step = sightline::exact(std::ldexp(1.0, 20 - 23 + coarse.coarser));
    for (Point_id p = 0; p < coarse.soup.point_count(); ++p)
      for (const Rational& x : coarse.soup.point(p)) EXPECT_EQ(Rational(x / step).get_den(), 1) << name;
    EXPECT_LE(sightline::exact(coarse.farthest), step * static_cast<long>(coarse.rounds)) << name;
    expect_points_told(exact, coarse, name);
    asked += expect_same_inside(exact, coarse, 40, random, name);
  }
  EXPECT_GT(asked, 0);
  const Rounded_surface just_so = snapped(exact, Rounding::to_float, false, {}, whole.rounds);
  EXPECT_EQ(just_so.coarser, 0);
  EXPECT_EQ(just_so.rounds, whole.rounds);
  EXPECT_EQ(volume(just_so.soup), volume(whole.soup));
}

TEST(Snapping, ends_where_numbers_do) {
  // As far as floats go, where a coarser grid has points beyond them; cubes of a few steps.
  const Polygon_soup exact =
      generate::translated(generate::scaled(without_holes(united(cubes(3, 6, 0))).soup, generate::power_of_two(106)),
                           {sightline::exact(0x1.ffffe0p127), 0, 0});
  const Rounded_surface snap = snapped(exact, Rounding::to_float, false, {}, 1);
  EXPECT_TRUE(snap.is_sound());
  EXPECT_GT(snap.coarser, 0);
  expect_points_told(exact, snap, "far");
}

TEST(Snapping, what_is_thinner_than_the_step_vanishes_all_of_it_perhaps) {
  const Polygon_soup slab = box({0, 0, 1}, {1, 1, 1 + Rational(1, 1 << 30)});
  const Rounded_surface snap = snapped(slab, Rounding::to_float);
  EXPECT_TRUE(snap.is_sound());
  EXPECT_EQ(snap.soup.face_count(), 0u);
  EXPECT_EQ(snap.vanished.size(), 8u);
  EXPECT_TRUE(snap.added.empty());
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
    EXPECT_TRUE(near.misplaced.empty()) << name << ": then it is told";
  }
  EXPECT_GT(through, test_scenes::least(2));
}

TEST(Snapping, what_stands_upon_a_face_may_go_on_to) {
  // A box that is rounded, and beside it a tetrahedron on an edge right across the top of a box that stays as it is.
  const Rational third(1, 3);
  Polygon_soup all = box({8, 8, third}, {9, 9, 1});
  add_box(all, {-2, -2, 0}, {2, 2, 1});
  std::vector<Point_id> p;
  for (const Exact_point& at :
       {Exact_point{-3, -1, 1}, Exact_point{3, 1, 1}, Exact_point{-1, 1, 2}, Exact_point{1, -1, 2}})
    p.push_back(all.add_point(at[0], at[1], at[2]));
  for (const std::vector<Point_id>& loop : std::vector<std::vector<Point_id>>{
           {p[0], p[2], p[1]}, {p[0], p[1], p[3]}, {p[0], p[3], p[2]}, {p[1], p[2], p[3]}})
    all.add_face(loop);
  const Rounded_surface near = rounded(all, Rounding::to_float);
  EXPECT_EQ(near.moved, 4u);
  EXPECT_TRUE(near.is_sound());
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
  EXPECT_FALSE(near.is_sound());
  EXPECT_EQ(near.misplaced, (std::vector<Face_id>{0, 1, 2, 3}));
  const Rounded_surface snap = snapped(thin, Rounding::to_float);
  EXPECT_TRUE(snap.is_sound());
  expect_solid(snap.soup, "snapped");
}

TEST(Snapping, breaks_solids_that_are_made_for_it) {
  generate::Random random(1);
  const int count = test_scenes::sample(60);
  int turned_inside_out = 0, through = 0;
  for (int k = 0; k < count; ++k) {
    const Polygon_soup thin = generate::thin_tetrahedron(random), upon = generate::tetrahedron_upon_a_box(random);
    for (const Polygon_soup* solid : {&thin, &upon}) {
      const Rational size = volume(*solid);
      EXPECT_GT(size, 0) << k;
      EXPECT_EQ(size, volume(united({*solid}))) << k;
    }
    const Rounded_surface of_thin = rounded(thin, Rounding::to_float);
    EXPECT_TRUE(of_thin.turned.empty() && of_thin.collapsed.empty()) << k;
    turned_inside_out += of_thin.misplaced.size() == 4 && volume(of_thin.soup) < 0;
    through += !rounded(upon, Rounding::to_float).crossing.empty();
  }
  EXPECT_GT(turned_inside_out, test_scenes::least(3));
  EXPECT_GT(through, test_scenes::least(10));
}

TEST(Snapping, merges_what_is_thinner_than_the_numbers_step) {
  // A slab whose two sides are one in floats, beside a cube that stays as it is.
  Polygon_soup slab = box({0, 0, 1}, {1, 1, 1 + Rational(1, 1 << 30)});
  add_box(slab, {2, 0, 0}, {3, 1, 1});
  EXPECT_EQ(rounded(slab, Rounding::to_float).collapsed.size(), 8u);
  const Rounded_surface snap = snapped(slab, Rounding::to_float);
  EXPECT_TRUE(snap.is_sound());
  EXPECT_EQ(snap.rounds, 2u);  // in the first its top and bottom lie upon each other
  EXPECT_EQ(snap.soup.face_count(), 6u);
  EXPECT_EQ(volume(snap.soup), 1);
}

}  // namespace
