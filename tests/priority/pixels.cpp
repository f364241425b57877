// Sets of faces at pixels against rays in plain rationals, their statistics recounted, and priorities from an eye
// against distances.

#include "../sample.h"
#include "support.h"

#include <sightline/algorithms/priority/pixels.h>
#include <sightline/kernel/traits/point_traits.h>
#include <sightline/harness/generate/buildings.h>

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

using namespace priority_test;

namespace {

using test_scenes::least;
using test_scenes::sample;

using Pixels = std::vector<std::vector<std::uint32_t>>;

Exact_point exact_vector(const Triple& d) { return at(exact(d[0]), exact(d[1]), exact(d[2])); }

/// Kinds of rays and faces that were met.
struct Met {
  std::size_t pierced = 0, on_boundary = 0, behind_eye = 0, edge_on = 0, off_view = 0, along_plane = 0;
};

/// What the exact ray from the eye does to a face: the parameter where it goes through the inside, from the front.
std::optional<Rational> goes_through(const Flat& face, const Exact_point& eye, const Exact_point& d, Met& met) {
  const Rational height = face.height(eye), slope = dot(face.normal, d);
  if (height <= 0) {
    ++(height == 0 ? met.edge_on : met.off_view);
    return std::nullopt;
  }
  if (slope >= 0) {
    met.along_plane += slope == 0;
    return std::nullopt;
  }
  const Rational t = height / -slope;
  const int where = face.holds(along(eye, t, d));
  met.on_boundary += where == 0;
  met.pierced += where == 1;
  return where == 1 ? std::optional(t) : std::nullopt;
}

Pixels brute_sets(const Flats& flats, const Pixel_view& view, Met& met) {
  Pixels pixels;
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const Exact_point d = exact_vector(view.ray(x, y));
      pixels.emplace_back();
      for (std::uint32_t i = 0; i < flats.size(); ++i)
        if (goes_through(flats[i], view.eye, d, met)) pixels.back().push_back(i);
    }
  const Exact_point look = exact_vector(view.look);
  for (const Flat& flat : flats)
    if (flat.height(view.eye) > 0) {
      std::set<int> sides;
      for (const Exact_point& p : flat.corners) sides.insert(sgn(dot(look, minus(p, view.eye))));
      met.behind_eye += sides.count(-1) && sides.count(1);
    }
  return pixels;
}

testing::AssertionResult same_sets(const Pixel_sets& found, const Pixels& expected) {
  if (found.size() != expected.size())
    return testing::AssertionFailure() << found.size() << " pixels, not " << expected.size();
  for (std::size_t p = 0; p < expected.size(); ++p)
    if (!std::equal(found[p].begin(), found[p].end(), expected[p].begin(), expected[p].end()))
      return testing::AssertionFailure() << "pixel " << p << ": found "
                                         << testing::PrintToString(std::vector(found[p].begin(), found[p].end()))
                                         << ", expected " << testing::PrintToString(expected[p]);
  if (found.rays < found.members.size())
    return testing::AssertionFailure() << found.rays << " rays for " << found.members.size() << " members";
  return testing::AssertionSuccess();
}

Pixels listed(const Pixel_sets& sets) {
  Pixels pixels;
  for (std::size_t p = 0; p < sets.size(); ++p) pixels.emplace_back(sets[p].begin(), sets[p].end());
  return pixels;
}

Triple nearest(const Exact_point& d) { return {nearest_double(d[0]), nearest_double(d[1]), nearest_double(d[2])}; }

