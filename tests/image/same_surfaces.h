#pragma once
// What is asked of each method that gives a visible surface: what visible_surface() shows, up to where it is cut.

#include "../point_visibility/support.h"
#include "../sample.h"

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/harness/generate/pixel_views.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

namespace surface_test {

using namespace sightline;
using Surface = Visible_surface<Exact_view>;
using Method = Surface(const Exact_view&, Cones<Exact_view>);

inline std::uint64_t seeds() {
  const char* text = std::getenv("SIGHTLINE_LONG");
  if (text != nullptr) return std::strtoull(text, nullptr, 10);
  return test_scenes::is_sanitized() ? 1 : 2;
}

/// The same faces, and the same points of each piece, with the same area.
inline void expect_same(const Exact_view& view, const Surface& surface, const Surface& truth) {
  ASSERT_EQ(surface.visible, truth.visible);
  ASSERT_EQ(surface.from_behind, truth.from_behind);
  const auto parts = see_test::polygons(view, surface), expected = see_test::polygons(view, truth);
  const oracle::Flats flats = oracle::flats_of(view.scene());
  ASSERT_NO_FATAL_FAILURE(see_test::expect_same_points(flats, parts, expected));
}

/// What a ray meets first, in directions of which some are at edges and corners.
inline std::size_t expect_directions(const Exact_view& view, const Surface& surface, generate::Random& random) {
  const oracle::Flats flats = oracle::flats_of(view.scene());
  std::size_t compared = 0;
  for (int k = 0; k < 40; ++k) {
    const Exact_point direction = k % 2 == 0 || flats.empty() ? oracle::random_direction(random)
                                                              : oracle::random_direction_at(flats, view.eye(), random);
    bool generic = true;
    const std::optional<std::uint32_t> hit = oracle::first_hit(flats, view.eye(), direction, &generic);
    const std::vector<std::uint32_t> shown = see_test::seen_in(view, surface, direction);
    EXPECT_FALSE(shown.empty());
    if (!generic) continue;
    ++compared;
    for (const std::uint32_t piece : shown) EXPECT_EQ(piece, hit.value_or(Surface::nothing));
  }
  return compared;
}

/// Every part is a leaf of one tree, and on the right side of each plane above it.
inline void expect_trees(const Exact_view& view, const Surface& surface) {
  ASSERT_EQ(surface.roots.size(), surface.cones.size());
  std::vector<int> reached(surface.parts.size());
  Predicate_counts counts;
  struct Step {
    std::int32_t child;
    std::vector<Exact_view::Plane> sides;
  };
  for (std::size_t root = 0; root < surface.roots.size(); ++root) {
    std::vector<Step> steps{{surface.roots[root], surface.cones[root].sides}};
    while (!steps.empty()) {
      const Step step = std::move(steps.back());
      steps.pop_back();
      ASSERT_NE(step.child, Surface::no_child);
      if (step.child >= 0) {
        const Surface::Node& node = surface.nodes[static_cast<std::size_t>(step.child)];
        Step front{node.front, step.sides}, behind{node.behind, step.sides};
        front.sides.push_back(node.plane);
        behind.sides.push_back(view.opposite(node.plane));
        steps.push_back(front);
        steps.push_back(behind);
        continue;
      }
      const Surface::Part& part = surface.parts[static_cast<std::size_t>(~step.child)];
      ++reached[static_cast<std::size_t>(~step.child)];
      ASSERT_GE(part.size, 3u);
      for (const Exact_view::Plane& side : step.sides)
        for (const Exact_view::Ray& ray : surface.of(part)) ASSERT_NE(view.side(side, ray, counts), CGAL::NEGATIVE);
    }
  }
  EXPECT_EQ(std::count(reached.begin(), reached.end(), 1), std::ssize(reached));
}

/// A verifier that knows nothing of the method agrees.
inline void expect_certified(const Polygon_soup& soup, const Exact_view& view, const Surface& surface) {
  const Verdict verdict = verify_visible(soup, visible_certificate(view, surface, view.eye()));
  EXPECT_TRUE(verdict.accepted) << verdict.why;
}

inline void expect_as_seen(const view_scenes::Case& given, Method method, std::size_t& compared) {
  SCOPED_TRACE(given.name);
  const Scene scene(given.soup);
  const Piece_boxes boxes(scene);
  generate::Random random(7);
  // 1. All around the eye.
  const Exact_view view(scene, given.eye);
  const Surface surface = method(view, whole_sphere(view));
  ASSERT_NO_FATAL_FAILURE(expect_same(view, surface, visible_surface(view, boxes, Visible_options{.threads = 1})));
  ASSERT_NO_FATAL_FAILURE(expect_trees(view, surface));
  expect_certified(given.soup, view, surface);
  compared += expect_directions(view, surface, random);
  // 2. In the field of an image.
  if (given.soup.point_count() == 0) return;
  const Pixel_view pixels = generate::any_pixel_view(given.soup, given.eye, random);
  const Exact_view framed(scene, given.eye, field_of(pixels));
  const Surface inside = method(framed, field_of_view(framed));
  ASSERT_NO_FATAL_FAILURE(expect_same(
      framed, inside, visible_surface(framed, boxes, field_of_view(framed), Visible_options{.threads = 1})));
  ASSERT_NO_FATAL_FAILURE(expect_trees(framed, inside));
  // 3. Painted.
  const Piece_image rays = centres(framed, pixels), painted = paint(framed, inside, pixels);
  for (std::size_t i = 0; i < rays.pieces.size(); ++i)
    EXPECT_TRUE(rays.tied[i] || painted.pieces[i] == rays.pieces[i]) << "pixel " << i;
}

/// All of a family.
inline void expect_as_seen(view_scenes::Family family, Method method) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= seeds() && !testing::Test::HasFatalFailure(); ++seed)
    for (const view_scenes::Case& given : view_scenes::make(family, seed)) expect_as_seen(given, method, compared);
  EXPECT_GT(compared, 20u);
}

}  // namespace surface_test
