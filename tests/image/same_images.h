#pragma once
// What is asked of each method that decides at pixel centres: in exact numbers what rays meet, in rounded ones an
// image.

#include "../sample.h"
#include "../point_visibility/scenes.h"

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/harness/generate/pixel_views.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace image_test {

using sightline::Image_counters;
using sightline::Image_kernel;
using sightline::Image_options;
using sightline::Piece_image;
using sightline::Pixel_view;
using sightline::Rational;
using sightline::Scene;
using sightline::generate::Random;
namespace generate = sightline::generate;

using Method = Piece_image(const Scene&, const Pixel_view&, Image_kernel, const Image_options&);

/// So many seeds of a family: two at least, as in one there may be nothing to see.
inline std::uint64_t seeds_of(std::uint64_t all) { return std::max<std::uint64_t>(2, test_scenes::sample(all)); }

/// check(scene, pixels, label) for views of scenes of a family, every third of them in many rows.
template <class Check>
void for_each_view(view_scenes::Family family, std::uint64_t seeds, Check check, int views = 3) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    for (const view_scenes::Case& made : view_scenes::make(family, seed)) {
      const Scene scene(made.soup);
      Random random(seed);
      for (int k = 0; k < views; ++k) {
        Pixel_view pixels = generate::any_pixel_view(made.soup, made.eye, random);
        if (k == 2) {
          pixels.width = 65 + static_cast<std::uint32_t>(random.below(16));
          pixels.height = 33 + static_cast<std::uint32_t>(random.below(16));
        }
        check(scene, pixels, made.name + ", view " + std::to_string(k));
      }
    }
}

/// The first pixel in which two images differ, where `counts`; or none.
template <class Counts>
std::string difference(const Piece_image& image, const Piece_image& truth, Counts counts) {
  const auto text = [](std::uint32_t piece) {
    return piece == Piece_image::nothing ? std::string("nothing") : std::to_string(piece);
  };
  if (image.width != truth.width || image.height != truth.height || image.pieces.size() != truth.pieces.size())
    return "sizes";
  for (std::size_t i = 0; i < truth.pieces.size(); ++i)
    if (counts(i) && image.pieces[i] != truth.pieces[i])
      return std::to_string(i % truth.width) + ' ' + std::to_string(i / truth.width) + ": " + text(image.pieces[i]) +
             " for " + text(truth.pieces[i]);
  return "";
}
inline std::string difference(const Piece_image& image, const Piece_image& truth) {
  return difference(image, truth, [](std::size_t) { return true; });
}

/// Exact numbers: what rays meet first, by the rule where they are tied; on any number of threads.
inline Image_counters expect_exact_images(view_scenes::Family family, Method method) {
  Image_counters counters;
  std::size_t shown = 0, tied = 0;
  for_each_view(family, seeds_of(12), [&](const Scene& scene, const Pixel_view& pixels, const std::string& label) {
    const Piece_image truth = centres(sightline::Exact_view(scene, pixels.eye), pixels);
    const Piece_image image = method(scene, pixels, Image_kernel::exact, {.threads = 1});
    EXPECT_EQ(difference(image, truth), "") << label;
    EXPECT_EQ(image.counters.edge_on, truth.counters.edge_on) << label;
    EXPECT_EQ(image.counters.drawn, truth.counters.drawn) << label;
    const Piece_image again = method(scene, pixels, Image_kernel::exact, {.threads = 2});
    EXPECT_EQ(again.pieces, image.pieces) << label;
    Image_counters::each([&](const char* key, auto member) {
      EXPECT_EQ(again.counters.*member, image.counters.*member) << label << ": " << key;
    });
    counters += image.counters;
    for (std::size_t i = 0; i < truth.pieces.size(); ++i) shown += truth.pieces[i] != Piece_image::nothing;
    tied += static_cast<std::size_t>(std::count(truth.tied.begin(), truth.tied.end(), 1));
  });
  EXPECT_GT(shown, test_scenes::least(1000u));
  EXPECT_GT(tied, test_scenes::least(10u));
  EXPECT_GT(counters.exact_sides + counters.exact_depths, test_scenes::least(10u));
  return counters;
}