/// Views of each kind: along an axis through lattice points, at corners and middles of edges, oblique and out of
/// square, wide, flat, from within faces' planes.
Pixel_view random_view(const Flats& flats, std::uint64_t kind, Random& random) {
  const auto face = [&]() -> const Points& { return flats[random.below(flats.size())].corners; };
  const auto corner = [&] {
    const Points& c = face();
    return c[random.below(c.size())];
  };
  const auto times = [&](long most) { return ratio(random.between(-most, most), 4); };
  const auto lattice = [&](std::int64_t reach) {
    Triple d{};
    for (double& x : d) x = static_cast<double>(random.between(-reach, reach));
    return d;
  };
  const Points& first = face();
  const Exact_point size = minus(first[1], first[0]);
  const Rational along_edge = times(12);  // one after another: compilers evaluate arguments in orders of their own
  const Exact_point way_to = corner(), way_from = corner();
  const Rational along_way = times(12);
  const Exact_point start = corner();
  Pixel_view view{along(along(start, along_way, minus(way_from, way_to)), along_edge, size), {}, {}, {}, 12, 9};
  switch (kind % 8) {
    case 0:
    case 1: {  // dyadic fractions across the axes: rays through lattice points
      const std::size_t axis = random.below(3);
      const double side = random.chance(1, 2) ? 1 : -1;
      view.eye = corner();
      view.eye[axis] -= static_cast<long>(side) * static_cast<long>(random.between(1, 4)) *
                        (kind % 2 == 0 ? Rational(1) : Rational(abs(size[0]) + abs(size[1]) + abs(size[2])));
      view.look[axis] = side;
      view.right[(axis + 1) % 3] = random.chance(1, 2) ? 4 : -2;
      view.up[(axis + 2) % 3] = random.chance(1, 2) ? 2 : -8;
      view.width = 8;
      view.height = random.chance(1, 2) ? 8 : 16;
      break;
    }
    case 2:
    case 3: {  // the middle pixel looks at a corner or the middle of an edge, the middle row or column along an edge
      const Points& c = face();
      const std::size_t k = random.below(c.size());
      const Exact_point normal = Flat(c).normal,
                        to = random.chance(1, 2) ? c[k] : centroid({c[k], c[(k + 1) % c.size()]});
      if (random.chance(2, 3)) {
        const std::int64_t beside = random.between(-2, 2);
        const Rational away = ratio(random.between(1, 8), 4);
        view.eye = along(along(to, away, normal), beside, minus(c[0], c[1]));
      }
      view.look = nearest(minus(to, view.eye));
      view.right = nearest(minus(c[(k + 1) % c.size()], c[k]));
      view.up = lattice(3);
      if (random.chance(1, 3)) std::swap(view.right, view.up);
      view.width = 11;
      break;
    }
    case 4:
      view.look = lattice(2);
      view.right = lattice(20);
      view.up = lattice(1);
      break;  // at times zero, or without a right or an up
    case 5:   // in a face's plane, or at a corner; wide
      if (random.chance(1, 2)) {
        view.eye = corner();
      } else {
        const Rational across = times(8), lengthways = times(8);
        view.eye = along(along(first[0], lengthways, size), across, minus(first[2], first[0]));
      }
      view.look = lattice(1);
      view.right = lattice(50);
      view.up = lattice(50);
      break;
    default: {  // at a face from its front, out of square
      const Points& c = face();
      const Exact_point to = inside_of(c, random);
      const Rational beside = times(8), away = ratio(random.between(1, 16), 8);
      view.eye = along(along(to, away, Flat(c).normal), beside, size);
      view.look = nearest(minus(to, view.eye));
      const Triple a = nearest(minus(c[1], c[0])), b = nearest(minus(c[2], c[1]));
      for (std::size_t k = 0; k < 3; ++k) {
        view.right[k] = 1.75 * a[k] + 0.3 * b[k];
        view.up[k] = 0.7 * b[k] + 0.1 * view.look[k];
      }
    }
  }
  return view;
}

