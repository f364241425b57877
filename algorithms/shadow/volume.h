#pragma once
// The space that a scene's faces keep a light from, as a solid.

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <functional>

namespace sightline {

struct Shadow_volume {
  Polygon_soup soup;               ///< closed, fronts outwards; faces with holes as set operations leave them
  std::array<Exact_point, 2> box;  ///< low and high
  std::size_t casting = 0;         ///< pieces that cast a shadow
  Set_counters counters;
};

/// The points of a box that a light does not reach: the segment to it, or the ray, goes through a face. The union of
/// each piece's own shadow, which is a frustum from the piece on, cut at the box, which is the scene's, larger by a
/// quarter of its longest side all around. Points on its boundary are in it or not.
/// Degenerate: faces in whose plane the light is cast none; both sides of others do; a scene without faces has an
/// empty one. `progress` is that of the set operation. Pre: a sun's direction is not 0. Cost: a set operation on n
/// frusta, all of which may meet: O(n log n + k log k), k up to n^2. Exact: yes. Proof: P-118
Shadow_volume shadow_volume(const Scene& scene, const Exact_point& light,
                            const std::function<void(std::size_t done, std::size_t all)>& progress = {});
Shadow_volume shadow_volume(const Scene& scene, const Sun& sun,
                            const std::function<void(std::size_t done, std::size_t all)>& progress = {});

}  // namespace sightline
