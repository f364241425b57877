#pragma once
// A back-to-front order from one eye, of whole faces wherever there is one: what a priority tree says of that eye.

#include <sightline/algorithms/priority/components.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/priority/index.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/algorithms/priority/scope.h>
#include <sightline/algorithms/priority/separation.h>
#include <sightline/algorithms/priority/tree.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

/// What ordering took.
struct Eye_order_counters {
  std::uint64_t off_view = 0, edge_on = 0;  ///< polygons of the tree that the eye is behind; in whose plane it is
  std::uint64_t searched = 0;  ///< on-view polygons in cycles of the tree, ordered by a search for this eye
  std::uint64_t cycles = 0,
                in_cycles =
                    0;       ///< of those, cycles from this eye, and the polygons in them: the only ones that are cut
  std::uint64_t splits = 0;  ///< how often
  std::uint64_t fragments = 0;  ///< polygons drawn
  Index_counters search;
  Predicate_counts predicates;
  /// What `sightline order` reports, in its order.
  template <class Visit>
  static void each(Visit visit) {
    visit("off_view", &Eye_order_counters::off_view);
    visit("edge_on", &Eye_order_counters::edge_on);
    visit("searched", &Eye_order_counters::searched);
    visit("eye_cycles", &Eye_order_counters::cycles);
    visit("in_eye_cycles", &Eye_order_counters::in_cycles);
  }
};

/// Polygons, farthest first, counterclockwise seen from the fronts of their pieces.
template <class Traits>
struct Eye_order {
  std::vector<Convex_polygon<Traits>> polygons;
  Eye_order_counters counters;
  std::vector<Polygon_store<Traits>> memory;  ///< what some of the polygons point into, the others the tree
};

/// Calls `polygon(i)` for each polygon of the tree and `cycle(slots)` for each of its cycles, the farthest from the eye
/// first; on-view or not. Cost: linear in the tree. Exact: yes.
template <class Traits, class On_polygon, class On_cycle>
void walk_back_to_front(const Traits& traits, const Priority_tree<Traits>& tree, const Exact_point& eye,
                        Predicate_counts& counts, On_polygon polygon, On_cycle cycle) {
  using Tree = Priority_tree<Traits>;
  const typename Traits::Eye viewpoint = traits.eye(eye);
  std::vector<typename Tree::Slot> stack{tree.slots[0]};
  while (!stack.empty()) {
    const typename Tree::Slot slot = stack.back();
    stack.pop_back();
    if (slot == Tree::nothing) continue;
    if (slot >= 0) {
      polygon(static_cast<std::uint32_t>(slot));
      continue;
    }
    const typename Tree::Node& node = tree.nodes[static_cast<std::size_t>(~slot)];
    const std::span<const typename Tree::Slot> slots = tree.slots_of(node);
    switch (node.kind) {
      case Tree::Kind::sequence:  // the last one is pushed last and comes first
        stack.insert(stack.end(), slots.begin(), slots.end());
        break;
      case Tree::Kind::plane: {  // far, then what is on the plane, then near
        const bool front_is_near = side_of(traits, node.plane, eye, viewpoint, counts) != CGAL::NEGATIVE;
        stack.push_back(slots[front_is_near ? 1 : 0]);
        stack.insert(stack.end(), slots.begin() + 2, slots.end());
        stack.push_back(slots[front_is_near ? 0 : 1]);
        break;
      }
      case Tree::Kind::cycle: cycle(slots);
    }
  }
}

namespace priority_detail {

template <Bounded_traits Traits>
class Eye_walk {
 public:
  using Tree = Priority_tree<Traits>;

  using Progress = std::function<void(std::size_t done, std::size_t all)>;

  Eye_walk(const Traits& traits, const Exact_point& eye, const Progress& progress)
      : traits_(traits), eye_(eye), viewpoint_(traits.eye(eye)), progress_(progress) {}

  /// Appends what the tree holds, farthest first.
  void walk(const Tree& tree) {
    walk_back_to_front(
        traits_, tree, eye_, order_.counters.predicates,
        [&](std::uint32_t i) {
          if (is_drawn(tree, i)) draw(tree, i);
        },
        [&](std::span<const typename Tree::Slot> slots) { search(tree, slots); });
  }

