#pragma once
// Weiler and Atherton's algorithm: the nearest polygon cuts all others along its edges, into what is inside and what is
// outside.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/point_visibility/visible_chunks.h>
#include <sightline/algorithms/point_visibility/visible_solver.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace sightline {

namespace image_detail {

/// How Weiler and Atherton cut a window: along the edges of the polygon that is first in the list, one after the other.
template <View V>
class Clip_polygon {
 public:
  using Chunks = visible_detail::Chunks<V>;
  using Item = visible_detail::Item;
  using Window = visible_detail::Task<V>;

  explicit Clip_polygon(const Chunks& chunks) : chunks_(chunks), rank_(chunks.boxes().chunks().size()) {
    // By distance from the eye to the nearest corner: an order to begin with, which decides nothing.
    std::vector<double> distance(rank_.size());
    for (std::uint32_t chunk = 0; chunk < distance.size(); ++chunk) distance[chunk] = nearest_corner(chunk);
    std::vector<std::uint32_t> order(rank_.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t f, std::uint32_t g) { return distance[f] < distance[g]; });
    for (std::uint32_t i = 0; i < order.size(); ++i) rank_[order[i]] = i;
  }

  /// A list holds all that is in its window, and not hidden there.
  bool wants_more(const Window&) const { return true; }

  /// The next edge of the nearest polygon that does not cover the window. Where all cover it, and none is in front of
  /// all others, they pierce each other: the line of two of them. Pre: the list is not empty.
  typename V::Plane choose(const Window& window, Visible_counters& counters) const {
    const Item* nearest = nullptr;
    for (const Item& item : window.items)
      if (!item.covers() && (nearest == nullptr || rank_[item.chunk] < rank_[nearest->chunk])) nearest = &item;
    if (nearest != nullptr) return chunks_.edges_of(nearest->chunk)[std::countr_zero(nearest->active)];
    ++counters.crossings;
    return chunks_.view().crossing(chunks_.piece_of(window.cover), chunks_.piece_of(window.items.front().chunk));
  }

 private:
  double nearest_corner(std::uint32_t chunk) const {
    const Grid_points& points = chunks_.view().scene().points();
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t p : chunks_.points_of(chunk)) {
      const double square = std::pow(points.approximate(p, 0) - chunks_.eye().ax, 2) +
                            std::pow(points.approximate(p, 1) - chunks_.eye().ay, 2) +
                            std::pow(points.approximate(p, 2) - chunks_.eye().az, 2);
      if (square < least) least = square;  // never NaN, which could not be sorted
    }
    return least;
  }

  const Chunks& chunks_;
  std::vector<std::uint32_t> rank_;  // of each chunk
};

}  // namespace image_detail

/// What visible_surface() gives in the given cones, which must have no open set in common: parts that fill them, each
/// showing the same; their cuts differ. Polygons are sorted once, by their nearest corners. The first one is the clip
/// polygon: windows, convex cones of directions, are cut along planes through the eye and its edges. Outside, the next
/// ones are; inside, what is behind it is dropped, and where something turns out to be in front of it, that is the
/// clip polygon there. Polygons that pierce each other are cut by the line where they cross. Clip polygons are convex
/// pieces, of up to 32 corners each; the outside of one is a union of convex windows, each with a list of its own,
/// where Weiler and Atherton have one concave window with holes (clip_to_window() in concave_window.h), so that what is
/// there is cut more often; a polygon is cut by keeping it in the lists of several windows, never by new corners. It is
/// not made of clip_to_window(), which is in rationals alone and costs a thousand times as much: corners are made of
/// corners, and all edges of a ground with the holes that were cut into it are compared, where a convex window is a
/// handful of planes through the eye, by which filters decide (bench_render). Degenerate: of polygons
/// in one plane the one seen from its front is the nearer, then by face id, then by number; pieces in whose plane the
/// eye is are not seen; an empty scene is one part for each cone. Cost: windows, each times the polygons that come down
/// to it: all of them at first. Parallel. Exact: as the view is. Ref: Weiler and Atherton, Hidden surface removal using
/// polygon area sorting, SIGGRAPH 1977. Proof: P-83
template <View V>
Visible_surface<V> weiler_atherton(const V& view, Cones<V> cones, const Visible_options& options = {}) {
  Visible_surface<V> surface;
  run_with_threads(options.threads, [&] {
    const Piece_boxes boxes(view.scene());
    surface = visible_detail::Solver<V, image_detail::Clip_polygon<V>>(view, boxes, options).solve(std::move(cones));
  });
  return surface;
}

// Compiled once, in weiler_atherton.cpp.
extern template Visible_surface<Exact_view> weiler_atherton(const Exact_view&, Cones<Exact_view>,
                                                            const Visible_options&);
extern template Visible_surface<Number_view<double>> weiler_atherton(const Number_view<double>&,
                                                                     Cones<Number_view<double>>,
                                                                     const Visible_options&);
extern template Visible_surface<Number_view<float>> weiler_atherton(const Number_view<float>&,
                                                                    Cones<Number_view<float>>, const Visible_options&);

}  // namespace sightline
