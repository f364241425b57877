// Distances that cull boxes, where doubles end.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/harness/generate/polygons.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace sightline;
using generate::at;

Rational power(int exponent) {
  const Rational one(Integer(Integer(1) << std::abs(exponent)));
  return exponent < 0 ? Rational(1 / one) : one;
}

TEST(Box_distance, is_at_most_the_distance_from_an_eye_whose_square_is_no_double) {
  const Scene scene(generate::soup_of({generate::rectangle(0, 1, 0, 1, 0), generate::rectangle(0, 1, 0, 1, 1)}));
  const Piece_boxes boxes(scene);
  for (const int exponent : {10, 500, 600, 1000}) {
    const Located_point eye = scene.locate({0, 0, power(exponent)});
    const double found = Piece_boxes::distance(boxes.nodes()[0].box, eye);
    EXPECT_GE(found, 0);
    EXPECT_LE(found, eye.az * (1 + 1e-9)) << exponent;
    if (exponent < 600) {
      EXPECT_GT(found, eye.az * (1 - 1e-2)) << exponent;
    }
  }
}

TEST(Farthest_point_of_a_plane, is_no_nearer_along_a_ray_whose_square_is_no_double) {
  for (const int exponent : {-10, -500, -600, -1000}) {
    const Rational near = power(exponent);
    const Polygon_soup soup = generate::soup_of(
        {{at(-1, -1, 1), at(-1, 1, 1), at(1, 1, 1), at(1, -1, 1)}, {at(0, 0, near), at(near, 1, 0), at(0, 1, 0)}});
    const Scene scene(soup);
    const Exact_view view(scene, {0, 0, 0});
    const Located_point eye = scene.locate({0, 0, 0}), met = scene.locate({0, 0, 1});
    for (std::uint32_t p = 0; p < scene.points().size(); ++p) {
      const Exact_point point = scene.position(p);
      if (point[0] != 0 || point[1] != 0) continue;
      EXPECT_GE(view.farthest(0, view.ray(p)), met.az - eye.az) << exponent;
    }
  }
}

}  // namespace
