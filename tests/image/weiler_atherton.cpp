// Windows cut along the edges of the nearest polygon, against the visible surface.

#include "same_images.h"
#include "same_surfaces.h"

#include <sightline/algorithms/image/weiler_atherton.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/image/number_painter.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/soups.h>

namespace {

using namespace sightline;
using view_scenes::Family;

Visible_surface<Exact_view> by_clip_polygons(const Exact_view& view, Cones<Exact_view> cones) {
  Visible_surface<Exact_view> alone = weiler_atherton(view, cones, {.threads = 1});
  const Visible_surface<Exact_view> several = weiler_atherton(view, std::move(cones), {.threads = 2});
  EXPECT_EQ(alone.parts.size(), several.parts.size());
  for (std::size_t i = 0; i < std::min(alone.parts.size(), several.parts.size()); ++i)
    EXPECT_EQ(alone.parts[i].piece, several.parts[i].piece);
  return alone;
}

class Weiler_atherton : public testing::TestWithParam<Family> {};

TEST_P(Weiler_atherton, is_what_is_seen) { surface_test::expect_as_seen(GetParam(), by_clip_polygons); }
INSTANTIATE_TEST_SUITE_P(All, Weiler_atherton, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

void expect_clipping_sees(const Polygon_soup& soup, const Exact_point& eye) {
  std::size_t compared = 0;
  surface_test::expect_as_seen({soup.file, soup, eye}, by_clip_polygons, compared);
}
TEST(Weiler_atherton_surfaces, of_larger_scenes) {
  expect_clipping_sees(generate::city(test_scenes::is_sanitized() ? 3 : 8, 2), {3, 4, 2});
  expect_clipping_sees(generate::slivers(test_scenes::is_sanitized() ? 15 : 40, 3), {-1, -2, 3});
  expect_clipping_sees(generate::soup(test_scenes::is_sanitized() ? 20 : 50, 0.5, 4),
                       {Rational(1, 2), Rational(1, 2), Rational(1, 3)});
}
TEST(Weiler_atherton_surfaces, are_the_cones_where_there_is_no_scene) {
  const Scene scene{Polygon_soup()};
  const Exact_view view(scene, {0, 0, 0});
  const Visible_surface<Exact_view> surface = weiler_atherton(view, whole_sphere(view));
  EXPECT_EQ(surface.parts.size(), 8u);
  EXPECT_TRUE(surface.nodes.empty() && surface.visible.empty());
}

/// The nearest polygon's edges cut first: four cuts around the small square, none along the large one's edges inside.
TEST(Weiler_atherton_surfaces, are_cut_along_the_nearest_polygon) {
  using namespace view_scenes;
  const Scene scene(soup_of({rectangle(1, 9, 1, 9, -9), rectangle(1, 2, 1, 2, -4)}));
  const Exact_view view(scene, at(0, 0, 0));
  const Visible_surface<Exact_view> surface = weiler_atherton(view, whole_sphere(view));
  std::size_t cuts = 0;
  for (const auto& node : surface.nodes) cuts += node.plane.name.is_edge();
  EXPECT_EQ(cuts, surface.nodes.size());
  const auto root = std::find_if(surface.roots.begin(), surface.roots.end(), [](std::int32_t r) { return r >= 0; });
  ASSERT_NE(root, surface.roots.end());
  const Eye_plane_name first = surface.nodes[static_cast<std::size_t>(*root)].plane.name;
  EXPECT_EQ(scene.position(first.a)[2], -4);
  EXPECT_EQ(scene.position(first.b)[2], -4);
  // A polygon that is nearer by its nearest corner, but behind: the one in front of it is the clip polygon inside.
  const Scene deep(
      soup_of({{at(-1, -8, -1), at(1, -8, -1), at(8, 8, -9), at(-8, 8, -9)}, rectangle(-1, 1, -1, 1, -4)}));
  const Exact_view other(deep, at(0, 0, 0));
  EXPECT_EQ(weiler_atherton(other, whole_sphere(other)).visible, (std::vector<Face_id>{0, 1}));
}

/// What windows show at centres, in the numbers of a kernel.
template <class V>
Piece_image windows_of(const V& view, const Pixel_view& pixels, const Image_options& options) {
  return paint(view, weiler_atherton(view, field_of_view(view), {.threads = options.threads}), pixels, options);
}
Piece_image clipped_image(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel,
                          const Image_options& options) {
  const auto field = field_of(pixels);
  switch (kernel) {
    case Image_kernel::float_numbers: return windows_of(Number_view<float>(scene, pixels.eye, field), pixels, options);
    case Image_kernel::double_numbers:
      return windows_of(Number_view<double>(scene, pixels.eye, field), pixels, options);
    case Image_kernel::exact: break;
  }
  return windows_of(Exact_view(scene, pixels.eye, field), pixels, options);
}
std::size_t count_wrong(const Piece_image& image, const Piece_image& truth) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < truth.pieces.size(); ++i) wrong += !truth.tied[i] && image.pieces[i] != truth.pieces[i];
  return wrong;
}

