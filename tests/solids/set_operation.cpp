// Set operations: families that are degenerate on purpose, with known volumes; random ones against winding numbers of
// points, volumes and surfaces, which share no code with them; what is refused.

#include "shapes.h"

#include "../sample.h"

#include <sightline/algorithms/solids/box_tree.h>
#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/rounding.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/algorithms/verify/solids_json.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/harness/laws/solids.h>
#include <sightline/io/format.h>
#include <sightline/io/read.h>
#include <sightline/io/write.h>
#include <sightline/kernel/threads.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <sstream>

namespace {

using namespace sightline;
using namespace test_solids;

Set_result of(Set_operation operation, const std::vector<Polygon_soup>& solids,
              Inside_rule rule = Inside_rule::positive) {
  Set_options options;
  options.operation = operation;
  options.inside = rule;
  return set_operation(Operands(solids), options);
}

/// Volumes of union, intersection, difference and symmetric difference.
std::array<Rational, 4> volumes_of(const std::vector<Polygon_soup>& solids, Inside_rule rule = Inside_rule::positive) {
  return {volume(of(Set_operation::unite, solids, rule).soup), volume(of(Set_operation::intersect, solids, rule).soup),
          volume(of(Set_operation::subtract, solids, rule).soup), volume(of(Set_operation::differ, solids, rule).soup)};
}

/// All that is known of any solids.
void expect_right(const std::vector<Polygon_soup>& solids, const std::string& name) {
  generate::Random random(7);
  EXPECT_EQ(harness::flaw_by_points(solids, 10, random), "") << name;
  EXPECT_EQ(harness::flaw_by_volumes(solids), "") << name;
  EXPECT_EQ(harness::flaw_of_surfaces(solids), "") << name;
}

struct Known {
  std::string name;
  std::vector<Polygon_soup> solids;
  std::array<Rational, 4> volumes;  // union, intersection, difference, symmetric difference
};

std::vector<Known> known() {
  const Polygon_soup cube = box({0, 0, 0}, {2, 2, 2});
  Polygon_soup nested = cube, twice = cube;
  const Polygon_soup inner = generate::faces_reversed(
      box({Rational(1, 2), Rational(1, 2), Rational(1, 2)}, {Rational(3, 2), Rational(3, 2), Rational(3, 2)}));
  for (Point_id p = 0; p < 8; ++p) {
    const Exact_point at = inner.point(p);
    nested.add_point(at[0], at[1], at[2]);
  }
  for (Face_id f = 0; f < 6; ++f) {
    std::vector<Point_id> loop;
    for (const Point_id p : inner.loop(f)) loop.push_back(p + 8);
    nested.add_face(loop);
  }
  add_box(twice, {1, 0, 0}, {3, 2, 2});  // wound round twice where both are
  Polygon_soup peak;
  for (const Exact_point& p : {Exact_point{2, 2, 1}, {4, 3, 1}, {3, 4, 1}, {4, 4, 2}}) peak.add_point(p[0], p[1], p[2]);
  for (const auto& face : {std::array<Point_id, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) peak.add_face(face);
  const Rational ulp(1, Integer("4503599627370496"));
  return {
      {"overlap", {cube, box({1, 1, 1}, {3, 3, 3})}, {15, 1, 7, 14}},
      {"an operand twice", {cube, cube}, {8, 8, 0, 0}},
      {"a whole face in common", {cube, box({2, 0, 0}, {4, 2, 2})}, {16, 0, 8, 16}},
      {"part of a face in common", {cube, box({2, 1, 1}, {4, 3, 3})}, {16, 0, 8, 16}},
      {"a face inside a face",
       {cube, box({2, Rational(1, 2), Rational(1, 2)}, {3, 1, 1})},
       {Rational(33, 4), 0, 8, Rational(33, 4)}},
      {"an edge in common", {cube, box({2, 2, 0}, {4, 4, 2})}, {16, 0, 8, 16}},
      {"part of an edge in common", {cube, box({2, 2, 1}, {4, 4, 5})}, {24, 0, 8, 24}},
      {"a vertex in common", {cube, box({2, 2, 2}, {3, 3, 3})}, {9, 0, 8, 9}},
      {"a vertex on an edge", {cube, box({2, 2, 1}, {3, 3, 2})}, {9, 0, 8, 9}},
      {"equal faces, inside", {cube, box({0, 0, 0}, {1, 2, 2})}, {8, 4, 4, 4}},
      {"a corner in common, inside", {cube, box({0, 0, 0}, {1, 1, 1})}, {8, 1, 7, 7}},
      {"a tunnel",
       {cube, box({Rational(1, 2), Rational(1, 2), -1}, {1, 1, 3})},
       {Rational(17, 2), Rational(1, 2), Rational(15, 2), 8}},
      {"inside, apart",
       {cube, box({Rational(1, 2), Rational(1, 2), Rational(1, 2)}, {1, 1, 1})},
       {8, Rational(1, 8), Rational(63, 8), Rational(63, 8)}},
      {"apart", {cube, box({5, 0, 0}, {6, 1, 1})}, {9, 0, 8, 9}},
      {"a shell with a hollow, filled",
       {nested, box({0, 0, 0}, {1, 2, 2})},
       {Rational(15, 2), Rational(7, 2), Rational(7, 2), 4}},
      {"wound round twice", {twice, box({1, 0, 0}, {2, 2, 2})}, {12, 4, 8, 8}},
      {"nothing", {cube, Polygon_soup()}, {8, 0, 8, 8}},
      {"an ulp apart", {cube, box({2 + ulp, 0, 0}, {4, 2, 2})}, {16 - 4 * ulp, 0, 8, 16 - 4 * ulp}},
      {"an ulp into each other", {cube, box({2 - ulp, 0, 0}, {4, 2, 2})}, {16, 4 * ulp, 8 - 4 * ulp, 16 - 4 * ulp}},
      {"a peak on an edge", {cube, peak}, {Rational(17, 2), 0, 8, Rational(17, 2)}},
      {"turned inside out", {cube, generate::faces_reversed(box({1, 1, 1}, {3, 3, 3}))}, {8, 0, 8, 8}},
  };
}

TEST(Box_tree, finds_each_pair_of_boxes_that_meet_once_however_many_middles_are_equal) {
  std::mt19937 random(11);
  for (int k = 0; k < test_scenes::sample(60); ++k) {
    // Small boxes at few or many places, some of them far out.
    const auto places = static_cast<int>(k % 4 == 0 ? 1 : k % 4 == 1 ? 3 : 40);
    std::vector<Polygon_soup> boxes;
    for (auto count = static_cast<int>(random() % 150); count >= 0; --count) {
      std::array<Exact_point, 2> ends;
      for (std::size_t c = 0; c < 3; ++c) {
        ends[0][c] =
            static_cast<long>(random() % static_cast<unsigned>(places)) * (k % 3 == 2 && count % 50 == 0 ? 100000 : 1);
        ends[1][c] = ends[0][c] + Rational(static_cast<unsigned long>(random() % 3) + 1, 2);
      }
      boxes.push_back(box(ends[0], ends[1]));
    }
    const Operands operands(boxes);
    const Box_tree tree(operands);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found, expected;
    for (std::size_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
      tree.for_each_pair(leaf, [&](std::uint32_t i, std::uint32_t first, unsigned met) {
        for (; met != 0; met &= met - 1) {
          const std::uint32_t j = first + static_cast<std::uint32_t>(std::countr_zero(met));
          found.push_back(std::minmax(tree.order()[i], tree.order()[j]));
        }
      });
    std::vector<Box_tree::Box> all(operands.pieces().size());
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        all[i].low[c] = 1e300;
        all[i].high[c] = -1e300;
        for (const Piece_corner& corner : operands.corners(i)) {
          const double x = operands.points().approximate(corner.point, static_cast<int>(c));
          all[i].low[c] = std::min(all[i].low[c], x);
          all[i].high[c] = std::max(all[i].high[c], x);
        }
      }
    for (std::uint32_t j = 0; j < all.size(); ++j)
      for (std::uint32_t i = 0; i < j; ++i)
        if (all[i].meets(all[j])) expected.emplace_back(i, j);
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(found, expected) << k;
  }
}

TEST(Set_operations, of_touching_and_coincident_boxes_have_the_volumes_that_they_must) {
  for (const Known& one : known()) {
    EXPECT_EQ(volumes_of(one.solids), one.volumes) << one.name;
    expect_right(one.solids, one.name);
  }
}

TEST(Set_operations, do_not_mind_exponents_and_rotations) {
  const generate::Rational_matrix matrix = generate::rotation(5, 1, -2, 3);
  for (const Known& one : known()) {
    std::vector<Polygon_soup> turned, tiny, uneven;
    const Rational small = generate::power_of_two(-1000), large = generate::power_of_two(1000);
    for (const Polygon_soup& solid : one.solids) {
      turned.push_back(generate::rotated(solid, matrix));
      tiny.push_back(generate::scaled(solid, small));
      uneven.push_back(generate::mapped(solid, [&](Point_id, const Exact_point& p) {
        return Exact_point{p[0] * large, p[1] * small, p[2]};
      }));
    }
    EXPECT_EQ(volumes_of(turned), one.volumes) << one.name;
    EXPECT_EQ(volumes_of(uneven), one.volumes) << one.name;
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_EQ(volumes_of(tiny)[k], one.volumes[k] * small * small * small) << one.name;
  }
}

TEST(Set_operations, take_what_the_rule_calls_inside) {
  Polygon_soup twice = box({0, 0, 0}, {2, 2, 2});
  add_box(twice, {1, 0, 0}, {3, 2, 2});
  const Polygon_soup back = generate::faces_reversed(box({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(volume(of(Set_operation::unite, {twice}).soup), 12);
  EXPECT_EQ(volume(of(Set_operation::unite, {twice}, Inside_rule::nonzero).soup), 12);
  EXPECT_EQ(volume(of(Set_operation::unite, {twice}, Inside_rule::odd).soup), 8);
  EXPECT_EQ(volume(of(Set_operation::unite, {back}).soup), 0);
  EXPECT_EQ(volume(of(Set_operation::unite, {back}, Inside_rule::nonzero).soup), 1);
  EXPECT_EQ(volume(of(Set_operation::unite, {back}, Inside_rule::odd).soup), 1);
}

TEST(Set_operations, answer_by_winding_numbers) {
  const std::vector<Winding> none, first{{0, 1}}, second{{1, 1}}, both{{0, 1}, {1, 2}}, behind{{0, -1}};
  const auto in = [](Set_operation operation, const std::vector<Winding>& w) {
    return is_in_result(operation, Inside_rule::positive, w, 2);
  };
  const std::array<Set_operation, 4> all{Set_operation::unite, Set_operation::intersect, Set_operation::subtract,
                                         Set_operation::differ};
  const std::vector<std::pair<std::vector<Winding>, std::array<bool, 4>>> table{{none, {false, false, false, false}},
                                                                                {first, {true, false, true, true}},
                                                                                {second, {true, false, false, true}},
                                                                                {both, {true, true, false, false}},
                                                                                {behind, {false, false, false, false}}};
  for (const auto& [w, expected] : table)
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(in(all[k], w), expected[k]);
  EXPECT_FALSE(is_in_result(Set_operation::intersect, Inside_rule::positive, none, 0));
}

TEST(Set_operations, of_random_cones_and_prisms_are_right) {
  harness::Subject subject = harness::boolean();
  std::erase_if(subject.checks, [](const harness::Check& check) {
    return check.name != "points" && check.name != "volumes" && check.name != "surface" && check.name != "proof" &&
           check.name != "turn";
  });
  harness::Fuzz_options options;
  options.scenes = test_scenes::sample(60);
  options.seed = 11;
  harness::Fuzz_summary summary;
  const auto found = harness::fuzz(subject, options, summary);
  EXPECT_FALSE(found) << to_string(found->which) << ": " << found->disagreement.check << ": "
                      << found->disagreement.what;
  EXPECT_GE(summary.by_check["points"].passed, test_scenes::least(50));
}

TEST(Set_operations, merge_the_pieces_of_a_face_and_say_whose_it_is) {
  // A tunnel: two faces of the cube get a hole, and the tunnel's walls are turned.
  const Set_result result = of(Set_operation::subtract, {box({0, 0, 0}, {3, 3, 3}), box({1, 1, -1}, {2, 2, 4})});
  ASSERT_EQ(result.soup.face_count(), 10u);
  std::size_t with_holes = 0;
  for (Face_id f = 0; f < 10; ++f) with_holes += result.soup.loop_count(f) == 2;
  EXPECT_EQ(with_holes, 2u);
  std::map<std::pair<std::uint32_t, bool>, int> sources;
  for (const Result_face& face : result.faces) ++sources[{face.operand, face.turned}];
  EXPECT_EQ(sources, (std::map<std::pair<std::uint32_t, bool>, int>{{{0, false}, 6}, {{1, true}, 4}}));
  EXPECT_TRUE(result.crowded.empty());
  const Hole_free flat = without_holes(result.soup);
  EXPECT_EQ(volume(flat.soup), 24);
  EXPECT_EQ(flat.soup.face_count(), 12u);  // two rings of two polygons
  EXPECT_EQ(flat.face_of.size(), 12u);
  const std::array<double, 2> surface = area(flat.soup);
  EXPECT_LE(surface[0], 64);
  EXPECT_GE(surface[1], 64);
  EXPECT_LT(surface[1] - surface[0], 1e-9);
  const Rational longest = generate::power_of_two(600);  // areas beyond doubles
  EXPECT_EQ(area(box({0, 0, 0}, {longest, longest, longest}))[1], std::numeric_limits<double>::infinity());
  EXPECT_LT(area(box({0, 0, 0}, {longest, longest, longest}))[0], std::numeric_limits<double>::infinity());
  const Rational least(
      1, generate::power_of_two(600).get_num());  // a rectangle across each axis, of less than doubles hold
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Polygon_soup tiny;
    std::vector<Point_id> loop;
    for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      Exact_point p{0, 0, 0};
      p[(axis + 1) % 3] = u * least;
      p[(axis + 2) % 3] = v * least;
      loop.push_back(tiny.add_point(p[0], p[1], p[2]));
    }
    tiny.add_face(loop);
    EXPECT_EQ(area(tiny)[0], 0);
    EXPECT_GT(area(tiny)[1], 0) << axis;
  }
}

TEST(Set_operations, leave_faces_whole_that_nothing_cuts) {
  // A prism over an L, whose two ends are cut into pieces, and a box far from it.
  const std::vector<std::array<int, 2>> outline{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  const auto count = static_cast<Point_id>(outline.size());
  Polygon_soup prism;
  std::vector<Point_id> low, high;
  for (const int z : {0, 1})
    for (const auto& [x, y] : outline) prism.add_point(x, y, z);
  for (Point_id k = 0; k < count; ++k) {
    low.push_back(count - 1 - k);
    high.push_back(count + k);
  }
  prism.add_face(low);
  prism.add_face(high);
  for (Point_id k = 0; k < count; ++k) prism.add_face({k, (k + 1) % count, count + (k + 1) % count, count + k});
  const Set_result result = of(Set_operation::unite, {prism, box({10, 0, 0}, {11, 1, 1})});
  EXPECT_EQ(result.soup.face_count(), 8u + 6u);
  EXPECT_EQ(volume(result.soup), 5 + 1);
}

TEST(Set_operations, give_a_hole_to_the_face_around_it_though_an_island_in_it_touches_it) {
  // A block less two prisms that leave a triangle between them, which touches the hole's outline in one corner.
  const auto prism = [](const std::vector<std::array<Rational, 2>>& outline) {
    Polygon_soup soup;
    const auto n = static_cast<Point_id>(outline.size());
    for (const Rational& z : {Rational(-1), Rational(3)})
      for (const auto& p : outline) soup.add_point(p[0], p[1], z);
    std::vector<Point_id> bottom, top;
    for (Point_id k = 0; k < n; ++k) {
      bottom.insert(bottom.begin(), k);
      top.push_back(n + k);
      soup.add_face({k, (k + 1) % n, n + (k + 1) % n, n + k});
    }
    soup.add_face(bottom);
    soup.add_face(top);
    return soup;
  };
  const Rational half(3, 2);
  const std::vector<Polygon_soup> solids{box({-1, -1, 0}, {5, 5, 1}),
                                         prism({{0, 0}, {4, 0}, {4, 4}, {half, half}, {2, 1}}),
                                         prism({{0, 0}, {1, 2}, {half, half}, {4, 4}, {0, 4}})};
  const Polygon_soup result = of(Set_operation::subtract, solids).soup;
  EXPECT_EQ(volume(result), 36 - 16 + half);
  std::size_t with_hole = 0, islands = 0;
  for (Face_id f = 0; f < result.face_count(); ++f) {
    if (result.loop_count(f) == 2) {
      ++with_hole;
      EXPECT_EQ(result.loop(f, 0).size(), 4u);
      EXPECT_EQ(result.loop(f, 1).size(), 4u);
    } else {
      const std::span<const Point_id> loop = result.loop(f);
      islands += std::all_of(loop.begin(), loop.end(), [&](Point_id p) { return result.point(p)[2] == 1; });
    }
  }
  EXPECT_EQ(with_hole, 2u);  // top and bottom
  EXPECT_EQ(islands, 1u);
  EXPECT_EQ(volume(without_holes(result).soup), volume(result));
}

TEST(Set_operations, list_edges_of_four_faces) {
  const Set_result result = of(Set_operation::unite, {box({0, 0, 0}, {1, 1, 1}), box({1, 1, 0}, {2, 2, 1})});
  ASSERT_EQ(result.crowded.size(), 1u);
  EXPECT_EQ(result.crowded[0].faces, 4u);
  const Exact_point p = result.soup.point(result.crowded[0].from), q = result.soup.point(result.crowded[0].to);
  EXPECT_EQ(std::min(p, q), (Exact_point{1, 1, 0}));
  EXPECT_EQ(std::max(p, q), (Exact_point{1, 1, 1}));
}

/// Where three lines of a face's plane cross, what is kept of it may be every second of six sectors: then none of the
/// lines turns there, and yet the point is a corner.
TEST(Set_operations, have_a_corner_where_three_edges_of_one_face_cross) {
  std::vector<Polygon_soup> solids{
      box({-4, -5, -3}, {5, 4, 0}), box({-3, -4, -5}, {0, 5, 4}), box({-5, -3, -4}, {4, 0, 5}), {}};
  generate::add_prism(solids[3], {{12, -6, -6}, {-6, 12, -6}, {-6, -6, 12}}, {-9, -9, -9});
  generate::Random random(7);
  EXPECT_EQ(harness::flaw_by_points(solids, 30, random), "");
  EXPECT_EQ(harness::flaw_of_surfaces(solids), "");
  const Set_result result = of(Set_operation::differ, solids);
  std::size_t at_the_point = 0;
  for (Face_id f = 0; f < result.soup.face_count(); ++f)
    for (const Point_id p : result.soup.loop(f)) at_the_point += result.soup.point(p) == Exact_point{0, 0, 0};
  EXPECT_EQ(at_the_point, 24u);  // each of six sectors of four planes
}

TEST(Set_operations, take_many_operands_at_once) {
  std::vector<Polygon_soup> lattice;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z) lattice.push_back(box({x, y, z}, {x + 1, y + 1, z + 1}));
  const Set_result all = of(Set_operation::unite, lattice);
  EXPECT_EQ(volume(all.soup), 27);
  EXPECT_EQ(all.soup.face_count(), 54u);
  EXPECT_TRUE(all.crowded.empty());
  EXPECT_EQ(volume(of(Set_operation::subtract, lattice).soup), 1);
  EXPECT_EQ(of(Set_operation::intersect, lattice).soup.face_count(), 0u);
}

TEST(Set_operations, are_the_same_for_any_number_of_threads) {
  const std::vector<Polygon_soup> solids{
      generate::convex_sphere(100), generate::translated(generate::convex_sphere(100), {Rational(1, 2), 0, 0}),
      generate::rotated(generate::convex_sphere(80), generate::rotation(3, 1, 1, 0))};
  std::vector<std::string> texts;
  for (const int threads : {1, 4})
    run_with_threads(threads, [&] {
      std::ostringstream text;
      write_scene(without_holes(of(Set_operation::unite, solids).soup).soup, text, Format::qoff);
      texts.push_back(text.str());
    });
  EXPECT_EQ(texts[0], texts[1]);
  generate::Random random(3);
  EXPECT_EQ(harness::flaw_by_points(solids, 1, random), "");
}

TEST(Rounding, says_what_it_breaks) {
  // A slab thinner than floats at its height, cut by a plane askew.
  const Rational thin(1, 1 << 30);
  const Polygon_soup slab = box({0, 0, 1}, {1, 1, 1 + thin});
  const Rounded_surface floats = rounded(slab, Rounding::to_float), doubles = rounded(slab, Rounding::to_double);
  EXPECT_EQ(doubles.moved, 0u);
  EXPECT_EQ(doubles.soup.face_count(), 6u);
  EXPECT_TRUE(doubles.not_planar.empty() && doubles.collapsed.empty() && doubles.crossing.empty());
  EXPECT_EQ(floats.moved, 4u);
  EXPECT_GE(floats.farthest, 0x1p-30);
  EXPECT_EQ(floats.collapsed.size(), 8u);  // four walls, as triangles: they have no normal that says they are planar
  EXPECT_EQ(rounded(slab, Rounding::to_double, true).soup.face_count(), 12u);
  // Faces through thirds: a square whose corners are rounded is not planar.
  const Polygon_soup turned = generate::rotated(box({0, 0, 0}, {1, 1, 1}), generate::rotation(3, 1, 1, 2));
  const Rounded_surface near = rounded(turned, Rounding::to_double);
  EXPECT_EQ(near.moved, 7u);  // all but the origin
  EXPECT_FALSE(near.not_planar.empty());
  EXPECT_EQ(near.soup.face_count(), 6 + near.not_planar.size());
  EXPECT_LT(near.farthest, 0x1p-52);
  EXPECT_TRUE(near.turned.empty() && near.collapsed.empty() && near.crossing.empty());
  // A triangle, and one whose corner is right above it: the first is rounded up there, the corner down.
  const Rational h(1, 1 << 26);  // an eighth of a float's step beyond 1
  Polygon_soup sheets;
  for (const Exact_point& p : {Exact_point{0, 0, 1 + 5 * h},
                               {1, 0, 1 + 5 * h},
                               {0, 1, 1 + 100 * h},
                               {Rational(1, 4), Rational(1, 8), 1 + 17 * h},
                               {Rational(1, 2), Rational(1, 8), 2},
                               {Rational(1, 4), Rational(1, 4), 2}})
    sheets.add_point(p[0], p[1], p[2]);
  sheets.add_face({0, 1, 2});
  sheets.add_face({3, 4, 5});
  EXPECT_TRUE(rounded(sheets, Rounding::to_double).crossing.empty());
  EXPECT_EQ(rounded(sheets, Rounding::to_float).crossing, (std::vector<std::pair<Face_id, Face_id>>{{0, 1}}));
}

TEST(Progress, of_an_operation_goes_on_to_its_end_and_what_it_throws_ends_it_anywhere) {
  std::vector<Polygon_soup> solids;  // a row of boxes, low and high by turns, each a quarter in the next
  for (int k = 0; k < 20; ++k) solids.push_back(box({3 * k, 0, 0}, {3 * k + 4, 1, 1 + k % 2}));
  const Operands operands(solids);
  std::vector<std::pair<std::size_t, std::size_t>> told;
  Set_options options;
  options.progress = [&](std::size_t done, std::size_t all) { told.emplace_back(done, all); };
  Set_result result;
  run_with_threads(1, [&] { result = set_operation(operands, options); });
  EXPECT_EQ(volume(result.soup), 10 * 8 + 3 + 9 * 2);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back().first, told.back().second);
  // Pairs, cuts, edges of faces, faces: each is told of as it goes on.
  std::array<std::set<std::size_t>, 6> within;
  for (const auto& [done, all] : told) {
    EXPECT_EQ(all, told.back().second);
    if (6 * done % all != 0) within[6 * done / all].insert(done);
  }
  for (const auto& places : within) EXPECT_GT(places.size(), 5u);
  const auto is_cutting = [](const auto& at) { return 3 * at.first >= at.second && 3 * at.first < 2 * at.second; };
  EXPECT_GT(std::count_if(told.begin(), told.end(), is_cutting), static_cast<long>(result.counters.fragments));
  struct Enough {};
  for (std::size_t until = 0; until < told.size(); until += test_scenes::is_sanitized() ? 9 : 1) {
    std::size_t calls = 0;
    options.progress = [&](std::size_t, std::size_t) {
      if (calls++ == until) throw Enough();
    };
    EXPECT_THROW(run_with_threads(1, [&] { set_operation(operands, options); }), Enough) << until;
    EXPECT_EQ(calls, until + 1);
  }
  options.progress = [](std::size_t, std::size_t) { throw Enough(); };
  EXPECT_THROW(run_with_threads(4, [&] { set_operation(operands, options); }), Enough);
}

/// What is wrong with a certificate; empty: nothing.
std::string said_of(const std::string& text) {
  try {
    read_solid_certificate(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Certificates, with_any_words_are_read_as_they_were_written) {
  Solid_certificate certificate;
  certificate.operation = "a \"word\"";
  certificate.inside = "\\\x01";
  certificate.operands = 1;
  certificate.set_aside.push_back({0, 0, "\"\t\n"});
  std::ostringstream text;
  write_solid_certificate(text, certificate);
  const Solid_certificate read = read_solid_certificate(text.str());
  EXPECT_EQ(read.operation, certificate.operation);
  EXPECT_EQ(read.inside, certificate.inside);
  ASSERT_EQ(read.set_aside.size(), 1u);
  EXPECT_EQ(read.set_aside[0].why, certificate.set_aside[0].why);
}

TEST(Certificates, are_read_as_they_were_written_and_what_is_none_is_refused) {
  const std::vector<Polygon_soup> solids{box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 2})};
  const Operands operands(solids);
  Set_options options;
  options.keep_fragments = true;
  const Set_result result = set_operation(operands, options);
  std::ostringstream text;
  write_solid_certificate(text, solid_certificate(operands, options, result));
  const Solid_certificate read = read_solid_certificate(text.str());
  EXPECT_TRUE(verify_solids(solids, read, &result.soup).accepted) << verify_solids(solids, read, &result.soup).why;
  std::ostringstream again;
  write_solid_certificate(again, read);
  EXPECT_EQ(again.str(), text.str());
  // Of other solids, of another operation, with another result.
  EXPECT_FALSE(verify_solids(std::vector{solids[1], solids[0]}, read).accepted);
  EXPECT_FALSE(verify_solids(std::vector{solids[0]}, read).accepted);
  EXPECT_FALSE(verify_solids(solids, read, &solids[0]).accepted);
  Solid_certificate other = read;
  other.operation = "intersection";
  EXPECT_FALSE(verify_solids(solids, other).accepted);
  other = read;
  other.inside = "somewhere";
  EXPECT_FALSE(verify_solids(solids, other).accepted);
  for (const std::string bad :
       {"", "[]", "{}", R"({"format": "sightline boolean 1"})", R"({"format": "sightline order 2"})"})
    EXPECT_THROW(read_solid_certificate(bad), std::invalid_argument) << bad;
  std::string broken = text.str();
  broken.replace(broken.find("\"vertices\": [0"), 14, "\"vertices\": [9999");
  EXPECT_THROW(read_solid_certificate(broken), std::invalid_argument);
  // A key twice; and a large point that is named without end.
  std::string twice = text.str();
  twice.replace(twice.find("\"fate\": "), 0, "\"fate\": \"kept\", ");
  EXPECT_NE(said_of(twice).find("the key \"fate\" is there twice"), std::string::npos) << said_of(twice);
  std::string large = R"({"format": "sightline boolean 1", "operation": "union", "inside": "odd", "operands": 1,
    "points": [["1)" + std::string(500000, '7') +
                      R"(", "0", "0"]], "fragments": [)";
  for (int k = 0; k < 1000; ++k) large += R"({"parts": [], "vertices": [0, 0, 0], "front": [], "fate": "kept"},)";
  large.back() = ']';
  large += R"(, "pieces": [], "set_aside": []})";
  EXPECT_NE(said_of(large).find("they take more than 64 times the file"), std::string::npos) << said_of(large);
}

TEST(Certificates, of_numbers_that_do_not_fit_are_refused_and_errors_are_one_line) {
  const auto with_winding = [&](const std::string& number) {
    return said_of(R"({"format": "sightline boolean 1", "operation": "union", "inside": "positive", "operands": 1,
                       "points": [["0","0","0"],["1","0","0"],["0","1","0"]], "fragments": [{"parts": [[0,0,0,0]],
                       "vertices": [0,1,2], "fate": "kept", "front": [[0,)" +
                   number + R"(]]}], "pieces": [], "set_aside": []})");
  };
  const std::string refused =
      "no certificate of a set operation: a winding number is not a whole one between -2^31 and 2^31";
  for (const char* const good : {"1", "-1", "2147483647", "-2147483647"}) EXPECT_EQ(with_winding(good), "") << good;
  for (const char* const bad :
       {"2147483648", "4294967297", "-2147483648", "-4294967295", "18446744073709551615", "1.5", "\"1\""})
    EXPECT_EQ(with_winding(bad), refused) << bad;
  const std::string said = said_of("{\"format\"\n\x7f: 1");
  EXPECT_TRUE(said.starts_with("no certificate of a set operation: ")) << said;
  for (const char c : said) EXPECT_TRUE(c >= ' ' && c < 127) << said;
}

/// The closed scenes of the collection with so many faces at most, of files that such may have; none where it is not
/// there.
std::vector<std::pair<std::string, Polygon_soup>> closed_scenes(std::size_t most_faces) {
  std::vector<std::pair<std::string, Polygon_soup>> closed;
  const std::filesystem::path folder = SIGHTLINE_SCENES_DIR;
  if (folder.empty()) return closed;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && format_of_ending(entry.path()) && entry.file_size() < 256 * most_faces)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    Polygon_soup soup = read_scene(file);
    if (soup.face_count() == 0 || soup.face_count() > most_faces) continue;
    if (flaws(Operands(std::span(&soup, 1))).empty())
      closed.emplace_back(file.lexically_relative(folder).string(), std::move(soup));
  }
  return closed;
}

/// Whether faces of both are in one plane, or some are in none: moved, they may be cut otherwise.
bool may_share_a_plane(const std::vector<Polygon_soup>& solids) {
  const Operands operands(solids);
  if (!operands.non_planar().empty()) return true;
  std::array<std::set<std::uint32_t>, 2> planes;
  for (std::size_t piece = 0; piece < operands.pieces().size(); ++piece)
    planes[operands.operand_of_piece(piece)].insert(operands.pieces()[piece].support.id());
  return std::any_of(planes[0].begin(), planes[0].end(),
                     [&](std::uint32_t plane) { return planes[1].count(plane) > 0; });
}

TEST(Set_operations, of_real_solids_in_pairs_with_a_plane_in_common_add_up) {
  const auto scenes = closed_scenes(test_scenes::is_sanitized() ? 100 : 300);
  if (scenes.empty()) GTEST_SKIP() << "the collection of scenes is not there";
  generate::Random random(1);
  std::size_t meeting = 0, pairs = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    for (std::size_t j = i; j < scenes.size(); j += test_scenes::is_sanitized() ? 160 : 6) {
      const generate::Solid_pair pair = generate::pair_on_a_plane(scenes[i].second, scenes[j].second, random);
      const std::vector<Polygon_soup> solids(pair.begin(), pair.end());
      EXPECT_TRUE(may_share_a_plane(solids)) << scenes[i].first << " and " << scenes[j].first;
      EXPECT_EQ(harness::flaw_by_volumes(solids), "") << scenes[i].first << " and " << scenes[j].first;
      ++pairs;
      meeting += volume(of(Set_operation::intersect, solids).soup) != 0;
    }
  EXPECT_GT(meeting, pairs / 4);
}

TEST(Set_operations, of_solids_with_faces_that_are_folded_flat_are_solids) {
  // A loop of few places, mostly not planar, and a cone over it.
  std::size_t folded = 0;
  for (std::uint64_t seed = 0; seed < test_scenes::sample(2000u); ++seed) {
    generate::Random random(seed);
    Polygon_soup solid;
    const auto corners = static_cast<Point_id>(5 + random.below(2));
    for (Point_id k = 0; k < corners; ++k) {
      const auto anywhere = [&] { return Rational(static_cast<long>(random.below(3))); };
      solid.add_point(anywhere(), anywhere(), k + 1 < corners ? Rational(0) : Rational(1));
    }
    const Point_id apex = solid.add_point(1, 1, -5);
    std::vector<Point_id> loop;
    for (Point_id k = 0; k < corners; ++k) {
      loop.push_back(k);
      solid.add_face({(k + 1) % corners, k, apex});
    }
    solid.add_face(loop);
    const std::vector<Polygon_soup> alone{solid};
    if (!flaws(Operands(alone)).empty()) continue;
    const Polygon_soup surface = of(Set_operation::unite, alone).soup;
    const std::vector<Polygon_soup> again{surface};
    EXPECT_TRUE(flaws(Operands(again)).empty()) << "seed " << seed;
    EXPECT_EQ(volume(of(Set_operation::unite, again).soup), volume(surface)) << "seed " << seed;
    folded += volume(surface) != 0;
  }
  EXPECT_GT(folded, test_scenes::sample(2000u) / 20);
}

TEST(Operands, that_are_open_are_refused_with_their_edges) {
  Polygon_soup open;
  const Polygon_soup whole = box({0, 0, 0}, {1, 1, 1});
  open.coordinates = whole.coordinates;
  for (Face_id f = 1; f < 6; ++f) open.add_face(whole.loop(f));
  const std::vector<Polygon_soup> solids{whole, open};
  const std::vector<Operand_flaw> found = flaws(Operands(solids));
  ASSERT_EQ(found.size(), 4u);
  for (const Operand_flaw& flaw : found) {
    EXPECT_EQ(flaw.operand, 1u);
    EXPECT_EQ(flaw.from[0], 0);
    EXPECT_EQ(flaw.to[0], 0);
    EXPECT_TRUE(flaw.why.empty());
  }
  Polygon_soup crossed = whole;  // a bow tie there and back: it bounds nothing, but has no surface
  crossed.add_face({0, 3, 1, 2});
  crossed.add_face({2, 1, 3, 0});
  const std::vector<Polygon_soup> alone{crossed};
  const std::vector<Operand_flaw> crossings = flaws(Operands(alone));
  ASSERT_EQ(crossings.size(), 2u);
  EXPECT_EQ(crossings[0].face, 6u);
  EXPECT_EQ(crossings[0].why, "self-intersecting");
  Polygon_soup doubled = whole;  // one face twice is open, all of them twice are not
  doubled.add_face(whole.loop(2));
  EXPECT_EQ(flaws(Operands(std::vector{doubled})).size(), 4u);
  for (const Face_id f : {0u, 1u, 3u, 4u, 5u}) doubled.add_face(whole.loop(f));
  EXPECT_TRUE(flaws(Operands(std::vector{doubled})).empty());
  EXPECT_EQ(volume(of(Set_operation::unite, {doubled}).soup), 1);
  EXPECT_EQ(volume(of(Set_operation::unite, {doubled}, Inside_rule::odd).soup), 0);
}

TEST(Operands, close_up_over_t_junctions) {
  // A box whose top is two faces, its sides not knowing.
  Polygon_soup split = box({0, 0, 0}, {2, 2, 2});
  Polygon_soup with;
  with.coordinates = split.coordinates;
  for (Face_id f = 0; f < 5; ++f) with.add_face(split.loop(f));
  const Point_id a = with.add_point(1.0, 0.0, 2.0), b = with.add_point(1.0, 2.0, 2.0);
  with.add_face({1, a, b, 3});
  with.add_face({a, 5, 7, b});
  EXPECT_TRUE(flaws(Operands(std::vector{with})).empty());
  const Set_result result = of(Set_operation::unite, {with});
  EXPECT_EQ(volume(result.soup), 8);
  EXPECT_EQ(result.soup.face_count(), 7u);
  EXPECT_TRUE(result.crowded.empty());  // the sides got the new corners
}

TEST(Operands, that_are_closed_have_no_flaws_in_any_order_of_faces) {
  std::vector<std::vector<Point_id>> loops{{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}};
  do {
    std::vector<Polygon_soup> solids(1);
    for (const auto& [x, y, z] : {std::array{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) solids[0].add_point(x, y, z);
    for (const std::vector<Point_id>& loop : loops) solids[0].add_face(loop);
    EXPECT_TRUE(flaws(Operands(solids)).empty());
  } while (std::next_permutation(loops.begin(), loops.end()));
}

}  // namespace
