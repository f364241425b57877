#pragma once
// The surfaces that are visible from a point, exactly: the sphere of directions is cut by planes through the eye and
// scene edges until one piece covers each region.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/algorithms/point_visibility/visible_solver.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sightline {

/// Convex cones of directions, to begin with.
template <View V>
using Cones = std::vector<typename Visible_surface<V>::Cone>;

/// The eight octants around the eye.
template <View V>
Cones<V> whole_sphere(const V& view) {
  Cones<V> octants;
  for (unsigned k = 0; k < 8; ++k) {
    auto& region = octants.emplace_back();
    const std::array<bool, 3> positive{(k & 1) == 0, (k & 2) == 0, (k & 4) == 0};
    // x, y, z run the right way round where all are positive; each negative axis turns that.
    const bool turned = (positive[0] != positive[1]) == positive[2];
    const std::array<std::uint32_t, 3> order =
        turned ? std::array<std::uint32_t, 3>{0, 2, 1} : std::array<std::uint32_t, 3>{0, 1, 2};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t across = order[(i + 2) % 3];
      region.rays.push_back(view.axis_ray(order[i], positive[order[i]]));
      region.sides.push_back(positive[across] ? view.axis(across) : view.opposite(view.axis(across)));
    }
  }
  return octants;
}

/// The field that the view was made with.
template <View V>
requires requires(const V& view) { view.field_sides(); }
Cones<V> field_of_view(const V& view) {
  Cones<V> cones(1);
  Predicate_counts counts;
  const auto n = static_cast<std::uint32_t>(view.field_sides());
  for (std::uint32_t k = 0; k < n; ++k) {  // ray k is where the side before it meets side k
    cones[0].rays.push_back(view.meet(view.field_side((k + n - 1) % n), view.field_side(k), counts));
    cones[0].sides.push_back(view.field_side(k));
  }
  return cones;
}

/// What an eye sees of a scene: in the given cones, which must have no open set in common.
/// Pre: view, boxes: of one scene. Post: the parts fill the cones, each ray of them shows what the part says, from the
/// front or from behind; exactly the visible pieces of `proofs/semantics.md`, where pieces of one plane overlap the one
/// that comes first: seen from the front before from behind, then by face id, then by number. Pieces that the eye is in
/// the plane of (or on) hide nothing and are not seen. Cuts are planes through the eye and an edge of the scene, or the
/// line along which two pieces cross. Degenerate: an empty scene is one part for each cone. Cost: follows what is
/// visible; what is behind a piece that covers a region is dropped by boxes. Parallel. Exact: as the view is. Ref:
/// Weiler and Atherton 1977 (cutting the view by faces), Naylor's 2D trees of the slides. Proof: P-62
template <View V>
Visible_surface<V> visible_surface(const V& view, const Piece_boxes& boxes, Cones<V> cones,
                                   const Visible_options& options = {}) {
  Visible_surface<V> surface;
  run_with_threads(options.threads,
                   [&] { surface = visible_detail::Solver<V>(view, boxes, options).solve(std::move(cones)); });
  return surface;
}
/// The same of what is behind pieces that are looked through. Pre: of each cone a list of those that are met first in
/// it, one behind the other, nearest first; each is met in all of it.
template <View V>
Visible_surface<V> visible_surface(const V& view, const Piece_boxes& boxes, Cones<V> cones,
                                   const std::vector<std::vector<std::uint32_t>>& through,
                                   const Visible_options& options = {}) {
  Visible_surface<V> surface;
  run_with_threads(options.threads,
                   [&] { surface = visible_detail::Solver<V>(view, boxes, options).solve(std::move(cones), through); });
  return surface;
}
/// The same over the whole sphere of directions.
template <View V>
Visible_surface<V> visible_surface(const V& view, const Piece_boxes& boxes, const Visible_options& options = {}) {
  return visible_surface(view, boxes, whole_sphere(view), options);
}

/// The corners of a part in the file's coordinates, counterclockwise as seen from the face's front. Pre: something is
/// seen in it. Exact: as the view is. Errors: std::domain_error where an inexact view's numbers say nothing.
template <View V>
std::vector<Exact_point> vertices(const V& view, const Visible_surface<V>& surface,
                                  const typename Visible_surface<V>::Part& part) {
  std::vector<Exact_point> points;
  for (const typename V::Ray& r : surface.of(part)) points.push_back(view.position(part.piece, r));
  if (view.eye_side(part.piece) == CGAL::POSITIVE) std::reverse(points.begin(), points.end());
  return points;
}

// Compiled once, beside what it calls most: in exact_view.cpp. For numbers of CGAL's kernels see kernels.h.
extern template Visible_surface<Exact_view> visible_surface(const Exact_view&, const Piece_boxes&, Cones<Exact_view>,
                                                            const Visible_options&);
extern template Visible_surface<Exact_view> visible_surface(const Exact_view&, const Piece_boxes&, Cones<Exact_view>,
                                                            const std::vector<std::vector<std::uint32_t>>&,
                                                            const Visible_options&);
extern template Visible_surface<Exact_view> visible_surface(const Exact_view&, const Piece_boxes&,
                                                            const Visible_options&);

}  // namespace sightline