  Eye_order<Traits> take() {
    order_.memory.push_back(std::move(store_));
    order_.counters.fragments = order_.polygons.size();
    return std::move(order_);
  }

 private:
  /// What is on-view, and of a tree of both sides what is edge-on, once.
  bool is_drawn(const Tree& tree, std::uint32_t i) {
    const Sign side = traits_.side(viewpoint_, tree.polygons[i].support, order_.counters.predicates);
    order_.counters.off_view += side == CGAL::NEGATIVE;
    order_.counters.edge_on += side == CGAL::ZERO;
    return side == CGAL::POSITIVE || (side == CGAL::ZERO && tree.two_sided && !tree.turned[i]);
  }
  void draw(const Tree& tree, std::uint32_t i) {
    order_.polygons.push_back(tree.turned[i] ? turned_round(tree.polygons[i], store_) : tree.polygons[i]);
  }

  /// A cycle of the tree: the graph of this eye on what is on-view. A component of it that is one face is drawn whole,
  /// any other cut.
  void search(const Tree& tree, std::span<const typename Tree::Slot> slots) {
    std::vector<std::uint32_t> members;
    std::vector<Convex_polygon<Traits>> polygons;
    for (const typename Tree::Slot slot : slots)
      if (const std::uint32_t i = static_cast<std::uint32_t>(slot); is_drawn(tree, i)) {
        members.push_back(i);
        polygons.push_back(tree.polygons[i]);
      }
    order_.counters.searched += members.size();
    const Priority_relation<Traits> faces(traits_, polygons);
    const Region_relation<Traits> relation(faces, View_region::eye(eye_));
    Implicit_priority_graph<Region_relation<Traits>> graph(relation);
    const Priority_components found = graph.find_components(nullptr, progress_);
    order_.counters.search += graph.counters();
    for (std::size_t c = found.size(); c-- > 0;) {
      if (found[c].size() == 1) {
        draw(tree, members[found[c][0]]);
        continue;
      }
      ++order_.counters.cycles;
      order_.counters.in_cycles += found[c].size();
      std::vector<Convex_polygon<Traits>> cycle;
      std::vector<char> turned;
      for (const std::uint32_t k : found[c]) {
        cycle.push_back(polygons[k]);
        turned.push_back(tree.turned[members[k]]);
      }
      Tree cut = build_priority_tree<Traits>(traits_, cycle, turned, {tree.two_sided, true, progress_});
      order_.counters.splits += cut.counters.splits;
      walk(cut);
      for (Polygon_store<Traits>& store : cut.memory) order_.memory.push_back(std::move(store));
    }
  }

  const Traits& traits_;
  const Exact_point& eye_;
  const typename Traits::Eye viewpoint_;
  const Progress& progress_;
  Polygon_store<Traits> store_;
  Eye_order<Traits> order_;
};

}  // namespace priority_detail

/// The on-view polygons of a tree so that none obscures one drawn after it; of a tree of both sides, every piece once.
/// Whole, but where the tree was built to cut, and where faces of one of its cycles overlap in a cycle from this eye:
/// these are cut. Degenerate: pieces seen edge-on are off-view; they have no place, and stand anywhere in an order of
/// both sides. `progress` is called while cycles are searched and cut. Cost: linear in the tree, and a search of each
/// of its cycles. Exact: yes. Pre: exact traits; the tree outlives the order. Source: Fuchs, Kedem, Naylor 1979;
/// Naylor, "Visibility Orderings". Proof: P-35, P-37
template <Bounded_traits Traits>
Eye_order<Traits> back_to_front(const Traits& traits, const Priority_tree<Traits>& tree, const Exact_point& eye,
                                const std::function<void(std::size_t done, std::size_t all)>& progress = {}) {
  priority_detail::Eye_walk<Traits> walk(traits, eye, progress);
  walk.walk(tree);
  return walk.take();
}

// Compiled once, in eye_order.cpp.
extern template Eye_order<Exact_traits> back_to_front(const Exact_traits&, const Priority_tree<Exact_traits>&,
                                                      const Exact_point&,
                                                      const std::function<void(std::size_t, std::size_t)>&);

}  // namespace sightline
