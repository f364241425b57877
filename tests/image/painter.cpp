// Painters against what they are told to do, polygon by polygon in rationals; and the tree's order against the truth.

#include "../point_visibility/oracle.h"
#include "../point_visibility/scenes.h"
#include "../sample.h"

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/harness/generate/pixel_views.h>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace sightline;
using generate::any_pixel_view;
using generate::Random;
using view_scenes::Family;

/// The last in the order that holds the ray.
std::uint32_t last_of(const std::vector<std::uint32_t>& order, const oracle::Flats& flats, const Exact_point& eye,
                      const Exact_point& direction) {
  std::uint32_t shown = Piece_image::nothing;
  for (const std::uint32_t i : order)
    if (const auto t = oracle::crossing(flats[i], eye, direction))
      if (flats[i].holds(oracle::along(eye, *t, direction)) >= 0) shown = i;
  return shown;
}

std::vector<std::uint32_t> by_key(const oracle::Flats& flats, const Pixel_view& pixels, Painter_key key) {
  const Exact_point look{exact(pixels.look[0]), exact(pixels.look[1]), exact(pixels.look[2])};
  std::vector<Rational> keys;
  for (const oracle::Flat& flat : flats) {
    std::vector<Rational> depths;
    Rational sum = 0;
    for (const Exact_point& p : flat.corners) {
      depths.push_back(oracle::dot(oracle::minus(p, pixels.eye), look));
      sum += depths.back();
    }
    const auto [least, most] = std::minmax_element(depths.begin(), depths.end());
    keys.push_back(key == Painter_key::nearest    ? *least
                   : key == Painter_key::farthest ? *most
                                                  : Rational(sum / static_cast<long>(depths.size())));
  }
  std::vector<std::uint32_t> order(flats.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return keys[a] > keys[b]; });
  return order;
}

class Painter : public testing::TestWithParam<Family> {};

TEST_P(Painter, paints_what_it_is_told_to) {
  std::size_t shown = 0;
  for (std::uint64_t seed = 0; seed < 1 + test_scenes::sample(6u); ++seed) {
    const view_scenes::Case made = view_scenes::make(GetParam(), seed)[0];
    const Scene scene(made.soup);
    const oracle::Flats flats = oracle::flats_of(scene);
    Random random(seed);
    const Pixel_view pixels = any_pixel_view(made.soup, made.eye, random);
    for (const Painter_key key : {Painter_key::nearest, Painter_key::farthest, Painter_key::mean}) {
      const std::vector<std::uint32_t> order = by_key(flats, pixels, key);
      Image_options serial;
      serial.threads = 1;
      const Piece_image image = heedless_painter(scene, pixels, key, Image_kernel::exact);
      EXPECT_EQ(heedless_painter(scene, pixels, key, Image_kernel::exact, serial).pieces, image.pieces);
      for (std::uint32_t y = 0; y < pixels.height; ++y)
        for (std::uint32_t x = 0; x < pixels.width; ++x) {
          const std::uint32_t expected = last_of(order, flats, made.eye, pixels.centre(x, y));
          ASSERT_EQ(image.pieces[image.pixel(x, y)], expected) << made.name << ": " << x << ' ' << y;
          shown += expected != Piece_image::nothing;
        }
      // Inexact numbers: as many pixels, whatever they show.
      for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers})
        EXPECT_EQ(heedless_painter(scene, pixels, key, kernel).pieces.size(), image.pieces.size());
    }
  }
  EXPECT_GT(shown, test_scenes::least(20u));
}
INSTANTIATE_TEST_SUITE_P(All, Painter, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

/// A square before another, both seen at centres well inside.
struct Easy {
  Scene scene{view_scenes::soup_of({view_scenes::rectangle(-3, 3, -3, 3, -8), view_scenes::rectangle(0, 2, 0, 2, -4)})};
  Pixel_view pixels{view_scenes::at(0, 0, 0), {0, 0, -1}, {0.5, 0, 0}, {0, 0.5, 0}, 10, 22};
};

TEST(Image_kernels, agree_where_numbers_are_easy) {
  const Easy easy;
  const Piece_image truth = centres(Exact_view(easy.scene, easy.pixels.eye), easy.pixels);
  EXPECT_EQ(std::count(truth.tied.begin(), truth.tied.end(), 1), 0);
  EXPECT_GT(std::count(truth.pieces.begin(), truth.pieces.end(), 1u), 20);
  for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers, Image_kernel::exact})
    EXPECT_EQ(heedless_painter(easy.scene, easy.pixels, Painter_key::mean, kernel).pieces, truth.pieces);
  for (const int bits : {16, 24, 32}) {
    Depth_buffer_options options;
    options.bits = bits;
    EXPECT_EQ(depth_image(easy.scene, easy.pixels, options).image.pieces, truth.pieces) << bits;
  }
}

TEST(Images, of_no_pixels_or_of_directions_that_span_nothing_are_refused) {
  const Easy easy;
  const Exact_view view(easy.scene, easy.pixels.eye);
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Pixel_view> wrong(5, easy.pixels);
  wrong[0].width = 0;
  wrong[1].height = (1u << 20) + 1;
  wrong[2].up = wrong[2].right;
  wrong[3].look = {0, 0, 0};
  wrong[4].look[0] = infinity;
  for (const Pixel_view& pixels : wrong) {
    EXPECT_THROW(centres(view, pixels), std::invalid_argument);
    EXPECT_THROW(paint({}, pixels, Image_kernel::exact), std::invalid_argument);
  }
  EXPECT_THROW(depth_image(easy.scene, wrong[0]), std::invalid_argument);
  EXPECT_THROW(depth_image(easy.scene, wrong[2]), std::invalid_argument);
  const Scene empty{Polygon_soup{}};
  const Piece_image image = centres(Exact_view(empty, easy.pixels.eye), easy.pixels);
  EXPECT_EQ(image.pieces, std::vector<std::uint32_t>(220, Piece_image::nothing));
}

}  // namespace
