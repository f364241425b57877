// Near to far by one tree, what is covered in another, against the visible surface.

#include "../sample.h"
#include "same_surfaces.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/image/bsp2d.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/soups.h>
#include <sightline/harness/generate/transform.h>

namespace {

using namespace sightline;
using view_scenes::Family;

Visible_surface<Exact_view> by_two_trees(const Exact_view& view, Cones<Exact_view> cones) {
  const Exact_traits traits(view.scene());
  const Exact_tree tree = build_bsp(traits, Bsp_options{.threads = 1});
  Bsp2d skipping = bsp2d(view, tree, cones);
  const Bsp2d visiting = bsp2d(view, tree, std::move(cones), {.skip_hidden = false});
  EXPECT_EQ(skipping.surface.visible, visiting.surface.visible);
  EXPECT_EQ(skipping.surface.from_behind, visiting.surface.from_behind);
  EXPECT_EQ(skipping.seen, visiting.seen);
  // What is passed over is not visited, and what is visited is seen, hidden or edge-on.
  for (const Bsp2d* each : {&std::as_const(skipping), &visiting}) {
    const Bsp2d_counters& c = each->counters;
    EXPECT_EQ(c.nodes + c.nodes_skipped, tree.nodes.size());
    EXPECT_EQ(c.fragments + c.fragments_skipped, tree.fragments.size());
    EXPECT_EQ(c.fragments, c.hidden + c.edge_on + each->seen.size());
  }
  EXPECT_EQ(visiting.counters.nodes_skipped + visiting.counters.fragments_skipped + visiting.counters.faces_skipped,
            0u);
  return std::move(skipping.surface);
}

class Bsp2d_surface : public testing::TestWithParam<Family> {};

TEST_P(Bsp2d_surface, is_what_is_seen) { surface_test::expect_as_seen(GetParam(), by_two_trees); }
INSTANTIATE_TEST_SUITE_P(All, Bsp2d_surface, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

void expect_trees_see(const Polygon_soup& soup, const Exact_point& eye) {
  std::size_t compared = 0;
  surface_test::expect_as_seen({soup.file, soup, eye}, by_two_trees, compared);
}
/// A convex body, turned, whose tree cuts faces by axis planes; eyes inside, and in such a plane.
TEST(Bsp2d_surfaces, of_scenes_cut_by_planes_of_no_face) {
  const std::size_t faces = test_scenes::is_sanitized() ? 50 : 120;
  const Polygon_soup soup = generate::rotated(generate::convex_sphere(faces, 1), generate::rotation(3, 1, 1, 0));
  const Scene scene(soup);
  const Exact_tree tree = build_bsp(Exact_traits(scene));
  EXPECT_GT(tree.counters.free_planes, 0u);
  EXPECT_GT(tree.counters.splits, 0u);
  const auto [low, high] = scene.box();
  Exact_point inside, outside;
  for (std::size_t k = 0; k < 3; ++k) {
    inside[k] = (3 * low[k] + 4 * high[k]) / 7;
    outside[k] = 2 * high[k] - low[k] + k;
  }
  Exact_point at_corner = outside;  // an axis plane through a corner holds it
  at_corner[0] = scene.position(0)[0];
  for (const Exact_point& eye : {inside, outside, at_corner}) expect_trees_see(soup, eye);
}
TEST(Bsp2d_surfaces, of_larger_scenes) {
  expect_trees_see(generate::city(test_scenes::is_sanitized() ? 3 : 8, 2), {3, 4, 2});
  expect_trees_see(generate::slivers(test_scenes::is_sanitized() ? 15 : 40, 3), {-1, -2, 3});
  expect_trees_see(generate::soup(test_scenes::is_sanitized() ? 20 : 50, 0.5, 4),
                   {Rational(1, 2), Rational(1, 2), Rational(1, 3)});
}
TEST(Bsp2d_surfaces, are_the_cones_where_there_is_no_scene) {
  const Scene scene{Polygon_soup()};
  const Exact_view view(scene, {0, 0, 0});
  const Bsp2d result = bsp2d(view, whole_sphere(view));
  EXPECT_EQ(result.surface.parts.size(), 8u);
  EXPECT_TRUE(result.surface.nodes.empty() && result.surface.visible.empty());
}

/// A wall before many small squares.
TEST(Bsp2d_counters, say_what_was_passed_over) {
  using namespace view_scenes;
  std::vector<generate::Points> faces{rectangle(-8, 8, -8, 8, -1)};
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y)
      if (const int z = -2 - x - 9 * y; z < -1)
        faces.push_back(rectangle(x, x + Rational(1, 2), y, y + Rational(1, 2), z));
  const Scene scene(soup_of(faces));
  const Exact_view view(scene, at(0, 0, 0));
  const Bsp2d result = bsp2d(view, whole_sphere(view));
  EXPECT_EQ(result.surface.visible, std::vector<Face_id>{0});
  EXPECT_EQ(result.seen.size(), 1u);
  EXPECT_EQ(result.counters.hidden, result.counters.fragments - 1);  // on the way to the wall
  EXPECT_EQ(result.counters.faces_skipped, faces.size() - result.counters.fragments);
  EXPECT_GT(result.counters.faces_skipped, faces.size() * 3 / 4);
  EXPECT_EQ(result.counters.cells, 8u + 4 * 2 * 2);
}

/// Borders through pixel centres: the face is shown there, not what is beside it.
TEST(Painted_surfaces, show_a_face_on_its_border) {
  using namespace view_scenes;
  const Scene scene(soup_of({rectangle(-1, 1, -1, 1, -8)}));
  const Pixel_view pixels{at(0, 0, 0), {0, 0, -8}, {8, 0, 0}, {0, 8, 0}, 8, 8};
  const Exact_view view(scene, pixels.eye);
  const Piece_image truth = centres(view, pixels),
                    painted = paint(view, by_two_trees(view, whole_sphere(view)), pixels);
  EXPECT_EQ(std::count(truth.tied.begin(), truth.tied.end(), 1), 4);
  EXPECT_EQ(painted.pieces, truth.pieces);
}

TEST(Bsp2d_progress, may_give_up) {
  const Scene scene(generate::city(4, 1));
  const Exact_view view(scene, {3, 4, 2});
  std::size_t last = 0;
  bsp2d(view, whole_sphere(view), {.threads = 1, .progress = [&](std::size_t done, std::size_t all) {
                                     EXPECT_GT(done * all, 0u);
                                     last = done;
                                   }});
  EXPECT_GT(last, 10u);
  EXPECT_THROW(
      bsp2d(view, whole_sphere(view), {.progress = [](std::size_t, std::size_t) { throw std::runtime_error("over"); }}),
      std::runtime_error);
}

}  // namespace
