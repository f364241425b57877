#pragma once
// What tests of visible surfaces share: the surface as polygons, and who is seen in a direction.

#include "oracle.h"
#include "scenes.h"

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible.h>

namespace sightline::see_test {

/// The parts of each piece, for all pieces.
template <View V>
std::vector<std::vector<std::vector<Exact_point>>> polygons(const V& view, const Visible_surface<V>& surface) {
  std::vector<std::vector<std::vector<Exact_point>>> of(view.scene().pieces().size());
  for (const auto& part : surface.parts)
    if (part.piece != surface.nothing) of[part.piece].push_back(vertices(view, surface, part));
  return of;
}

/// The parts whose closed cone holds a direction, as rationals say.
inline std::vector<std::uint32_t> seen_in(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                          const Exact_point& direction) {
  std::vector<std::uint32_t> found;
  for (const auto& part : surface.parts) {
    const auto rays = surface.of(part);
    bool inside = true;
    for (std::size_t k = 0; k < rays.size() && inside; ++k) {
      const auto a = view.direction(rays[k]), b = view.direction(rays[k + 1 == rays.size() ? 0 : k + 1]);
      Rational determinant = 0;
      for (std::size_t i = 0; i < 3; ++i)
        determinant += direction[i] * (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
      inside = determinant >= 0;
    }
    if (inside) found.push_back(part.piece);
  }
  return found;
}

}  // namespace sightline::see_test
