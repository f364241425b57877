#pragma once
// Images of small degenerate scenes: across and along what is seen, through its corners, out of square.

#include "../point_visibility/scenes.h"

#include <sightline/kernel/scene/pixel_view.h>

#include <array>
#include <cstdint>

namespace image_test {

using sightline::Exact_point;
using sightline::Pixel_view;
using sightline::Rational;
using sightline::generate::Random;

inline std::array<double, 3> rounded(const Exact_point& v) { return {v[0].get_d(), v[1].get_d(), v[2].get_d()}; }

/// A view of the scene from the eye: with dyadic directions along the axes, so that centres meet lattice points; with
/// the middle of the image at a corner, one axis along an edge; or any. Spans the space.
inline Pixel_view any_view(const sightline::Polygon_soup& soup, const Exact_point& eye, Random& random) {
  const auto point = [&] { return soup.point(static_cast<sightline::Point_id>(random.below(soup.point_count()))); };
  const auto small = [&] { return static_cast<double>(random.between(-4, 4)); };
  for (;;) {
    Pixel_view view{eye, {}, {}, {}, 0, 0};
    view.width = 5 + static_cast<std::uint32_t>(random.below(12));
    view.height = 5 + static_cast<std::uint32_t>(random.below(12));
    const std::uint64_t kind = random.below(3);
    if (kind == 0) {
      const std::size_t axis = random.below(3);
      view.look[axis] = random.chance(1, 2) ? 1 : -1;
      view.right[(axis + 1) % 3] = random.chance(1, 2) ? 2 : -1;
      view.up[(axis + 2) % 3] = random.chance(1, 2) ? 0.5 : -2;
      view.width = 8;
      view.height = 16;
    } else if (kind == 1) {
      const Exact_point p = point(), q = point();
      view.look = rounded(sightline::minus(p, eye));
      view.right = rounded(sightline::minus(q, p));
      view.up = {small(), small(), small()};
      view.width |= 1;
      view.height |= 1;
    } else {
      for (std::size_t k = 0; k < 3; ++k) {
        view.look[k] = small() + 0.125;
        view.right[k] = small() / 3;
        view.up[k] = small();
      }
    }
    const auto exact = [](const std::array<double, 3>& v) {
      return Exact_point{Rational(v[0]), Rational(v[1]), Rational(v[2])};
    };
    if (sgn(sightline::dot(exact(view.look), sightline::cross(exact(view.right), exact(view.up)))) != 0) return view;
  }
}

}  // namespace image_test
