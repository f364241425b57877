#pragma once
// By which plane a region is cut.

#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/algorithms/point_visibility/visible_chunks.h>
#include <sightline/algorithms/point_visibility/visible_region.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/sign.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace sightline::visible_detail {

template <View V>
class Cut_choice {
 public:
  using Plane = typename V::Plane;

  explicit Cut_choice(const Chunks<V>& chunks) : chunks_(chunks), view_(chunks.view()) {}

  /// The plane to cut a region by: of the edges of the piece that is nearest in the middle of it, the one that shares
  /// out the rest best; where nothing but pieces that cover the region is left, and two of them cross, their line.
  /// Pre: there are items.
  Plane choose(const Task<V>& task, Visible_counters& counters) const {
    if (const Item* nearest = nearest_in_the_middle(task)) return cheapest_edge(*nearest, task, counters.predicates);
    ++counters.crossings;
    return view_.crossing(chunks_.piece_of(task.cover),
                          chunks_.piece_of(task.items.front().chunk));  // no boxes are left
  }

 private:
  /// Of items that do not cover the region; none where all do.
  const Item* nearest_in_the_middle(const Task<V>& task) const {
    const Approximate_vector middle = middle_of(view_, task.region);
    double nearest = -std::numeric_limits<double>::infinity();
    const Item* best = nullptr;
    for (const Item& item : task.items) {
      if (item.covers()) continue;
      const double near = view_.nearness(chunks_.piece_of(item.chunk), middle);
      if (best == nullptr || near > nearest) {
        nearest = near;
        best = &item;
      }
    }
    return best;
  }
  Plane cheapest_edge(const Item& item, const Task<V>& task, Predicate_counts& counts) const {
    const Plane* cheapest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t bits = item.active; bits != 0; bits &= bits - 1) {
      const Plane& w = chunks_.edges_of(item.chunk)[std::countr_zero(bits)];
      const double cost = cost_of(w, task, counts);
      if (cheapest == nullptr || cost < least) {
        least = cost;
        cheapest = &w;
      }
    }
    return *cheapest;
  }
  /// What a cut costs: pieces and boxes that it does not keep on one side, and how unequal the sides become. A box
  /// counts as the square root of its pieces: most of them will be hidden.
  double cost_of(const Plane& w, const Task<V>& task, Predicate_counts& counts) const {
    constexpr double price = 3;
    double front = 0, behind = 0, both = 0;
    const auto weigh = [&](bool in_front, bool at_back, double weight) {
      (in_front && at_back ? both : in_front ? front : behind) += weight;
    };
    const Plane against = view_.opposite(w);
    for (const Closed_box& box : task.boxes) {
      const Piece_boxes::Node& node = chunks_.node(box);
      weigh(!chunks_.is_behind(node, w), !chunks_.is_behind(node, against), std::sqrt(static_cast<double>(node.count)));
    }
    for (const Item& item : task.items) {
      bool in_front = false, at_back = false;
      for (const std::uint32_t p : chunks_.points_of(item.chunk)) {
        const Sign s = view_.side(w, p, counts);
        in_front = in_front || s == CGAL::POSITIVE;
        at_back = at_back || s == CGAL::NEGATIVE;
      }
      weigh(in_front, at_back, 1);
    }
    return price * both + std::fabs(front - behind);
  }

  const Chunks<V>& chunks_;
  const V& view_;
};

}  // namespace sightline::visible_detail
