// What rays through pixel centres meet first, against rationals and every piece.

#include "../point_visibility/oracle.h"
#include "../point_visibility/scenes.h"
#include "../sample.h"

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/pixel_cones.h>

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/pixel_views.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/kernel/vectors.h>

#include <gtest/gtest.h>

#include <tuple>

namespace {

using namespace sightline;
using generate::any_pixel_view;
using generate::Random;
using view_scenes::Family;

/// What a ray meets first by the rule, and whether there was a choice.
struct Hit {
  std::uint32_t piece = Piece_image::nothing;
  bool tied = false;
};

Hit brute_hit(const oracle::Flats& flats, const Exact_point& eye, const Exact_point& direction) {
  std::optional<Rational> nearest;
  std::vector<std::pair<std::uint32_t, int>> met;  // all at that distance; where in them
  for (std::uint32_t i = 0; i < flats.size(); ++i) {
    const std::optional<Rational> t = oracle::crossing(flats[i], eye, direction);
    if (!t || (nearest && *t > *nearest)) continue;
    const int inside = flats[i].holds(oracle::along(eye, *t, direction));
    if (inside < 0) continue;
    if (nearest && *t < *nearest) met.clear();
    nearest = t;
    met.emplace_back(i, inside);
  }
  if (met.empty()) return {};
  const auto key = [&](const std::pair<std::uint32_t, int>& m) {
    const oracle::Flat& flat = flats[m.first];
    return std::tuple(sgn(flat.height(eye)) < 0, flat.face, flat.number);
  };
  const auto best = std::min_element(met.begin(), met.end(), [&](auto& a, auto& b) { return key(a) < key(b); });
  return {best->first, met.size() > 1 || best->second == 0};
}

class Centres : public testing::TestWithParam<Family> {};

TEST_P(Centres, are_those_of_brute_force) {
  std::size_t shown = 0, tied = 0, exact = 0;
  for (std::uint64_t seed = 0; seed < 1 + test_scenes::sample(9u); ++seed)
    for (const view_scenes::Case& made : view_scenes::make(GetParam(), seed)) {
      const Scene scene(made.soup);
      const oracle::Flats flats = oracle::flats_of(scene);
      const Exact_view view(scene, made.eye);
      Random random(seed);
      for (int k = 0; k < 3; ++k) {
        const Pixel_view pixels = any_pixel_view(made.soup, made.eye, random);
        const Piece_image image = centres(view, pixels);
        ASSERT_EQ(image.pieces.size(), std::size_t{pixels.width} * pixels.height);
        exact += image.counters.exact_sides + image.counters.exact_depths;
        for (std::uint32_t y = 0; y < pixels.height; ++y)
          for (std::uint32_t x = 0; x < pixels.width; ++x) {
            const Hit hit = brute_hit(flats, made.eye, pixels.centre(x, y));
            ASSERT_EQ(image.pieces[image.pixel(x, y)], hit.piece)
                << made.name << ", view " << k << ": " << x << ' ' << y;
            ASSERT_EQ(image.tied[image.pixel(x, y)], hit.tied) << made.name << ", view " << k << ": " << x << ' ' << y;
            shown += hit.piece != Piece_image::nothing;
            tied += hit.tied;
          }
      }
    }
  EXPECT_GT(shown, test_scenes::least(300u));
  EXPECT_GT(tied, test_scenes::least(10u));
  EXPECT_GT(exact, test_scenes::least(10u));
}
INSTANTIATE_TEST_SUITE_P(All, Centres, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

TEST(Pixel_forms, of_products_beyond_doubles_leave_sides_to_integers) {
  // -2^1024 + 1.5 x 2^1023 + 1.5 x 2^1023 is 2^1023, and minus infinity in doubles.
  const double r = 0x1p900;
  const Pixel_view pixels{{0, 0, 0}, {0, 0, 1}, {r, r, r}, {1, 0, 0}, 6, 5};
  const std::array<double, 3> n{-0x1p124, 1.5 * 0x1p123, 1.5 * 0x1p123};
  const Exact_point exactly{exact(n[0]), exact(n[1]), exact(n[2])};
  const image_detail::Pixel_centres image(pixels);
  image_detail::Pixel_cones cones(image, [&](std::uint32_t, std::uint32_t) {
    return std::array<Integer, 3>{exactly[0].get_num(), exactly[1].get_num(), exactly[2].get_num()};
  });
  ASSERT_TRUE(cones.add({{0, 0, 1}}));
  cones.add_edge(image_detail::Pixel_form(image, {n, 0x1p126, 0}));
  Image_counters counters;
  for (std::uint32_t y = 0; y < pixels.height; ++y) {
    std::int64_t inside = 0;
    for (std::uint32_t x = 0; x < pixels.width; ++x) {
      const int side = sgn(dot(exactly, pixels.centre(x, y)));
      EXPECT_EQ(cones.side(0, 0, x, y, counters), side) << x << ' ' << y;
      inside += side >= 0;
    }
    const auto [first, last] = cones.columns(0, y, counters);
    EXPECT_EQ(last - first, inside) << y;
    EXPECT_EQ(inside, 3);
  }
}

TEST(Pixel_centres, of_axes_that_doubles_multiply_to_zero_lose_no_pixel) {
  // look and right nearly one way and so short that the product of their squares is 0, up so long that the volume of
  // all three is not: places in doubles were off by more than was allowed for.
  constexpr double l = 1e-82, t = 1e-91, u = 1e60;
  const Pixel_view pixels{{0, 0, 0}, {l, l, l}, {l + t, l - t, l}, {u, u, -2 * u}, 101, 1};
  const auto at = [&](const Rational& across, double upwards) {
    Exact_point p = exact(pixels.look);
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] += across * exact(pixels.right)[k] + exact(upwards) * exact(pixels.up)[k];
      p[k] *= generate::power_of_two(272);
    }
    return p;
  };
  for (const long last : {2l, 22l, 69l, 75l, 84l}) {
    const Rational from(-1), to(2 * last - 100, 101l);  // it ends at the centre of a pixel
    const Scene scene(generate::soup_of({{at(from, -1e-142), at(to, -1e-142), at(to, 1e-142), at(from, 1e-142)}}));
    const oracle::Flats flats = oracle::flats_of(scene);
    const Piece_image image = centres(Exact_view(scene, pixels.eye), pixels);
    for (std::uint32_t x = 0; x < pixels.width; ++x) {
      const Hit hit = brute_hit(flats, pixels.eye, pixels.centre(x, 0));
      EXPECT_EQ(image.pieces[x], hit.piece) << "to " << last << ", pixel " << x;
      EXPECT_EQ(hit.piece == Piece_image::nothing, x > last);
    }
  }
}

}  // namespace
