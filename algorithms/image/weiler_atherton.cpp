#include <sightline/algorithms/image/weiler_atherton.h>

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

namespace {

using Chunks = visible_detail::Chunks<Exact_view>;
using Item = visible_detail::Item;
using Window = visible_detail::Task<Exact_view>;

/// How Weiler and Atherton cut a window: along the edges of the polygon that is first in the list, one after the other.
class Clip_polygon {
 public:
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
  Exact_view::Plane choose(const Window& window, Visible_counters& counters) const {
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

}  // namespace

}  // namespace image_detail

Visible_surface<Exact_view> weiler_atherton(const Exact_view& view, Cones<Exact_view> cones,
                                            const Visible_options& options) {
  Visible_surface<Exact_view> surface;
  run_with_threads(options.threads, [&] {
    const Piece_boxes boxes(view.scene());
    surface =
        visible_detail::Solver<Exact_view, image_detail::Clip_polygon>(view, boxes, options).solve(std::move(cones));
  });
  return surface;
}

}  // namespace sightline
