// The depth sort against exact rays through pixel centres; each of its tests, swaps and cuts on a scene made for it.

#include "same_images.h"

#include <sightline/algorithms/image/newell.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/families.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace {

using namespace sightline;
using view_scenes::at;
using view_scenes::Family;
using view_scenes::Points;
using view_scenes::rectangle;
using view_scenes::reversed;
using view_scenes::soup_of;

// ---- Any scene

class Newell : public testing::TestWithParam<Family> {};

TEST_P(Newell, exact_is_what_rays_meet_but_for_ties) {
  std::size_t shown = 0;
  std::uint64_t swaps = 0, splits = 0;
  image_test::for_each_view(
      GetParam(), image_test::seeds_of(24),
      [&](const Scene& scene, const Pixel_view& pixels, const std::string& label) {
        const Piece_image truth = centres(Exact_view(scene, pixels.eye), pixels);
        const Piece_image image = newell(scene, pixels, Image_kernel::exact, {.threads = 1});
        EXPECT_EQ(image_test::difference(image, truth, [&](std::size_t i) { return !truth.tied[i]; }), "") << label;
        EXPECT_EQ(image.counters.edge_on, truth.counters.edge_on) << label;
        EXPECT_EQ(image.counters.unordered, 0u) << label;
        const Piece_image again = newell(scene, pixels, Image_kernel::exact, {.threads = 2});
        EXPECT_EQ(again.pieces, image.pieces) << label;
        Image_counters::each([&](const char* key, auto member) {
          EXPECT_EQ(again.counters.*member, image.counters.*member) << label << ": " << key;
        });
        for (const std::uint32_t piece : truth.pieces) shown += piece != Piece_image::nothing;
        swaps += image.counters.swaps;
        splits += image.counters.splits;
      });
  EXPECT_GT(shown, test_scenes::least(1000u));
  EXPECT_GE(swaps, test_scenes::least(10u));
  if (GetParam() == Family::cyclic || GetParam() == Family::crossing) {
    EXPECT_GE(splits, test_scenes::least(30u));
  }
}

