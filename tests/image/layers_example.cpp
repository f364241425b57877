// The second example of algorithms/image/README.md, as it stands there.

#include <sightline/algorithms/baseline/blended_depth.h>
#include <sightline/algorithms/image/scan_line.h>

#include <iostream>

/// How much of the light a depth buffer loses in a scene of grey glass.
void count_lost(const sightline::Scene& scene, const sightline::Pixel_view& pixels, std::ostream& out) {
  using namespace sightline;
  const std::vector<Tint> glass(scene.pieces().size(), Tint{{128, 128, 128}, 0.5});
  const Blended_image truth = blended_scan_line(scene, pixels, Image_kernel::exact, glass);
  const Blended_depth drawn = depth_blended(scene, pixels, glass);
  double right = 0, lost = 0;
  for (std::size_t i = 0; i < truth.layers.size(); ++i) {
    right += truth.layers[i].alpha;
    lost += truth.layers[i].alpha - drawn.layers[i].alpha;
  }
  out << 100 * lost / right << " % of the opacity is lost\n";
}

#include "../point_visibility/scenes.h"

#include <gtest/gtest.h>

#include <sstream>

TEST(Layers_example, a_depth_buffer_loses_the_farther_pane_where_it_is_drawn_later) {
  using namespace view_scenes;
  const sightline::Scene scene(soup_of({rectangle(-9, 9, -9, 9, -2), rectangle(-9, 9, -9, 9, -4)}));
  const sightline::Pixel_view pixels{at(0, 0, 0), {0, 0, -1}, {0.5, 0, 0}, {0, 0.5, 0}, 8, 8};
  std::ostringstream out;
  count_lost(scene, pixels, out);  // 1/2 for 3/4
  EXPECT_EQ(out.str(), "33.3333 % of the opacity is lost\n");
}
