#pragma once
// Visibility orders from a BSP tree: near -> on -> far, or far -> on -> near.

#include <sightline/algorithms/bsp/tree.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sightline {

enum class Direction { back_to_front, front_to_back };

/// What a traversal looked at.
struct Traversal_counters {
  std::uint64_t nodes = 0, fragments = 0;
  std::uint64_t on_planes = 0;  ///< nodes in whose plane the eye is
  Predicate_counts predicates;
};

/// Visits the nodes of the tree, numbered as in tree.nodes, so that none has a fragment which obscures, from the eye,
/// any part of one visited before it (front_to_back: after it): enter(node) says whether anything of its subtree is
/// wanted, which is asked when what comes before all of it has been visited, and visit(node, side) gets the side of the
/// eye to its plane, too. Degenerate: where the eye is in the plane of a node the fragments on it are seen edge-on and
/// neither child obscures the other (their cones from the eye share no open set); the front child is taken as the
/// nearer one. Cost: O(nodes entered), one side test each, an explicit stack. Exact: as the traits are. Source: Naylor,
/// "Visibility Orderings". Proof: P-07
template <Partition_traits Traits, class Enter, class Visit>
Traversal_counters traverse_nodes(const Traits& traits, const Bsp_tree<Traits>& tree, const typename Traits::Eye& eye,
                                  Direction direction, Enter enter, Visit visit) {
  Traversal_counters counters;
  struct Step {
    std::int32_t node;
    bool emit;  // its first child is done: now its own fragments
    Sign side;
  };
  std::vector<Step> stack;
  if (!tree.nodes.empty()) stack.push_back({0, false, CGAL::ZERO});
  while (!stack.empty()) {
    const Step step = stack.back();
    stack.pop_back();
    const auto number = static_cast<std::size_t>(step.node);
    const auto& node = tree.nodes[number];
    if (step.emit) {
      visit(number, step.side);
      counters.fragments += node.count;
      continue;
    }
    if (!enter(number)) continue;
    ++counters.nodes;
    const Sign side = traits.side(eye, node.plane, counters.predicates);
    counters.on_planes += side == CGAL::ZERO;
    std::int32_t first = side == CGAL::NEGATIVE ? node.front : node.behind,
                 last = side == CGAL::NEGATIVE ? node.behind : node.front;
    if (direction == Direction::front_to_back) std::swap(first, last);
    if (last != Bsp_tree<Traits>::leaf) stack.push_back({last, false, CGAL::ZERO});
    stack.push_back({step.node, true, side});
    if (first != Bsp_tree<Traits>::leaf) stack.push_back({first, false, CGAL::ZERO});
  }
  return counters;
}

/// Visits every fragment of the tree in the order of traverse_nodes(). visit(const Fragment&, Sign) also gets the side
/// of the eye to the plane of the fragment's node. Degenerate: coplanar fragments of a node come in the order of the
/// scene. Cost, Exact, Source, Proof: as above.
template <Partition_traits Traits, class Visit>
Traversal_counters traverse(const Traits& traits, const Bsp_tree<Traits>& tree, const typename Traits::Eye& eye,
                            Direction direction, Visit visit) {
  return traverse_nodes(
      traits, tree, eye, direction, [](std::size_t) { return true; },
      [&](std::size_t node, Sign side) {
        for (const Fragment<Traits>& fragment : tree.on(tree.nodes[node])) visit(fragment, side);
      });
}

}  // namespace sightline