TEST_P(Newell, rounded_numbers_make_an_image) {
  image_test::for_each_view(GetParam(), 6, [&](const Scene& scene, const Pixel_view& pixels, const std::string& label) {
    for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers}) {
      const Piece_image image = newell(scene, pixels, kernel, {.threads = 1});
      EXPECT_EQ(image.pieces.size(), std::size_t{pixels.width} * pixels.height);
      EXPECT_TRUE(std::all_of(image.pieces.begin(), image.pieces.end(), [&](std::uint32_t piece) {
        return piece == Piece_image::nothing || piece < scene.pieces().size();
      })) << label;
      EXPECT_EQ(newell(scene, pixels, kernel, {.threads = 2}).pieces, image.pieces) << label;
    }
  });
}
INSTANTIATE_TEST_SUITE_P(All, Newell, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

// ---- Each test, on two faces

/// What is seen from 0, along -z, as far across and upwards as before.
Pixel_view pixels(std::uint32_t size = 40) { return {at(0, 0, 0), {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, size, size + 2}; }

struct Sorted {
  Scene scene;
  Newell_order order;

  explicit Sorted(const std::vector<Points>& faces, Image_kernel kernel = Image_kernel::exact)
      : scene(soup_of(faces)), order(newell_order(scene, pixels(), kernel)) {}
  std::vector<std::uint32_t> pieces() const {
    std::vector<std::uint32_t> pieces;
    for (const Painted_polygon& polygon : order.polygons) pieces.push_back(polygon.piece);
    return pieces;
  }
  /// Pairs that passed, by the number of the test.
  std::array<std::uint64_t, 5> passed() const {
    const Newell_counters& c = order.counters;
    return {c.by_depth, c.by_extents, c.by_behind, c.by_in_front, c.by_apart};
  }
  /// Exact, and in doubles, the picture shows what rays meet, off ties or everywhere.
  void expect_truth(bool with_ties) const {
    const Piece_image truth = centres(Exact_view(scene, pixels().eye), pixels());
    EXPECT_LT(std::count(truth.pieces.begin(), truth.pieces.end(), Piece_image::nothing), 1600);
    for (const Image_kernel kernel : {Image_kernel::exact, Image_kernel::double_numbers})
      EXPECT_EQ(image_test::difference(newell(scene, pixels(), kernel), truth,
                                       [&](std::size_t i) { return with_ties || !truth.tied[i]; }),
                "");
  }
};
using Pieces = std::vector<std::uint32_t>;
using Passed = std::array<std::uint64_t, 5>;

/// From depth 5 at the bottom to 9 at the top, over [left, right].
Points ramp(long left, long right) { return {at(left, -1, -5), at(right, -1, -5), at(right, 1, -9), at(left, 1, -9)}; }

TEST(Newell_pairs, that_are_apart_in_depth_are_passed_over_by_the_list) {
  const Sorted sorted({rectangle(-1, 1, -1, 1, -4), rectangle(-2, 2, -2, 2, -8)});
  EXPECT_EQ(sorted.pieces(), (Pieces{1, 0}));
  EXPECT_EQ(sorted.passed(), (Passed{0, 0, 0, 0, 0}));
}
TEST(Newell_pairs, are_apart_in_depth_where_the_list_is_out_of_order) {
  // The ramp is sorted first and hides face 1, which is moved to the end, and is compared with face 2 there.
  const Points over{at(-12, -4, -4), at(12, -4, -4), at(12, 12, -12), at(-12, 12, -12)};
  const Sorted sorted({over, rectangle(-1, 1, -1, 1, -8), rectangle(-1, 1, -1, 1, -3)});
  EXPECT_EQ(sorted.pieces(), (Pieces{1, 0, 2}));
  EXPECT_EQ(sorted.order.counters.swaps, 1u);
  sorted.expect_truth(false);
}
TEST(Newell_pairs, are_beside_each_other) {
  const Sorted across({ramp(-3, -1), ramp(1, 3)});
  EXPECT_EQ(across.passed(), (Passed{0, 1, 0, 0, 0}));
  Points high = ramp(-1, 1), low = ramp(-1, 1);
  for (Exact_point& p : high) p[1] += 3;
  for (Exact_point& p : low) p[1] -= 3;
  EXPECT_EQ(Sorted({high, low}).passed(), (Passed{0, 1, 0, 0, 0}));
  EXPECT_EQ(Sorted({low, high}).passed(), (Passed{0, 1, 0, 0, 0}));
}
TEST(Newell_pairs, are_ordered_by_the_plane_of_the_nearer_one) {
  const Sorted sorted({rectangle(-3, 3, -3, 3, -5), ramp(-1, 1)});
  EXPECT_EQ(sorted.pieces(), (Pieces{1, 0}));
  EXPECT_EQ(sorted.passed(), (Passed{0, 0, 1, 0, 0}));
}
TEST(Newell_pairs, are_ordered_by_the_plane_of_the_farther_one) {
  const Sorted sorted({rectangle(-8, 8, -8, 8, -9), ramp(-1, 1)});
  EXPECT_EQ(sorted.pieces(), (Pieces{0, 1}));
  EXPECT_EQ(sorted.passed(), (Passed{0, 0, 0, 1, 0}));
  sorted.expect_truth(false);
}
TEST(Newell_pairs, are_apart_as_seen) {
  const Points under{at(-24, -24, -30), at(16, -16, -20), at(-40, 40, -50)},
      over{at(24, 24, -30), at(40, -25, -50), at(-10, 16, -20)};
  EXPECT_EQ(Sorted({under, over}).passed(), (Passed{0, 0, 0, 0, 1}));
  EXPECT_EQ(Sorted({over, under}).passed(), (Passed{0, 0, 0, 0, 1}));
}

// ---- Swaps and cuts

TEST(Newell_swaps, what_reaches_farther_and_hides_is_painted_last) {
  const Points over{at(-12, -4, -4), at(12, -4, -4), at(12, 12, -12), at(-12, 12, -12)};
  const Sorted sorted({over, rectangle(-1, 1, -1, 1, -8)});
  EXPECT_EQ(sorted.pieces(), (Pieces{1, 0}));
  EXPECT_EQ(sorted.order.counters.swaps, 1u);
  EXPECT_EQ(sorted.order.counters.splits, 0u);
  sorted.expect_truth(false);
}

TEST(Newell_swaps, what_is_in_front_of_the_plane_of_the_other_is_painted_last) {
  // A ramp above the ground, whose plane cuts that, and which reaches farther.
  const Points over{at(-1, Rational(-19, 10), -6), at(1, Rational(-19, 10), -6), at(1, 3, -12), at(-1, 3, -12)},
      ground{at(-3, -2, -4), at(3, -2, -4), at(3, -2, -10), at(-3, -2, -10)};
  const Sorted sorted({over, ground});
  EXPECT_EQ(sorted.pieces(), (Pieces{1, 0}));
  EXPECT_EQ(sorted.order.counters.swaps, 1u);
  EXPECT_EQ(sorted.order.counters.splits, 0u);
  sorted.expect_truth(false);
}

TEST(Newell_cuts, faces_that_pierce_each_other) {
  const Sorted sorted({rectangle(-3, 3, -3, 3, -7), ramp(-1, 1)});
  EXPECT_EQ(sorted.order.counters.swaps, 0u);
  EXPECT_EQ(sorted.order.counters.splits, 1u);
  EXPECT_EQ(sorted.order.counters.through_eye, 0u);
  EXPECT_EQ(sorted.pieces(), (Pieces{1, 0, 1}));
  sorted.expect_truth(false);
}

/// From a to b and a fifth beyond either, from depth 9 to 11, leaning to one side.
Points bar(long ax, long ay, long bx, long by, const Rational& lean) {
  const Rational dx(bx - ax), dy(by - ay), x = dy / 10, y = -dx / 10;
  const auto place = [&](const Rational& t, int side) {
    return at(ax + t * dx + side * x, ay + t * dy + side * y,
              -10 - Rational(10, 7) * (t - Rational(1, 2)) + side * lean);
  };
  return {place(Rational(-1, 5), 1), place(Rational(6, 5), 1), place(Rational(6, 5), -1), place(Rational(-1, 5), -1)};
}

TEST(Newell_cuts, three_faces_each_over_the_next) {
  // They lean so that one plane of two separates them.
  for (const int lean : {-1, 1})
    for (std::size_t first = 0; first < 3; ++first) {
      const Rational by(3 * lean, 10);
      const std::vector<Points> bars{bar(-4, -3, 4, -3, by), bar(4, -3, 0, 4, by), bar(0, 4, -4, -3, by)};
      const Sorted sorted({bars[first], bars[(first + 1) % 3], bars[(first + 2) % 3]});
      EXPECT_GT(sorted.order.counters.swaps, 0u);
      EXPECT_EQ(sorted.order.counters.splits, 1u);
      EXPECT_EQ(sorted.order.polygons.size(), 4u);
      sorted.expect_truth(false);
      const Sorted two({bars[first], bars[(first + 1) % 3]});
      EXPECT_EQ(two.order.counters.splits, 0u);
      two.expect_truth(false);
    }
}

TEST(Newell_cuts, through_the_eye_where_no_plane_of_a_face_cuts) {
  std::uint64_t through_eye = 0;
  image_test::for_each_view(Family::cyclic, 60, [&](const Scene& scene, const Pixel_view& view, const std::string&) {
    const Newell_order order = newell_order(scene, view, Image_kernel::exact);
    EXPECT_LE(order.counters.through_eye, order.counters.splits);
    through_eye += order.counters.through_eye;
  });
  EXPECT_GT(through_eye, 5u);
}

TEST(Newell_cuts, too_many_are_given_up_in_rounded_numbers) {
  const Polygon_soup soup = generate::lattice(20);
  const Pixel_view view{at(-7, -5, -3), {1, 1, 1}, {1, -1, 0}, {-1, -1, 2}, 8, 8};
  const Scene scene(soup);
  const Newell_order order = newell_order(scene, view, Image_kernel::double_numbers);
  EXPECT_EQ(order.counters.splits, 64 * scene.pieces().size() + 4096);
  EXPECT_GT(order.counters.unordered, 0u);
}

// ---- Degenerate places

TEST(Newell_degenerate, of_one_plane_the_one_that_rays_choose_is_painted_last) {
  const Points large = rectangle(-3, 3, -3, 3, -7), small = rectangle(-1, 2, -1, 2, -7);
  for (const std::vector<Points>& faces : std::vector<std::vector<Points>>{{large, small},
                                                                           {small, large},
                                                                           {reversed(large), small},
                                                                           {large, reversed(small)},
                                                                           {reversed(small), large, small}}) {
    const Sorted sorted(faces);
    EXPECT_EQ(sorted.order.counters.splits, 0u);
    sorted.expect_truth(true);
  }
}

TEST(Newell_degenerate, in_the_plane_of_the_eye_or_outside_the_image_nothing_is_painted) {
  const Points edge_on{at(-1, 0, -5), at(1, 0, -5), at(1, 0, -9)};
  for (const Image_kernel kernel : {Image_kernel::exact, Image_kernel::double_numbers, Image_kernel::float_numbers}) {
    const Sorted sorted({edge_on, rectangle(-1, 1, -1, 1, 4), rectangle(8, 9, -1, 1, -7), rectangle(-1, 1, -9, -7, -7),
                         rectangle(-1, 1, -1, 1, -4)},
                        kernel);
    EXPECT_EQ(sorted.order.edge_on, 1u);
    EXPECT_EQ(sorted.pieces(), Pieces{4});
  }
}

TEST(Newell_degenerate, what_reaches_behind_the_eye_is_compared_by_planes) {
  // A floor under the eye from far behind it to far before it, a wall on it, and a roof through the wall.
  const Points floor{at(-20, -2, 20), at(20, -2, 20), at(20, -2, -20), at(-20, -2, -20)},
      wall{at(-3, -2, -8), at(3, -2, -8), at(3, 4, -8), at(-3, 4, -8)},
      roof{at(-9, 3, -12), at(9, 3, -12), at(9, 1, 12), at(-9, 1, 12)};
  const Sorted sorted({floor, wall, roof});
  EXPECT_EQ(sorted.order.counters.splits, 1u);
  sorted.expect_truth(false);
}

// ---- Kernels

TEST(Newell_kernels, are_one_on_dyadic_scenes) { image_test::expect_kernels_agree(newell); }
TEST(Newell_kernels, leave_out_what_is_not_finite) { image_test::expect_without_infinite(newell); }

TEST(Newell_kernels, in_floats_tell_no_depths_apart_that_floats_do_not) {
  // Two squares 2^-30 apart, the nearer one first and last: in floats one of the two orders is wrong.
  std::array<std::size_t, 3> wrong{};
  for (const bool nearer_first : {false, true}) {
    const Rational hair(1, 1 << 30);
    Polygon_soup soup;
    for (const bool nearer : {nearer_first, !nearer_first}) {
      std::vector<Point_id> loop;
      for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        loop.push_back(soup.add_point(x, y, nearer ? Rational(-4) : Rational(-4 - hair)));
      soup.add_face(loop);
    }
    const Scene scene(soup);
    const Pixel_view pixels{{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 8, 8};
    for (const Image_kernel kernel : {Image_kernel::exact, Image_kernel::double_numbers, Image_kernel::float_numbers})
      for (const std::uint32_t piece : newell(scene, pixels, kernel).pieces)
        wrong[static_cast<std::size_t>(kernel)] += piece == (nearer_first ? 1u : 0u);
  }
  EXPECT_EQ(wrong[static_cast<std::size_t>(Image_kernel::exact)], 0u);
  EXPECT_EQ(wrong[static_cast<std::size_t>(Image_kernel::double_numbers)], 0u);
  EXPECT_GT(wrong[static_cast<std::size_t>(Image_kernel::float_numbers)], 0u);
}

TEST(Newell_kernels, leave_out_faces_whose_edges_are_too_long_to_square) {
  for (const auto& [kernel, exponent] :
       {std::pair(Image_kernel::float_numbers, 36), std::pair(Image_kernel::double_numbers, 283)}) {
    const Rational size = generate::power_of_two(exponent), half = size / 2;
    const Sorted sorted({rectangle(-1, 1, -1, 1, -4), rectangle(-size, size, -half, half, -size)}, kernel);
    EXPECT_EQ(sorted.order.edge_on, 1u);
    EXPECT_EQ(sorted.pieces(), Pieces{0});
  }
}

}  // namespace
