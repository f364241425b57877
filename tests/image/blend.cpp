// Layers at pixel centres, against all that exact rays meet, in rationals; by spans, by the tree, and as hardware does.

#include "same_images.h"
#include "stacks.h"

#include "../sample.h"

#include <sightline/algorithms/baseline/blended_depth.h>
#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/algorithms/image/blend.h>
#include <sightline/algorithms/image/scan_line.h>
#include <sightline/harness/compare/image_errors.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace sightline;
using generate::Random;
using image_test::any_tints;
using image_test::brute_stack;
using image_test::Stack;
using view_scenes::Family;

bool same(const Layer& a, const Layer& b, double within) {
  double most = 255 * std::fabs(a.alpha - b.alpha);
  for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::fabs(a.colour[k] - b.colour[k]));
  return most <= within;
}

std::vector<Painted_polygon> by_tree(const Scene& scene, const Exact_point& eye) {
  const Exact_traits traits(scene);
  const auto tree = build_bsp(traits);
  std::vector<Painted_polygon> polygons;
  traverse(traits, tree, traits.eye(eye), Direction::back_to_front, [&](const auto& fragment, Sign) {
    Painted_polygon& painted = polygons.emplace_back(Painted_polygon{fragment.polygon.piece, {}});
    for (const Corner<Exact_traits>& corner : fragment.polygon)
      painted.corners.push_back(traits.position(*corner.vertex));
  });
  return polygons;
}

class Blend : public testing::TestWithParam<Family> {};

TEST_P(Blend, layers_are_what_rays_meet) {
  std::size_t deep = 0, tied = 0;
  image_test::for_each_view(
      GetParam(), std::max<std::uint64_t>(3, image_test::seeds_of(9)),  // two views may have no tie
      [&](const Scene& scene, const Pixel_view& pixels, const std::string& label) {
        const oracle::Flats flats = oracle::flats_of(scene);
        Random random(flats.size());
        const std::vector<Tint> tints = any_tints(flats.size(), random);
        const Exact_view view(scene, pixels.eye);
        const Blended_image image = blended_centres(view, pixels, tints, {.threads = 1});
        const Blended_image spans = blended_scan_line(scene, pixels, Image_kernel::exact, tints);
        const Blended_image painted = blended_painting(by_tree(scene, pixels.eye), pixels, Image_kernel::exact, tints);
        for (std::size_t i = 0; i < image.layers.size(); ++i) {
          const Exact_point d =
              pixels.centre(static_cast<std::uint32_t>(i % pixels.width), static_cast<std::uint32_t>(i / pixels.width));
          const Stack stack = brute_stack(flats, pixels.eye, d, tints);
          ASSERT_TRUE(same(image.layers[i], stack.layer, 0)) << label << ", pixel " << i;
          ASSERT_EQ(image.tied[i], stack.tied) << label << ", pixel " << i;
          ASSERT_TRUE(same(spans.layers[i], stack.layer, 0)) << label << ", pixel " << i;
          if (!stack.tied) {
            ASSERT_TRUE(same(painted.layers[i], stack.layer, 1e-9)) << label << ", pixel " << i;
          }
          deep += stack.layer.alpha > 0 && stack.layer.alpha < 1;
          tied += stack.tied;
        }
        EXPECT_EQ(colour_errors(image, spans).wrong, 0u);
        const Blended_image again = blended_centres(view, pixels, tints, {.threads = 2});
        EXPECT_TRUE(std::equal(again.layers.begin(), again.layers.end(), image.layers.begin(),
                               [](const Layer& a, const Layer& b) { return same(a, b, 0); }));
        // What hides all makes the image of what is first.
        const std::vector<Tint> opaque(flats.size(), Tint{{1, 2, 3}, 1});
        const Piece_image first = centres(view, pixels);
        const Blended_image solid = blended_centres(view, pixels, opaque);
        EXPECT_EQ(solid.tied, first.tied);
        for (std::size_t i = 0; i < first.pieces.size(); ++i)
          EXPECT_EQ(solid.layers[i].alpha, first.pieces[i] == Piece_image::nothing ? 0 : 1);
      },
      2);
  EXPECT_GT(deep, test_scenes::least(5u));
  EXPECT_GT(tied, test_scenes::least(5u));
}
INSTANTIATE_TEST_SUITE_P(All, Blend, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

/// Three squares behind one another, drawn in their order: far, near, middle.
struct Panes {
  Scene scene{view_scenes::soup_of({view_scenes::rectangle(-9, 9, -9, 9, -8), view_scenes::rectangle(-9, 9, -9, 9, -2),
                                    view_scenes::rectangle(-9, 9, -9, 9, -4)})};
  Pixel_view pixels{view_scenes::at(0, 0, 0), {0, 0, -1}, {0.5, 0, 0}, {0, 0.5, 0}, 4, 4};
  Tint red{{200, 0, 0}, 0.5}, green{{0, 100, 0}, 0.5}, blue{{0, 0, 40}, 0.5};
};

TEST(Blended_depth, loses_what_is_drawn_later_and_lies_behind) {
  const Panes panes;
  const Blended_depth made = depth_blended(panes.scene, panes.pixels, {panes.red, panes.green, panes.blue});
  ASSERT_EQ(made.layers.size(), 16u);
  for (const Layer& layer : made.layers) {
    EXPECT_EQ(layer.colour, (Colour{50, 50, 0}));  // green over red; blue fails the test of depths
    EXPECT_EQ(layer.alpha, 0.75);
  }
  const Blended_image right =
      blended_centres(Exact_view(panes.scene, panes.pixels.eye), panes.pixels, {panes.red, panes.green, panes.blue});
  for (const Layer& layer : right.layers) {
    EXPECT_EQ(layer.colour, (Colour{25, 50, 10}));
    EXPECT_EQ(layer.alpha, 0.875);
  }
  const Blended_image image{4, 4, made.layers, {}, {}};
  const Colour_errors errors = colour_errors(right, image);
  EXPECT_EQ(errors.wrong, 16u);
  EXPECT_EQ(errors.largest, 255 * 0.125);
  EXPECT_EQ(errors.mean, 255 * 0.125);
}

TEST(Weighted_blending, has_the_right_opacity_before_what_hides_all) {
  const Panes panes;
  Tint far = panes.red;
  far.alpha = 1;
  const Blended_depth made = weighted_blended(panes.scene, panes.pixels, {far, panes.green, panes.green});
  for (const Layer& layer : made.layers) {
    EXPECT_DOUBLE_EQ(layer.alpha, 1);
    EXPECT_NEAR(layer.colour[0], 50, 1e-9);  // two panes of one colour: no order could tell
    EXPECT_NEAR(layer.colour[1], 75, 1e-9);
  }
  const Blended_depth hidden = weighted_blended(panes.scene, panes.pixels, {panes.red, {{0, 0, 0}, 1}, panes.green});
  for (const Layer& layer : hidden.layers) EXPECT_EQ(layer.colour, (Colour{0, 0, 0}));
  // Of two colours the nearer weighs more.
  const Blended_depth two = weighted_blended(panes.scene, panes.pixels, {{{0, 0, 0}, 0}, panes.green, panes.blue});
  for (const Layer& layer : two.layers) EXPECT_GT(layer.colour[1] / 100, layer.colour[2] / 40);
}

/// Two panes, both cut by a plane through the eye and pixel centres: in an order that paints all on its one side before
/// all on its other side each counts once there, the nearer over the farther.
TEST(Blended_painting, counts_a_piece_once_on_a_cut_through_the_eye) {
  using view_scenes::at;
  const auto pane = [](std::uint32_t piece, int from, int to, int depth) {
    return Painted_polygon{piece, {at(from, -9, -depth), at(to, -9, -depth), at(to, 9, -depth), at(from, 9, -depth)}};
  };
  const Pixel_view pixels{at(0, 0, 0), {0, 0, -1}, {0.5, 0, 0}, {0, 0.5, 0}, 3, 3};
  const std::vector<Tint> tints{{{200, 0, 0}, 0.5}, {{0, 100, 0}, 0.5}};
  for (const bool left_first : {true, false}) {
    std::vector<Painted_polygon> halves{pane(0, -9, 0, 8), pane(1, -9, 0, 4), pane(0, 0, 9, 8), pane(1, 0, 9, 4)};
    if (!left_first) std::rotate(halves.begin(), halves.begin() + 2, halves.end());
    for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers, Image_kernel::exact})
      for (const Layer& layer : blended_painting(halves, pixels, kernel, tints).layers) {
        EXPECT_EQ(layer.colour, (Colour{50, 50, 0}));
        EXPECT_EQ(layer.alpha, 0.75);
      }
  }
}

