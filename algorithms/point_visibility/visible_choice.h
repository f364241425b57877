#pragma once
// By which plane a region is cut.

#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/algorithms/point_visibility/visible_chunks.h>
#include <sightline/algorithms/point_visibility/visible_region.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/sign.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

namespace sightline::visible_detail {

template <View V>
class Cut_choice {
 public:
  using Plane = typename V::Plane;

  explicit Cut_choice(const Chunks<V>& chunks) : chunks_(chunks), view_(chunks.view()) {}

  /// The plane to cut a region by: of the edges of the piece that is nearest in the middle of it and of one more in its
  /// plane, or of the piece in the middle of the pile that it is in, the one that shares out the rest best; where
  /// nothing but pieces that cover the region is left, and two of them cross, their line. Pre: there are items.
  Plane choose(const Task<V>& task, Visible_counters& counters) const {
    if (const Item* nearest = nearest_in_the_middle(task)) {
      std::vector<Item> beside = beside_of(*nearest, task), pile = pile_of(*nearest, beside);
      if (pile.empty()) {
        const Item other = beside[beside.size() / 2];  // of pieces in one plane none is the nearest
        return cheapest_edge({*nearest, other}, nullptr, task, counters.predicates);
      }
      const auto middle = pile.begin() + static_cast<std::ptrdiff_t>(pile.size() / 2);
      std::nth_element(pile.begin(), middle, pile.end(),
                       [&](const Item& f, const Item& g) { return !chunks_.comes_first(g.chunk, f.chunk); });
      return cheapest_edge({*middle}, &*middle, task, counters.predicates);
    }
    ++counters.crossings;
    return view_.crossing(chunks_.piece_of(task.cover),
                          chunks_.piece_of(task.items.front().chunk));  // no boxes are left
  }

  /// Whether a cut wants to know more of the region than this: most of the items are in one plane, and few, or one
  /// pile. Pre: there are items.
  bool wants_more(const Task<V>& task) const {
    const Item* nearest = nearest_in_the_middle(task);
    if (nearest == nullptr) return false;
    const auto are_most = [&](const std::vector<Item>& items) { return 4 * items.size() >= 3 * task.items.size(); };
    const std::vector<Item> beside = beside_of(*nearest, task);
    return are_most(beside) && (task.items.size() < few || are_most(pile_of(*nearest, beside)));
  }

 private:
  static constexpr std::size_t few = 64;

  /// The items in the plane of one of them that do not cover the region, this one among them.
  std::vector<Item> beside_of(const Item& item, const Task<V>& task) const {
    std::vector<Item> beside;
    for (const Item& other : task.items)
      if (!other.covers() && chunks_.same_plane(item.chunk, other.chunk)) beside.push_back(other);
    return beside;
  }
  /// Of items in one plane those that a direction inside one of them meets; none where these are few. They do not hide
  /// each other. A cut by an edge of the first in their order would leave all others in both parts; in the middle of it
  /// half of them are done with inside, and the other half outside.
  std::vector<Item> pile_of(const Item& item, const std::vector<Item>& beside) const {
    constexpr std::size_t least = 5;
    std::vector<Item> pile;
    if (beside.size() < least) return pile;
    const Approximate_vector middle = chunks_.middle_of(item.chunk);
    for (const Item& other : beside)
      if (chunks_.holds(other.chunk, middle)) pile.push_back(other);
    if (pile.size() < least) pile.clear();
    return pile;
  }

  /// Of items that do not cover the region: of those that the middle meets, else of all, by their planes; none where
  /// all cover it.
  const Item* nearest_in_the_middle(const Task<V>& task) const {
    const Approximate_vector middle = middle_of(view_, task.region);
    double nearest = -std::numeric_limits<double>::infinity();
    bool met = false;
    const Item* best = nullptr;
    for (const Item& item : task.items) {
      if (item.covers()) continue;
      const double near = view_.nearness(chunks_.piece_of(item.chunk), middle);
      if (best != nullptr && met && near <= nearest) continue;
      const bool meets = chunks_.holds(item, middle);
      if (best == nullptr || (meets && !met) || (meets == met && near > nearest)) {
        nearest = near;
        best = &item;
        met = meets;
      }
    }
    return best;
  }
  /// Of the edges of the items. `shown`: as in cost_of().
  Plane cheapest_edge(std::initializer_list<Item> items, const Item* shown, const Task<V>& task,
                      Predicate_counts& counts) const {
    const Plane* cheapest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Item& item : items) {
      if (cheapest != nullptr && item.chunk == items.begin()->chunk) continue;
      for (std::uint32_t bits = item.active; bits != 0; bits &= bits - 1) {
        const Plane& w = chunks_.edges_of(item.chunk)[std::countr_zero(bits)];
        const double cost = cost_of(w, shown, task, counts);
        if (cheapest == nullptr || cost < least) {
          least = cost;
          cheapest = &w;
        }
      }
    }
    return *cheapest;
  }
  /// What a cut costs: pieces and boxes that it does not keep on one side, and how unequal the sides become. A box
  /// counts as the square root of its pieces: most of them will be hidden. `shown`: the item that the cut is an edge
  /// of, where it is of a pile: what comes after that in its plane is not seen inside.
  double cost_of(const Plane& w, const Item* shown, const Task<V>& task, Predicate_counts& counts) const {
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
      if (shown != nullptr && at_back && chunks_.same_plane(shown->chunk, item.chunk) &&
          chunks_.comes_first(shown->chunk, item.chunk))
        in_front = false;
      weigh(in_front, at_back, 1);
    }
    return price * both + std::fabs(front - behind);
  }

  const Chunks<V>& chunks_;
  const V& view_;
};

}  // namespace sightline::visible_detail