class Weiler_atherton_rounded : public testing::TestWithParam<Family> {};

TEST_P(Weiler_atherton_rounded, is_an_image_of_pieces_in_floats_and_doubles) {
  image_test::for_each_view(GetParam(), 6, [&](const Scene& scene, const Pixel_view& pixels, const std::string& label) {
    for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers}) {
      const Piece_image image = clipped_image(scene, pixels, kernel, {.threads = 1});
      EXPECT_EQ(image.pieces.size(), std::size_t{pixels.width} * pixels.height) << label;
      for (const std::uint32_t piece : image.pieces)
        EXPECT_TRUE(piece == Piece_image::nothing || piece < scene.pieces().size()) << label;
      EXPECT_EQ(clipped_image(scene, pixels, kernel, {.threads = 2}).pieces, image.pieces) << label;
    }
  });
}
INSTANTIATE_TEST_SUITE_P(All, Weiler_atherton_rounded, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

TEST(Weiler_atherton_rounded_on, boxes_is_what_rays_meet_and_on_a_sphere_is_not) {
  const auto none_tied = [](const Piece_image& truth) { return [&](std::size_t i) { return !truth.tied[i]; }; };
  std::size_t shown = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const view_scenes::Case made = view_scenes::make(Family::boxes, seed)[0];
    const Scene scene(made.soup);
    const Pixel_view pixels{made.eye, {0, 1, 0}, {-1, 0, 0}, {0, 0, 2}, 32, 16};
    const Piece_image truth = centres(Exact_view(scene, made.eye), pixels);
    for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers})
      EXPECT_EQ(image_test::difference(clipped_image(scene, pixels, kernel, {}), truth, none_tied(truth)), "")
          << made.name;
    for (const std::uint32_t piece : truth.pieces) shown += piece != Piece_image::nothing;
  }
  EXPECT_GT(shown, 500u);
  // Many edges meet in each corner: windows there are as narrow as rounding, and get lost.
  const Scene sphere(generate::convex_sphere(2000));
  const Pixel_view pixels{{Rational(1, 3), -4, Rational(1, 5)}, {0, 1, 0}, {0.3, 0, 0}, {0, 0, 0.3}, 128, 128};
  const Piece_image truth = centres(Exact_view(sphere, pixels.eye), pixels);
  EXPECT_EQ(count_wrong(clipped_image(sphere, pixels, Image_kernel::exact, {}), truth), 0u);
  EXPECT_GT(count_wrong(clipped_image(sphere, pixels, Image_kernel::float_numbers, {}), truth), 0u);
  EXPECT_GT(count_wrong(clipped_image(sphere, pixels, Image_kernel::double_numbers, {}), truth), 0u);
}

/// Of the fragments in the town some have corners that rounding moved past each other: all but these are there.
TEST(Weiler_atherton_rounded_on, a_town_is_nearly_what_rays_meet_in_doubles) {
  const Scene town(generate::city(800, 1));
  const Pixel_view pixels{{Rational(-57, 10), Rational(-146, 5), Rational(74187, 1024)},
                          {0.44, 0.58, -0.68},
                          {0.3, -0.23, 0},
                          {0.15, 0.2, 0.28},
                          192,
                          192};
  const Piece_image truth = centres(Exact_view(town, pixels.eye), pixels);
  const std::size_t wrong = count_wrong(clipped_image(town, pixels, Image_kernel::double_numbers, {}), truth);
  EXPECT_LT(wrong, 8u) << wrong;
  EXPECT_GT(std::count_if(truth.pieces.begin(), truth.pieces.end(),
                          [](std::uint32_t p) { return p != Piece_image::nothing; }),
            6000);
}

TEST(Weiler_atherton_rounded_on, leaves_the_field_as_it_is_where_nothing_is_seen) {
  const Scene scene{Polygon_soup()};
  const Pixel_view pixels{{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 4, 4};
  const Number_view<double> view(scene, pixels.eye, field_of(pixels));
  const auto cones = field_of_view(view);
  ASSERT_EQ(cones.size(), 1u);
  std::set<std::pair<double, double>> corners;  // of the image
  for (const auto& ray : cones[0].rays) {
    const Approximate_vector v = view.approximate(ray);
    EXPECT_LT(v.z, 0);
    corners.emplace(-v.x / v.z, -v.y / v.z);
  }
  EXPECT_EQ(corners, (std::set<std::pair<double, double>>{{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}));
}

}  // namespace
