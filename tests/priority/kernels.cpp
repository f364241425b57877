// Orders by the priority graph in floats and doubles: on coordinates and products that these hold, those of exact
// numbers; on others, an end.

#include "../sample.h"
#include "support.h"

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/priority/kernels.h>
#include <sightline/harness/generate/scenes.h>

using namespace priority_test;

namespace {

/// What is painted in the order of a graph in the numbers of these traits, each over those before it.
template <class Traits>
Piece_image painted_by_graph(const Traits& traits, const Pixel_view& pixels, Image_kernel kernel,
                             std::uint64_t& splits) {
  const Priority_tree<Traits> tree = build_priority_tree(traits, {true, false, {}});
  const Eye_order<Traits> order = back_to_front(traits, tree, pixels.eye);
  splits += order.counters.splits;
  std::vector<Painted_polygon> polygons;
  for (const Convex_polygon<Traits>& polygon : order.polygons) {
    Painted_polygon& painted = polygons.emplace_back(Painted_polygon{polygon.piece, {}});
    for (const Corner<Traits>& corner : polygon) painted.corners.push_back(traits.position(*corner.vertex));
  }
  return paint(polygons, pixels, kernel);
}

std::size_t count_wrong(const Piece_image& image, const Piece_image& truth) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < truth.pieces.size(); ++i) wrong += !truth.tied[i] && image.pieces[i] != truth.pieces[i];
  return wrong;
}

TEST(Priority_kernels, paint_what_rays_meet_where_numbers_hold_it) {
  std::uint64_t splits = 0, shown = 0;
  for (std::uint64_t seed = 1; seed <= (test_scenes::is_sanitized() ? 1 : 4); ++seed)
    for (const char* family : {"city", "lattice", "soup"}) {
      const Scene scene(generate::make(family, 12, seed));
      const auto box = scene.box();
      Pixel_view pixels{{}, {0, 1, 0}, {0.5, 0, 0}, {0, 0, 0.5}, 48, 48};
      for (std::size_t k = 0; k < 3; ++k) pixels.eye[k] = (box[0][k] + box[1][k]) / 2;
      pixels.eye[1] = Rational(static_cast<long>(std::floor(nearest_double(Rational(box[0][1] * 2 - box[1][1])))));
      const Piece_image truth = centres(Exact_view(scene, pixels.eye), pixels);
      for (std::size_t i = 0; i < truth.pieces.size(); ++i)
        shown += truth.pieces[i] != Piece_image::nothing && !truth.tied[i];
      std::uint64_t others = 0;
      EXPECT_EQ(count_wrong(painted_by_graph(Exact_traits(scene), pixels, Image_kernel::exact, splits), truth), 0u);
      EXPECT_EQ(
          count_wrong(painted_by_graph(Double_traits(scene), pixels, Image_kernel::double_numbers, others), truth), 0u)
          << family << ' ' << seed;
      // Floats are wrong where an edge goes by a centre; not by whole faces.
      EXPECT_LE(count_wrong(painted_by_graph(Float_traits(scene), pixels, Image_kernel::float_numbers, others), truth),
                3u)
          << family << ' ' << seed;
    }
  EXPECT_GT(shown, test_scenes::least(2000u));
  EXPECT_GT(splits, 0u);
}

}  // namespace
