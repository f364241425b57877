// The example of algorithms/image/README.md, as it stands there.

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/painter.h>

#include <iostream>

/// How many pixels a painter who sorts by mean depth gets wrong.
void count_wrong(const sightline::Scene& scene, const sightline::Pixel_view& pixels, std::ostream& out) {
  using namespace sightline;
  const Exact_view view(scene, pixels.eye);
  const Piece_image truth = centres(view, pixels);
  const Piece_image painted = heedless_painter(scene, pixels, Painter_key::mean, Image_kernel::double_numbers);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < truth.pieces.size(); ++i) wrong += !truth.tied[i] && painted.pieces[i] != truth.pieces[i];
  out << wrong << " of " << truth.pieces.size() << " pixels are wrong\n";
}

#include "../point_visibility/scenes.h"

#include <gtest/gtest.h>

#include <sstream>

TEST(Example, a_painter_by_mean_depth_paints_the_ground_over_what_stands_on_it) {
  using namespace view_scenes;
  std::vector<Points> faces{{at(-50, -1, -1), at(50, -1, -1), at(50, 12, -1), at(-50, 12, -1)}};  // its mean is near
  faces.push_back({at(-1, 6, -1), at(1, 6, -1), at(1, 6, 1), at(-1, 6, 1)});
  const sightline::Scene scene(soup_of(faces));
  const sightline::Pixel_view pixels{at(0, -2, 0), {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 32, 32};
  std::ostringstream out;
  count_wrong(scene, pixels, out);
  EXPECT_EQ(out.str(), "4 of 1024 pixels are wrong\n");
}
