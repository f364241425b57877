// Means over pixels against areas in rationals, cut from what brute force sees.

#include "stacks.h"

#include "../point_visibility/scenes.h"
#include "../sample.h"

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

/// The planes through the eye in which what a ray meets may change, in coordinates (across, upwards, along): through
/// edges, and through lines where two pieces' planes cross.
std::vector<Exact_point> changes(const oracle::Flats& flats, const Pixel_view& pixels) {
  const Exact_point look = exactly(pixels.look), right = exactly(pixels.right), up = exactly(pixels.up);
  std::vector<Exact_point> normals;
  const auto add = [&](const Exact_point& n) {
    if (!oracle::is_zero(n)) normals.push_back({oracle::dot(n, right), oracle::dot(n, up), oracle::dot(n, look)});
  };
  for (std::size_t f = 0; f < flats.size(); ++f) {
    const oracle::Points& corners = flats[f].corners;
    const Rational height = flats[f].height(pixels.eye);
    if (sgn(height) == 0) continue;
    for (std::size_t k = 0; k < corners.size(); ++k)
      add(oracle::cross(oracle::minus(corners[k], pixels.eye),
                        oracle::minus(corners[(k + 1) % corners.size()], pixels.eye)));
    for (std::size_t g = 0; g < f; ++g)
      if (const Rational other = flats[g].height(pixels.eye); sgn(other) != 0)
        add(oracle::minus(oracle::along({0, 0, 0}, other, flats[f].plane.normal),
                          oracle::along({0, 0, 0}, height, flats[g].plane.normal)));
  }
  return normals;
}

/// The image cut wherever what a ray meets may change, each part with what the ray through its middle meets.
std::vector<std::pair<oracle::Points, Layer>> cut_everywhere(const oracle::Flats& flats, const Pixel_view& pixels,
                                                             const std::vector<Tint>& tints) {
  std::vector<oracle::Points> parts{{{-1, 1, 1}, {1, 1, 1}, {1, -1, 1}, {-1, -1, 1}}};
  for (const Exact_point& normal : changes(flats, pixels)) {
    std::vector<oracle::Points> halves;
    const oracle::Half_space plane{normal, 0};
    for (oracle::Points& part : parts) {
      if (oracle::is_beyond(part, opposite(plane)) || oracle::is_beyond(part, plane)) {  // whole, as most are
        halves.push_back(std::move(part));
        continue;
      }
      halves.push_back(oracle::clipped(part, plane));
      halves.push_back(oracle::clipped(part, opposite(plane)));
    }
    parts = std::move(halves);
  }
  std::vector<std::pair<oracle::Points, Layer>> all;
  for (oracle::Points& part : parts) {
    const Exact_point middle = oracle::centroid(part);
    Exact_point direction = exactly(pixels.look);
    direction = oracle::along(direction, middle[0], exactly(pixels.right));
    direction = oracle::along(direction, middle[1], exactly(pixels.up));
    all.emplace_back(std::move(part), image_test::brute_stack(flats, pixels.eye, direction, tints).layer);
  }
  return all;
}

class Blended_means : public testing::TestWithParam<Family> {};

TEST_P(Blended_means, are_those_of_all_regions_of_the_image_in_rationals) {
  std::size_t deep = 0;
  const auto is_enough = [&](std::uint64_t seed) {
    return seed >= test_scenes::sample(20u) && (seed >= 20 || deep > test_scenes::least(20u));
  };
  for (std::uint64_t seed = 0; !is_enough(seed); ++seed) {
    const view_scenes::Case made = view_scenes::make(GetParam(), seed)[0];
    const Scene scene(made.soup);
    const oracle::Flats flats = oracle::flats_of(scene);
    if (flats.size() > 12) continue;
    Random random(seed);
    Pixel_view pixels = any_pixel_view(made.soup, made.eye, random);
    pixels.width = 1 + pixels.width % 3;
    pixels.height = 1 + pixels.height % 3;
    const std::vector<Tint> tints = image_test::any_tints(flats.size(), random);
    const Exact_view view(scene, made.eye, field_of(pixels));
    const Mean_image image = blended_means(view, pixels, tints, {.threads = 2});

    std::vector<Layer> expected(image.colours.size());
    for (const auto& [part, layer] : cut_everywhere(flats, pixels, tints)) {
      deep += layer.alpha > 0 && layer.alpha < 1;
      for (std::uint32_t y = 0; y < pixels.height; ++y)
        for (std::uint32_t x = 0; x < pixels.width; ++x) {
          const double area = area_in(part, x, y, pixels).get_d();
          Layer& sum = expected[y * pixels.width + x];
          for (std::size_t k = 0; k < 3; ++k) sum.colour[k] += area * layer.colour[k];
          sum.alpha += area * layer.alpha;
        }
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_NEAR(image.colours[i][k], expected[i].colour[k], 1e-5) << made.name << ", pixel " << i;
      ASSERT_NEAR(image.covered[i], expected[i].alpha, 1e-7) << made.name << ", pixel " << i;
    }
    const Mean_image again = blended_means(view, pixels, tints, {.threads = 1});
    EXPECT_TRUE(again.colours == image.colours && again.covered == image.covered) << made.name;
  }
  EXPECT_GT(deep, test_scenes::least(20u));
}
INSTANTIATE_TEST_SUITE_P(All, Blended_means, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

TEST(Blended_means, of_what_hides_all_are_those_of_what_is_first) {
  using namespace view_scenes;
  const Scene scene(soup_of({rectangle(-9, 1, -9, 2, -2), rectangle(-9, 9, -3, 9, -4)}));
  const Pixel_view pixels{at(0, 0, 0), {0, 0, -1}, {0.5, 0, 0}, {0, 0.5, 0}, 3, 3};
  const Exact_view view(scene, pixels.eye, field_of(pixels));
  const auto surface = visible_surface(view, Piece_boxes(scene), field_of_view(view));
  const std::vector<Tint> tints{{{200, 0, 0}, 1}, {{0, 100, 0}, 1}};
  const Mean_image solid = blended_means(view, pixels, tints),
                   first = visible_means(view, surface, pixels, [&](std::uint32_t p) { return tints[p].colour; });
  EXPECT_EQ(solid.colours, first.colours);
  EXPECT_EQ(solid.covered, first.covered);
  EXPECT_THROW(blended_means(view, pixels, {tints[0]}), std::invalid_argument);
}

}  // namespace