TEST(Tints, that_are_missing_or_no_numbers_are_refused) {
  const Panes panes;
  const Exact_view view(panes.scene, panes.pixels.eye);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<Tint>& tints :
       {std::vector<Tint>(2), std::vector<Tint>(3, {{0, 0, 0}, 1.5}), std::vector<Tint>(3, {{0, 0, 0}, nan}),
        std::vector<Tint>(3, {{0, nan, 0}, 1}), std::vector<Tint>(3, {{0, 0, 0}, -1})}) {
    EXPECT_THROW(blended_centres(view, panes.pixels, tints), std::invalid_argument);
    EXPECT_THROW(blended_scan_line(panes.scene, panes.pixels, Image_kernel::exact, tints), std::invalid_argument);
    EXPECT_THROW(blended_painting({{2, {}}}, panes.pixels, Image_kernel::exact, tints), std::invalid_argument);
  }
  EXPECT_THROW(depth_blended(panes.scene, panes.pixels, {}), std::invalid_argument);
  EXPECT_THROW(weighted_blended(panes.scene, panes.pixels, {}), std::invalid_argument);
}

TEST(Blended_painting, gives_a_level_border_to_what_is_above_it) {
  using view_scenes::at;
  const auto pane = [](std::uint32_t piece, int low, int high) {
    return Painted_polygon{piece, {at(-9, low, -8), at(9, low, -8), at(9, high, -8), at(-9, high, -8)}};
  };
  const Pixel_view pixels{at(0, 0, 0), {0, 0, -1}, {0.5, 0, 0}, {0, 0.5, 0}, 3, 3};
  const std::vector<Tint> tints{{{200, 0, 0}, 0.5}, {{0, 100, 0}, 0.5}};
  for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers, Image_kernel::exact}) {
    const auto image = blended_painting({pane(0, -9, 0), pane(1, 0, 9)}, pixels, kernel, tints);
    for (std::size_t x = 0; x < 3; ++x) EXPECT_EQ(image.layers[3 + x].colour, (Colour{0, 50, 0}));
  }
}

}  // namespace