/// Floats and doubles: an image of pieces that there are, the same on any number of threads.
inline void expect_images(view_scenes::Family family, Method method) {
  for_each_view(family, seeds_of(6), [&](const Scene& scene, const Pixel_view& pixels, const std::string& label) {
    for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers}) {
      const Piece_image image = method(scene, pixels, kernel, {.threads = 1});
      EXPECT_EQ(image.width, pixels.width);
      EXPECT_EQ(image.height, pixels.height);
      EXPECT_EQ(image.pieces.size(), std::size_t{pixels.width} * pixels.height);
      EXPECT_EQ(image.counters.drawn + image.counters.edge_on, scene.pieces().size());
      EXPECT_TRUE(std::all_of(image.pieces.begin(), image.pieces.end(), [&](std::uint32_t piece) {
        return piece == Piece_image::nothing || piece < scene.pieces().size();
      })) << label;
      EXPECT_EQ(method(scene, pixels, kernel, {.threads = 2}).pieces, image.pieces) << label;
    }
  });
}

/// Where all that decides is a float, all kernels make one image, but for pixels that are tied.
inline void expect_kernels_agree(Method method) {
  std::size_t shown = 0;
  for (const view_scenes::Family family :
       {view_scenes::Family::uniform, view_scenes::Family::crossing, view_scenes::Family::boxes})
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const view_scenes::Case made = view_scenes::make(family, seed)[0];
      const Scene scene(made.soup);
      Pixel_view pixels{made.eye, {0, 1, 0}, {-1, 0, 0}, {0, 0, 2}, 32, 16};
      const bool is_dyadic = std::all_of(made.eye.begin(), made.eye.end(),
                                         [](const Rational& x) { return Rational(x * 16).get_den() == 1; });
      if (!is_dyadic) continue;
      const Piece_image truth = centres(sightline::Exact_view(scene, made.eye), pixels);
      for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers})
        EXPECT_EQ(difference(method(scene, pixels, kernel, {}), truth, [&](std::size_t i) { return !truth.tied[i]; }),
                  "")
            << made.name;
      for (const std::uint32_t piece : truth.pieces) shown += piece != Piece_image::nothing;
    }
  EXPECT_GT(shown, 1000u);
}

/// A small square before the eye, and a large one behind it whose products are beyond floats, or beyond doubles.
inline void expect_without_infinite(Method method) {
  using namespace view_scenes;
  for (const int exponent : {0, 100, 700}) {
    Rational size = 8;
    mpq_mul_2exp(size.get_mpq_t(), size.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    const Rational half = size / 2;
    const Scene scene(soup_of({rectangle(-1, 1, -1, 1, -4), rectangle(-size, size, -half, half, -size)}));
    const Pixel_view pixels{at(0, 0, 0), {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 16, 16};
    const Piece_image truth = centres(sightline::Exact_view(scene, pixels.eye), pixels);
    EXPECT_EQ(std::count(truth.pieces.begin(), truth.pieces.end(), 1u), 16 * 8 - 16);
    const auto image = [&](Image_kernel kernel) { return method(scene, pixels, kernel, {}); };
    const auto alone = [&](std::size_t i) { return truth.pieces[i] == 0; };
    EXPECT_EQ(difference(image(Image_kernel::exact), truth), "");
    for (const auto& [kernel, holds] : {std::pair(Image_kernel::float_numbers, exponent == 0),
                                        std::pair(Image_kernel::double_numbers, exponent <= 100)}) {
      const Piece_image made = image(kernel);
      EXPECT_EQ(made.counters.drawn, holds ? 2u : 1u);
      EXPECT_EQ(difference(made, truth, alone), "");
      EXPECT_EQ(std::count(made.pieces.begin(), made.pieces.end(), 1u), holds ? 16 * 8 - 16 : 0);
    }
  }
}

}  // namespace image_test
