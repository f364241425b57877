// On-view tests in plain numbers: right where these hold everything, and wrong where a viewpoint is in a rounded plane.

#include "support.h"

#include <sightline/harness/compare/cut_set_errors.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/transform.h>

using namespace compare_test;

namespace {

/// Nodes of which plain numbers say something else than an exact test, from each of these viewpoints.
template <class Number>
std::size_t wrong_nodes(const Scene& scene, const std::vector<Viewpoint>& views) {
  const Face_graph graph(scene);
  const Exact_traits traits(scene);
  const Rounded_planes<Number> rounded(graph);
  std::size_t wrong = 0;
  for (const Viewpoint& view : views) {
    const std::vector<bool> truth = on_view_nodes(traits, graph, view), said = rounded.on_view(view);
    for (std::size_t node = 0; node < graph.size(); ++node) wrong += truth[node] != said[node];
  }
  return wrong;
}

/// Every corner, from which its own faces are edge-on: on-view for nobody.
std::vector<Viewpoint> corners_of(const Scene& scene) {
  std::vector<Viewpoint> views;
  for (std::size_t p = 0; p < scene.points().size(); ++p)
    views.push_back({scene.position(static_cast<Point_id>(p)), false});
  return views;
}

TEST(Rounded_planes, of_small_whole_numbers_are_exact) {
  const Scene scene(generate::menger_sponge(1));
  std::vector<Viewpoint> views = corners_of(scene);
  for (const bool at_infinity : {false, true})
    for (const Exact_point& p : {at(1, 2, 9), at(-5, 0, 1), at(0, 0, 1), at(3, -4, 0)})
      views.push_back({p, at_infinity});
  EXPECT_EQ(wrong_nodes<double>(scene, views), 0u);
  EXPECT_EQ(wrong_nodes<float>(scene, views), 0u);
}

TEST(Rounded_planes, at_infinity_have_no_offset) {
  const Scene scene(generate::translated(generate::menger_sponge(1), at(100, 100, 100)));
  EXPECT_EQ(wrong_nodes<double>(scene, {{at(1, 2, 3), true}, {at(-1, -2, 3), true}, {at(0, 0, -1), true}}), 0u);
}

TEST(Rounded_planes, err_at_corners_that_are_rounded) {
  const Scene scene(generate::city(25, 4, true));
  EXPECT_GT(wrong_nodes<double>(scene, corners_of(scene)), 0u);
  EXPECT_GT(wrong_nodes<float>(scene, corners_of(scene)), 0u);
}

}  // namespace
