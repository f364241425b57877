// What pixels' squares show, by definition: areas by hand, ties, glass, and what the library's means are.

#include "../image/stacks.h"
#include "../point_visibility/scenes.h"

#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/harness/compare/image_errors.h>
#include <sightline/harness/compare/pixel_squares.h>
#include <sightline/harness/generate/pixel_views.h>
#include <sightline/harness/generate/random.h>

#include <gtest/gtest.h>

namespace pixel_squares_test {

using namespace sightline;
using view_scenes::at;
using view_scenes::Case;
using view_scenes::Family;
using view_scenes::rectangle;
using view_scenes::soup_of;

namespace {

/// From the origin towards -z: at depth 1 the image is x, y from -1 to 1.
Pixel_view ahead(std::uint32_t width, std::uint32_t height) {
  return {{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, width, height};
}

TEST(Pixel_squares, are_covered_as_areas_by_hand_say) {
  // Two pixels; the left one has three quarters of a triangle's half, the right one a strip that ends in it.
  const Scene scene(soup_of({{at(-1, -1, -1), at(0, -1, -1), at(-1, 1, -1)}, rectangle(0, 2, 0, Rational(1, 2), -1)}));
  const Pixel_view pixels = ahead(2, 1);
  const Pixel_squares squares(scene, pixels);
  const std::vector<Tint> tints{{{200, 0, 0}, 1}, {{0, 100, 0}, 1}};
  const Layer left = squares.mean(0, 0, tints), right = squares.mean(1, 0, tints);
  EXPECT_EQ(left.alpha, 0.5);
  EXPECT_EQ(left.colour, (Colour{100, 0, 0}));
  EXPECT_EQ(right.alpha, 0.25);
  EXPECT_EQ(right.colour, (Colour{0, 25, 0}));
}

TEST(Pixel_squares, show_the_nearer_side_of_where_two_pieces_cross) {
  // One plane falls away to the right, the other to the left: they cross at x = 0, over all of the image.
  const Scene scene(soup_of({{at(-2, -4, -1), at(6, -4, -3), at(6, 4, -3), at(-2, 4, -1)},
                             {at(2, -4, -1), at(2, 4, -1), at(-6, 4, -3), at(-6, -4, -3)}}));
  const Pixel_view pixels = ahead(1, 1);
  const std::vector<Tint> tints{{{200, 0, 0}, 1}, {{0, 100, 0}, 1}};
  EXPECT_EQ(Pixel_squares(scene, pixels).mean(0, 0, tints).colour, (Colour{100, 50, 0}));
}

TEST(Pixel_squares, show_of_pieces_in_one_plane_the_front_and_the_lower_id) {
  const auto front = rectangle(-1, 1, -1, 1, -1);
  auto back = front;
  std::reverse(back.begin(), back.end());
  const Pixel_view pixels = ahead(1, 1);
  const std::vector<Tint> tints{{{200, 0, 0}, 1}, {{0, 100, 0}, 1}};
  const auto larger = rectangle(-1, 2, -1, 1, -1);
  const Scene fronts(soup_of({front, larger})), mixed(soup_of({back, larger}));
  EXPECT_EQ(Pixel_squares(fronts, pixels).mean(0, 0, tints).colour, (Colour{200, 0, 0}));
  EXPECT_EQ(Pixel_squares(mixed, pixels).mean(0, 0, tints).colour, (Colour{0, 100, 0}));
}

TEST(Pixel_squares, let_light_through_and_leave_out_what_is_edge_on_or_behind) {
  const Scene scene(soup_of({rectangle(-1, 0, -1, 1, -1),
                             rectangle(-9, 9, -9, 9, -2),
                             rectangle(-9, 9, -9, 9, 2),
                             {at(0, 0, 0), at(5, 0, 0), at(5, 0, -5)}}));
  const Pixel_view pixels = ahead(1, 1);
  const std::vector<Tint> tints{{{200, 0, 0}, 0.5}, {{0, 100, 0}, 0.25}, {{0, 0, 255}, 1}, {{0, 0, 255}, 1}};
  const Layer layer = Pixel_squares(scene, pixels).mean(0, 0, tints);
  EXPECT_DOUBLE_EQ(layer.colour[0], 50);           // half of the area, half of the light
  EXPECT_DOUBLE_EQ(layer.colour[1], 12.5 + 6.25);  // beside it, and through it
  EXPECT_EQ(layer.colour[2], 0);
  EXPECT_DOUBLE_EQ(layer.alpha, (0.25 + 0.625) / 2);
}

class Pixel_squares_of : public testing::TestWithParam<Family> {};

TEST_P(Pixel_squares_of, random_views_are_the_means_by_areas) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Case made = view_scenes::make(GetParam(), seed)[0];
    const Scene scene(made.soup);
    generate::Random random(seed);
    Pixel_view pixels = generate::any_pixel_view(made.soup, made.eye, random);
    pixels.width = 1 + pixels.width % 4;
    pixels.height = 1 + pixels.height % 4;
    std::vector<Tint> solid = image_test::any_tints(scene.pieces().size(), random), glass = solid;
    for (Tint& tint : solid) tint.alpha = 1;
    const Exact_view view(scene, made.eye, field_of(pixels));
    const auto surface = visible_surface(view, Piece_boxes(scene), field_of_view(view));
    const Mean_image means = visible_means(view, surface, pixels, [&](std::uint32_t p) { return solid[p].colour; });
    const Pixel_squares squares(scene, pixels);
    Mean_errors opaque, through;
    const bool is_small = scene.pieces().size() <= 12;
    const Mean_image layers = is_small ? blended_means(view, pixels, glass) : Mean_image();
    for (std::uint32_t y = 0; y < pixels.height; ++y)
      for (std::uint32_t x = 0; x < pixels.width; ++x) {
        const std::size_t i = std::size_t{y} * pixels.width + x;
        opaque.add(squares.mean(x, y, solid), {means.colours[i], means.covered[i]});
        if (is_small) through.add(squares.mean(x, y, glass), {layers.colours[i], layers.covered[i]});
      }
    EXPECT_EQ(opaque.compared, means.covered.size());
    EXPECT_LT(opaque.largest, 1e-4) << made.name;
    EXPECT_LT(through.largest, 1e-4) << made.name;
    // Faces with an area, which are those of the surface.
    const std::vector<double> areas = seen_areas(view, surface, pixels);
    double sum = 0, covered = 0;
    for (const double area : areas) sum += area;
    for (const double share : means.covered) covered += share;
    EXPECT_NEAR(sum, covered, 1e-6) << made.name;
  }
}
INSTANTIATE_TEST_SUITE_P(All, Pixel_squares_of, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

TEST(Mean_errors, count_what_is_off_by_more_than_half_a_step) {
  Mean_errors errors;
  errors.add({{10, 20, 30}, 1}, {{10, 20, 30}, 1});
  errors.add({{10, 20, 30}, 1}, {{10, 20.5, 30}, 1});
  errors.add({{10, 20, 30}, 1}, {{10, 20, 31}, 1});
  errors.add({{0, 0, 0}, 1}, {{0, 0, 0}, 0.5});
  EXPECT_EQ(errors.compared, 4u);
  EXPECT_EQ(errors.off, 2u);
  EXPECT_EQ(errors.largest, 127.5);
  EXPECT_EQ(errors.mean(), (0.5 + 1 + 127.5) / 4);
}

}  // namespace

}  // namespace pixel_squares_test
