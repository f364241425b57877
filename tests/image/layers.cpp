// Layers by themselves: how many there are, and which light comes to each.

#include "../point_visibility/scenes.h"

#include <sightline/algorithms/image/layers.h>
#include <sightline/algorithms/image/means.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;

/// Of panes behind one another, each of its alpha, the light that comes to each layer in a field that all of them fill.
std::vector<double> light_of_panes(const std::vector<double>& alpha) {
  std::vector<view_scenes::Points> panes;
  for (std::size_t k = 0; k < alpha.size(); ++k)
    panes.push_back(view_scenes::rectangle(-9, 9, -9, 9, -2 - static_cast<long>(k)));
  const Scene scene(view_scenes::soup_of(panes));
  const Pixel_view pixels{view_scenes::at(0, 0, 0), {0, 0, -1}, {0.5, 0, 0}, {0, 0.5, 0}, 4, 4};
  const Exact_view view(scene, pixels.eye, field_of(pixels));
  std::vector<double> light;
  visible_layers(view, Piece_boxes(scene), field_of_view(view), alpha, [&](const Visible_layer& layer) {
    ASSERT_EQ(layer.light.size(), layer.surface.parts.size());
    ASSERT_EQ(layer.light.size(), 1u);
    light.push_back(layer.light[0]);
  });
  return light;
}

TEST(Layers, end_behind_what_hides_all) {
  EXPECT_EQ(light_of_panes({1, 0.5}), (std::vector<double>{1}));
  EXPECT_EQ(light_of_panes({0.5, 0.75, 1, 0.5}), (std::vector<double>{1, 0.5, 0.125}));
}

TEST(Layers, end_where_nothing_more_is_seen) {
  EXPECT_EQ(light_of_panes({}), (std::vector<double>{1}));
  EXPECT_EQ(light_of_panes({0, 0.5}), (std::vector<double>{1, 1, 0.5}));
}

}  // namespace
