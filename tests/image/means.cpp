// Means over pixels against areas in rationals, cut from what brute force sees.

#include "../point_visibility/oracle.h"
#include "../point_visibility/scenes.h"

#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/point_visibility/visible.h>

#include <sightline/harness/generate/pixel_views.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;
using generate::any_pixel_view;
using generate::Random;
using view_scenes::Family;

Exact_point exactly(const std::array<double, 3>& v) { return {exact(v[0]), exact(v[1]), exact(v[2])}; }

Exact_point solved(const Pixel_view& pixels, const Exact_point& d) {
  const Exact_point look = exactly(pixels.look), right = exactly(pixels.right), up = exactly(pixels.up);
  const Rational volume = oracle::dot(look, oracle::cross(right, up));
  return {Rational(oracle::dot(d, oracle::cross(up, look)) / volume),
          Rational(oracle::dot(d, oracle::cross(look, right)) / volume),
          Rational(oracle::dot(d, oracle::cross(right, up)) / volume)};
}

/// The area of a polygon's part in a pixel, in pixels. In coordinates (across, upwards, along) each of the pixel's
/// sides is a plane through the eye.
Rational area_in(const oracle::Points& polygon, std::uint32_t x, std::uint32_t y, const Pixel_view& pixels) {
  const auto place = [](std::uint32_t k, std::uint32_t count) {
    Rational at(2 * static_cast<long>(k) - static_cast<long>(count), count);
    at.canonicalize();
    return at;
  };
  const Rational left = place(x, pixels.width), right = place(x + 1, pixels.width), top = -place(y, pixels.height),
                 bottom = -place(y + 1, pixels.height);
  oracle::Points part = polygon;
  for (const Exact_point& normal : {Exact_point{0, 0, 1}, Exact_point{1, 0, -left}, Exact_point{-1, 0, right},
                                    Exact_point{0, -1, top}, Exact_point{0, 1, -bottom}})
    if (!part.empty()) part = oracle::clipped(part, {normal, 0});
  Rational twice = 0;
  for (std::size_t k = 0; k < part.size(); ++k) {
    const Exact_point &p = part[k], &q = part[(k + 1) % part.size()];
    twice += (p[0] * q[1] - p[1] * q[0]) / (p[2] * q[2]);
  }
  return abs(twice) * pixels.width * pixels.height / 8;
}

class Means : public testing::TestWithParam<Family> {};

TEST_P(Means, are_those_of_areas_in_rationals) {
  std::size_t partly = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const view_scenes::Case made = view_scenes::make(GetParam(), seed)[0];
    const Scene scene(made.soup);
    const oracle::Flats flats = oracle::flats_of(scene);
    Random random(seed);
    Pixel_view pixels = any_pixel_view(made.soup, made.eye, random);
    pixels.width = 1 + pixels.width % 5;
    pixels.height = 1 + pixels.height % 5;
    const Exact_view view(scene, made.eye, field_of(pixels));
    const auto surface = visible_surface(view, Piece_boxes(scene), field_of_view(view));
    const auto colour = [](std::uint32_t piece) { return Colour{1, static_cast<double>(piece), 0}; };
    const Mean_image image = visible_means(view, surface, pixels, colour);

    std::vector<Colour> expected(image.colours.size());
    for (const oracle::Region& region : oracle::visible_parts(flats, made.eye))
      for (const oracle::Points& part : region.parts) {
        oracle::Points there;
        for (const Exact_point& p : part) there.push_back(solved(pixels, oracle::minus(p, made.eye)));
        for (std::uint32_t y = 0; y < pixels.height; ++y)
          for (std::uint32_t x = 0; x < pixels.width; ++x) {
            const Rational area = area_in(there, x, y, pixels);
            partly += area > 0 && area < 1;
            const Colour its = colour(region.piece);
            for (std::size_t k = 0; k < 3; ++k) expected[y * pixels.width + x][k] += area.get_d() * its[k];
          }
      }
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(image.colours[i][0], expected[i][0], 1e-8) << made.name << ", pixel " << i;
      EXPECT_NEAR(image.colours[i][1], expected[i][1], 1e-7) << made.name << ", pixel " << i;
      EXPECT_NEAR(image.covered[i], expected[i][0], 1e-8) << made.name << ", pixel " << i;
    }
  }
  EXPECT_GT(partly, 20u);
}
INSTANTIATE_TEST_SUITE_P(All, Means, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

}  // namespace
