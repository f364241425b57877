// Windows cut along the edges of the nearest polygon, against the visible surface.

#include "same_surfaces.h"

#include <sightline/algorithms/image/weiler_atherton.h>
#include <sightline/harness/generate/buildings.h>
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
  expect_clipping_sees(generate::city(test_scenes::is_sanitized() ? 3 : 12, 2), {3, 4, 2});
  expect_clipping_sees(generate::slivers(test_scenes::is_sanitized() ? 15 : 60, 3), {-1, -2, 3});
  expect_clipping_sees(generate::soup(test_scenes::is_sanitized() ? 20 : 80, 0.5, 4),
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
  Predicate_counts counts;
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

}  // namespace