/// The same with axes at right angles, but for rounding: the middle ray stays.
Pixel_view squared(Pixel_view view) {
  const auto across = [](const Triple& a, const Triple& b) {
    return Triple{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto scaled_like = [](Triple a, const Triple& b) {
    const double scale =
        (std::fabs(b[0]) + std::fabs(b[1]) + std::fabs(b[2])) / (std::fabs(a[0]) + std::fabs(a[1]) + std::fabs(a[2]));
    for (double& x : a) x *= scale;
    return std::isfinite(scale) ? a : Triple{};
  };
  view.up = scaled_like(across(view.right, view.look), view.up);
  view.right = scaled_like(across(view.look, view.up), view.right);
  return view;
}

TEST(Pixel_view, rays_go_through_the_middles_of_pixels_from_the_top_left) {
  const Pixel_view view{at(0, 0, 0), {0, 0, -1}, {2, 0, 0}, {0, 1, 0}, 4, 2};
  EXPECT_EQ(view.ray(0, 0), (Triple{-1.5, 0.5, -1}));
  EXPECT_EQ(view.ray(3, 0), (Triple{1.5, 0.5, -1}));
  EXPECT_EQ(view.ray(1, 1), (Triple{-0.5, -0.5, -1}));
}

/// All pixels of four views of each of 200 scenes.
void check_sets(bool square, Met& met, std::uint64_t& exact) {
  std::uint64_t rays = 0;
  std::size_t several = 0;
  for (std::uint64_t k = 0; k < test_scenes::sample(200u); ++k) {
    Random random(k);
    const Related scene(degenerate_soup(k));
    if (scene.flats.empty()) continue;
    for (std::uint64_t v = 0; v < 4; ++v) {
      const Pixel_view any = random_view(scene.flats, 4 * (k % 2) + v, random), view = square ? squared(any) : any;
      const Pixel_sets found = pixel_sets(scene.relation, view);
      const Pixels expected = brute_sets(scene.flats, view, met);
      ASSERT_TRUE(same_sets(found, expected))
          << "scene " << k << ", view " << v << ": look " << testing::PrintToString(view.look) << ", right "
          << testing::PrintToString(view.right) << ", up " << testing::PrintToString(view.up);
      exact += found.exact;
      rays += found.rays;
      for (const auto& set : expected) several += set.size() > 1;
    }
  }
  EXPECT_GT(exact, test_scenes::least(200u)) << "signs that doubles could not tell";
  EXPECT_GT(rays, test_scenes::least(15000u));
  EXPECT_GT(several, test_scenes::least(500u));
  EXPECT_GT(met.pierced, test_scenes::least(5000u));
  EXPECT_GT(met.on_boundary, test_scenes::least(200u)) << "rays through edges and corners";
  EXPECT_GT(met.behind_eye, test_scenes::least(70u)) << "on-view faces on both sides of the eye";
  EXPECT_GT(met.edge_on, test_scenes::least(5000u));
  EXPECT_GT(met.off_view, test_scenes::least(5000u));
  EXPECT_GT(met.along_plane, test_scenes::least(200u));
}
TEST(Pixel_sets, are_those_of_exact_rays_on_degenerate_scenes_from_any_eye) {
  Met met;
  std::uint64_t exact = 0;
  check_sets(true, met, exact);
}
TEST(Pixel_sets, are_those_of_exact_rays_where_axes_are_not_at_right_angles) {
  Met met;
  std::uint64_t exact = 0;
  check_sets(false, met, exact);
}

TEST(Pixel_sets, of_a_leaning_image_whose_axes_are_not_at_right_angles_are_the_pixels_that_look_at_the_face) {
  // Pixel (4, 0) looks along (1/8 + 2 * 7/8, 7/8, -1): at (7 1/2, 3 1/2) on the ground.
  const Related scene(soup_of({rectangle(7, 8, 3, 4, 0)}));
  Pixels expected(64);
  expected[4] = {0};
  EXPECT_EQ(listed(pixel_sets(scene.relation, {at(0, 0, 4), {0, 0, -1}, {1, 0, 0}, {2, 1, 0}, 8, 8})), expected);
}

TEST(Pixel_sets, are_those_of_exact_rays_where_axes_are_nearly_in_a_plane_and_their_squares_are_too_small) {
  Met met;
  for (std::uint64_t k = 0; k < 60; ++k) {
    // Two short axes, a long one hardly beside their plane, and a face that the rays of the middle row go through.
    Random random(k);
    const auto number = [&] { return static_cast<double>(random.between(-(1 << 30), 1 << 30)) * 0x1p-30; };
    const Triple a{number(), number(), number()}, b{number(), number(), number()}, w{number(), number(), number()};
    const double of_a = number(), of_b = number(), of_w = std::ldexp(number(), -52);
    Pixel_view view{at(0, 0, 0), {}, {}, {}, 9, 9};
    Points corners(3);
    for (std::size_t i = 0; i < 3; ++i) {
      view.look[i] = std::ldexp(a[i], -282);
      view.right[i] = std::ldexp(b[i], -282);
      view.up[i] = std::ldexp(of_a * a[i] + of_b * b[i] + of_w * w[i], 282);
    }
    for (Exact_point& p : corners) {
      const double x = number(), y = std::ldexp(number(), -50);
      for (std::size_t i = 0; i < 3; ++i) p[i] = exact(a[i] + x * b[i] + y * w[i]);
    }
    const Related scene(soup_of({corners, {corners[2], corners[1], corners[0]}}));
    ASSERT_TRUE(same_sets(pixel_sets(scene.relation, view), brute_sets(scene.flats, view, met))) << k;
  }
  EXPECT_GT(met.pierced, 100u);
}

TEST(Pixel_sets, do_not_depend_on_the_length_of_the_axes) {
  std::size_t members = 0;
  for (std::uint64_t k = 0; k < 120; ++k) {
    Random random(k);
    const Related scene(touching_soup(random));
    Met met;
    const Pixel_view view = squared(random_view(scene.flats, k, random));
    const Pixels expected = brute_sets(scene.flats, view, met);
    for (const int power :
         {-940, -600, -538, -534, -500, -60, 1, 60, 500, 900}) {  // powers of two: the same rays, longer or shorter
      Pixel_view scaled = view;
      for (Triple* d : {&scaled.look, &scaled.right, &scaled.up})
        for (double& x : *d) x = std::ldexp(x, power);
      ASSERT_TRUE(same_sets(pixel_sets(scene.relation, scaled), expected)) << "scene " << k << ", 2^" << power;
    }
    members += met.pierced;
  }
  EXPECT_GT(members, 500u);
}

TEST(Pixel_sets, of_a_square_are_the_pixels_strictly_inside_it) {
  // From height 4 a pixel is one wide on the ground; the middles are at -3.5 .. 3.5.
  const auto pixels = [](const Points& face) {
    const Related scene(soup_of({face}));
    std::set<std::size_t> set;
    const Pixel_sets sets = pixel_sets(scene.relation, {at(0, 0, 4), {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 8, 8});
    for (std::size_t p = 0; p < sets.size(); ++p)
      if (!sets[p].empty()) set.insert(p);
    return set;
  };
  const Rational half = ratio(1, 2);
  EXPECT_EQ(pixels(rectangle(-1, 1, 0, 1, 0)), (std::set<std::size_t>{27, 28}));
  EXPECT_EQ(pixels(rectangle(-3 * half, 3 * half, half, 5 * half, 0)), (std::set<std::size_t>{19, 20}))
      << "its sides go through middles";
  EXPECT_EQ(pixels(reversed(rectangle(-3, 3, -3, 3, 0))), (std::set<std::size_t>{})) << "from behind";
  EXPECT_EQ(pixels(rectangle(-100, 100, -100, 100, 5)), (std::set<std::size_t>{})) << "above the eye";
  EXPECT_EQ(pixels(rectangle(-100, 100, -100, 100, -1000)).size(), 0u) << "a thousand below, 100 is half a pixel away";
  EXPECT_EQ(pixels(rectangle(-80, 80, -80, 80, -100)).size(), 36u);
}

TEST(Pixel_sets, of_an_empty_scene_or_image_are_empty) {
  const Related none(Polygon_soup{}), one(soup_of({rectangle(-1, 1, -1, 1, 0)}));
  const Pixel_view view{at(0, 0, 4), {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 3, 2};
  const Pixel_sets sets = pixel_sets(none.relation, view);
  EXPECT_EQ(sets.size(), 6u);
  EXPECT_TRUE(sets.members.empty());
  Pixel_view empty = view;
  empty.width = empty.height = 0;
  EXPECT_EQ(pixel_sets(one.relation, empty).size(), 0u);
  empty.width = empty.height = 1;
  EXPECT_EQ(listed(pixel_sets(one.relation, empty)), (Pixels{{0}}));
}

TEST(Pixel_sets, ask_before_each_row_and_end_by_what_that_throws) {
  const Related one(soup_of({rectangle(-1, 1, -1, 1, 0)}));
  const Pixel_view view{at(0, 0, 4), {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 40, 40};
  std::size_t asked = 0;
  const Pixel_sets sets = pixel_sets(one.relation, view, [&] { ++asked; });
  EXPECT_TRUE(same_sets(sets, listed(pixel_sets(one.relation, view))));
  EXPECT_GE(asked, 10u);  // a quarter of the image is covered
  EXPECT_LE(asked, 14u);
  const auto enough = [] { throw std::runtime_error("enough"); };
  EXPECT_THROW(pixel_sets(one.relation, view, enough), std::runtime_error);
}

TEST(Pixel_sets, are_the_same_under_other_exact_kernels) {
  std::size_t members = 0;
  for (std::uint64_t k = 0; k < 80; ++k) {
    Random random(k);
    const Related scene(degenerate_soup(k));
    if (scene.flats.empty()) continue;
    const Point_traits<CGAL::Epeck> epeck(scene.scene);
    const Point_traits<CGAL::Cartesian<CGAL::Gmpq>> gmpq(scene.scene);
    for (std::uint64_t v = 0; v < 3; ++v) {
      const Pixel_view view = random_view(scene.flats, random.below(8), random);
      const Pixels expected = listed(pixel_sets(scene.relation, view));
      ASSERT_EQ(listed(pixel_sets(Priority_relation(epeck), view)), expected) << "scene " << k;
      ASSERT_EQ(listed(pixel_sets(Priority_relation(gmpq), view)), expected) << "scene " << k;
      for (const auto& set : expected) members += set.size();
    }
  }
  EXPECT_GT(members, 1000u);
}

TEST(Pixel_statistics, are_what_counting_each_pixel_gives) {
  std::size_t some_left_out = 0, ties = 0;
  for (std::uint64_t k = 0; k < 300; ++k) {
    Random random(k);
    const std::uint32_t faces = 1 + static_cast<std::uint32_t>(random.below(9));
    Pixel_sets sets;
    Pixels pixels(random.below(40));
    for (auto& set : pixels) {
      for (std::uint32_t i = 0; i < faces; ++i)
        if (random.chance(1, 3)) set.push_back(i);
      sets.members.insert(sets.members.end(), set.begin(), set.end());
      sets.begin.push_back(static_cast<std::uint32_t>(sets.members.size()));
    }
    std::vector<std::uint32_t> priority(faces);
    for (auto& number : priority) number = static_cast<std::uint32_t>(random.below(4));
    std::uint64_t covered = 0, several = 0, single = 0, all = 0, left = 0, counted = 0;
    std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> by_size;
    std::vector<std::uint32_t> image;
    for (const auto& set : pixels) {
      std::size_t best = 0;
      for (const std::uint32_t i : set)
        best += std::all_of(set.begin(), set.end(), [&](std::uint32_t j) { return priority[i] <= priority[j]; });
      covered += !set.empty();
      several += set.size() > 1;
      single += best == 1;
      all += set.size();
      left += best;
      image.push_back(static_cast<std::uint32_t>(best));
      ++by_size[{set.size(), best}];
      some_left_out += best < set.size();
      ties += best > 1;
    }
    const Pixel_statistics found = pixel_statistics(sets, priority);
    ASSERT_EQ((std::vector{found.covered, found.several, found.single, found.faces, found.left}),
              (std::vector{covered, several, single, all, left}))
        << "case " << k;
    ASSERT_EQ(found.image, image) << "case " << k;
    for (std::size_t s = 0; s < found.by_size.size(); ++s)
      for (std::size_t l = 0; l < found.by_size[s].size(); ++l) {
        ASSERT_EQ(found.by_size[s][l], (by_size[{s, l}])) << "case " << k << ": " << s << ", " << l;
        counted += found.by_size[s][l];
      }
    ASSERT_EQ(counted, covered) << "case " << k;
  }
  EXPECT_GT(some_left_out, 500u);
  EXPECT_GT(ties, 500u);
}

using Tree_of_faces = Priority_tree<Exact_traits>;

/// By polygon the node of the cycle that it is in, or -1, or -2 if it is not in the tree, having been cut.
std::vector<std::int64_t> cycles_of(const Tree_of_faces& tree) {
  std::vector<std::int64_t> cycle(tree.polygons.size(), -2);
  for (const auto slot : tree.slots)
    if (slot >= 0) cycle.at(static_cast<std::size_t>(slot)) = -1;
  for (std::size_t n = 0; n < tree.nodes.size(); ++n)
    if (tree.nodes[n].kind == Tree_of_faces::Kind::cycle)
      for (const auto slot : tree.slots_of(tree.nodes[n]))
        cycle.at(static_cast<std::size_t>(slot)) = static_cast<std::int64_t>(n);
  return cycle;
}

struct Ranked {
  std::size_t ahead = 0, in_cycles = 0, from_planes = 0;
};

/// Along each ray a nearer polygon has a lower number, the same only in one cycle; and the sets are those of exact
/// rays, for parts of faces too.
void check_priorities(const Related& scene, const Priority_tree_options& options, const Pixel_view& view,
                      Ranked& ranked) {
  const Tree_of_faces tree = build_priority_tree(scene.traits, options);
  const std::vector<std::uint32_t> all_numbers = priorities(scene.traits, tree, view.eye);
  const std::vector<std::int64_t> all_cycles = cycles_of(tree);
  ASSERT_EQ(all_numbers.size(), tree.polygons.size());
  std::vector<Convex_polygon<Exact_traits>> polygons;
  std::vector<std::uint32_t> number;
  std::vector<std::int64_t> cycle;
  Flats flats;
  for (std::size_t i = 0; i < tree.polygons.size(); ++i) {
    if (all_cycles[i] == -2) continue;
    polygons.push_back(tree.polygons[i]);
    number.push_back(all_numbers[i]);
    cycle.push_back(all_cycles[i]);
    flats.emplace_back(priority_detail::positions(scene.traits, tree.polygons[i]));
  }
  for (std::size_t i = 0; i < number.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_EQ(number[i] == number[j], cycle[i] >= 0 && cycle[i] == cycle[j]) << i << ", " << j;
  Met met;
  const Pixel_sets sets = pixel_sets(Priority_relation<Exact_traits>(scene.traits, polygons), view);
  ASSERT_TRUE(same_sets(sets, brute_sets(flats, view, met)));
  ranked.from_planes += tree.counters.planes;
  for (std::size_t p = 0; p < sets.size(); ++p) {
    const Exact_point d =
        exact_vector(view.ray(static_cast<std::uint32_t>(p % view.width), static_cast<std::uint32_t>(p / view.width)));
    std::vector<std::pair<Rational, std::uint32_t>> hits;
    for (const std::uint32_t i : sets[p]) hits.emplace_back(*goes_through(flats[i], view.eye, d, met), i);
    for (const auto& near : hits)
      for (const auto& far : hits) {
        if (far.first <= near.first) continue;
        const bool one_cycle = cycle[near.second] >= 0 && cycle[near.second] == cycle[far.second];
        ASSERT_TRUE(one_cycle || number[near.second] < number[far.second])
            << "pixel " << p << ": " << near.second << " before " << far.second;
        ++(one_cycle ? ranked.in_cycles : ranked.ahead);
      }
  }
}

TEST(Priorities, ascend_with_the_distance_along_every_ray_but_within_a_cycle_of_the_tree) {
  Ranked whole, cut;
  for (std::uint64_t k = 0; k < sample(250u); ++k) {
    Random random(k);
    const Related scene(degenerate_soup(k));
    if (scene.flats.empty()) continue;
    const Pixel_view view = squared(random_view(scene.flats, 5 + random.below(3), random));
    ASSERT_NO_FATAL_FAILURE(check_priorities(scene, {k % 2 == 0, false, {}}, view, whole)) << "scene " << k;
    ASSERT_NO_FATAL_FAILURE(check_priorities(scene, {k % 2 == 1, true, {}}, view, cut)) << "scene " << k << ", cut";
  }
  EXPECT_GT(whole.ahead, least(150u));
  EXPECT_GT(whole.in_cycles, least(200u));
  EXPECT_GE(whole.from_planes, least(50u));
  EXPECT_GT(cut.ahead, least(500u));
  EXPECT_EQ(cut.in_cycles, 0u);
}

TEST(Priorities, ascend_strictly_in_bodies_that_have_no_cycle) {
  Ranked ranked;
  for (const char* kind : {"city", "stacked", "menger_sponge"}) {
    const Related scene(generate::make(kind, *kind == 'c' ? 6 : *kind == 's' ? 10 : 1, 1));
    const auto box = scene.scene.box();
    const Exact_point middle = along(centroid({box[0], box[1]}), ratio(1, 1009), at(1, 2, 3));
    for (const Triple& look : {Triple{1, 0.25, -0.5}, Triple{-0.5, 1, -1}, Triple{0.125, 0.25, -1}}) {
      const Rational away = abs(box[1][0] - box[0][0]) + abs(box[1][1] - box[0][1]) + abs(box[1][2] - box[0][2]);
      const Pixel_view view =
          squared({along(middle, -away, exact_vector(look)), look, {-0.3, 0.2, 0.05}, {0.1, 0.05, 0.4}, 16, 12});
      ASSERT_NO_FATAL_FAILURE(check_priorities(scene, {}, view, ranked)) << kind;
    }
  }
  EXPECT_GT(ranked.ahead, 500u);
  EXPECT_EQ(ranked.in_cycles, 0u);
}

}  // namespace
