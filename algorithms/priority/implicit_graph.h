#pragma once
// The priority graph without its arcs: components by depth-first search over an index that forgets what the search has
// visited.

#include <sightline/algorithms/priority/components.h>
#include <sightline/algorithms/priority/index.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace sightline {

/// Why the faces of a component are in it: arcs of two trees over each component, both rooted at its first discovered
/// face. Every face but the root can be reached from the root over `from`, and reaches the root over `to`. The roots
/// have themselves.
struct Component_trees {
  std::vector<std::uint32_t> from;  ///< by face: a face of its component that may obscure it
  std::vector<std::uint32_t> to;    ///< by face: a face of its component that it may obscure
};

/// The graph of a relation, implicit. `Relation` is a Priority_relation, or a relation of fewer arcs on the same faces,
/// with faces() for the whole one.
template <class Relation>
class Implicit_priority_graph {
 public:
  using Index = Priority_index<typename Relation::Traits>;

  /// Pre: the relation outlives the graph. Cost: O(n log n) time, O(n) memory.
  explicit Implicit_priority_graph(Relation&&) = delete;
  explicit Implicit_priority_graph(const Relation& relation) : relation_(&relation), index_(relation.faces()) {}

  std::size_t size() const { return relation_->size(); }
  bool has_arc(std::uint32_t i, std::uint32_t j) const { return relation_->may_obscure(i, j, counters_.relation); }
  const Index_counters& counters() const { return counters_; }

  /// The components by two depth-first searches (Kosaraju, Sharir): along the arcs for the order in which faces are
  /// finished, then against them from the last finished one on. Each search asks the index for a live face only, and
  /// removes what it visits. A face that is a tree of its own in the first search is a component. Cost: up to 2n hits
  /// and 2n misses, each a descent of the index where its boxes rule out well; O(n) memory, no recursion. Exact: as the
  /// relation is. Proof: P-32
  Priority_components find_components(Component_trees* trees = nullptr,
                                      const std::function<void(std::size_t done, std::size_t all)>& progress = {}) {
    const std::uint32_t n = static_cast<std::uint32_t>(size());
    std::vector<std::uint32_t> finished;
    finished.reserve(n);
    std::vector<std::uint32_t> h(n);
    if (trees != nullptr) {
      trees->from.resize(n);
      trees->to.resize(n);
    }

    std::size_t steps = 0, done = 0;
    const auto tick = [&] {
      if (progress && ++steps % 16 == 0) progress(done, 2 * std::size_t{n});
    };

    // 1. Along the arcs.
    index_.revive();
    std::vector<char> alone(n);  // trees of one face
    for (std::uint32_t root = 0; root < n; ++root) {
      const std::size_t before = finished.size();
      search(
          root, Follow::obscured, trees == nullptr ? nullptr : &trees->from, [&](std::uint32_t) {},
          [&](std::uint32_t face) {
            finished.push_back(face);
            ++done;
          },
          tick);
      alone[root] = finished.size() == before + 1;
    }

    // 2. Against them, last finished first: each search is a component.
    if (std::find(alone.begin(), alone.end(), 0) != alone.end()) index_.revive(alone);
    std::uint32_t count = 0;
    const auto enter = [&](std::uint32_t face) {
      h[face] = count;
      ++done;
    };
    for (std::uint32_t k = n; k-- > 0;) {
      const std::uint32_t face = finished[k];
      if (alone[face]) {
        enter(face);
        tick();
        if (trees != nullptr) trees->to[face] = face;
        ++count;
      } else if (search(
                     face, Follow::obscuring, trees == nullptr ? nullptr : &trees->to, enter, [](std::uint32_t) {},
                     tick)) {
        ++count;
      }
    }
    if (trees != nullptr) keep_within(h, *trees);
    return {std::move(h), count};
  }

 private:
  struct Step {
    std::uint32_t face, from;
  };

  /// Depth-first search from a root, if that is live; parents by face, roots their own. `tick` is called at each step.
  template <class Enter, class Leave, class Tick>
  bool search(std::uint32_t root, Follow follow, std::vector<std::uint32_t>* parents, Enter enter, Leave leave,
              Tick tick) {
    if (!index_.is_live(root)) return false;
    const auto visit = [&](std::uint32_t face, std::uint32_t parent) {
      index_.remove(face);
      if (parents != nullptr) (*parents)[face] = parent;
      enter(face);
      stack_.push_back({face, 0});
    };
    visit(root, root);
    while (!stack_.empty()) {
      tick();
      Step& step = stack_.back();
      const std::uint32_t i = step.face;
      const auto accept = [&](std::uint32_t j) {
        return follow == Follow::obscured ? relation_->may_obscure(i, j, counters_.relation)
                                          : relation_->may_obscure(j, i, counters_.relation);
      };
      if (const auto j = index_.next(i, follow, step.from, counters_, accept)) {
        visit(*j, i);
      } else {
        leave(i);
        stack_.pop_back();
      }
    }
    return true;
  }

  /// A tree's arc may come from another component: then the face is where the search entered its own, the root.
  static void keep_within(const std::vector<std::uint32_t>& h, Component_trees& trees) {
    for (std::uint32_t face = 0; face < h.size(); ++face)
      for (std::vector<std::uint32_t>* tree : {&trees.from, &trees.to})
        if (h[(*tree)[face]] != h[face]) (*tree)[face] = face;
  }

  const Relation* relation_;
  Index index_;
  std::vector<Step> stack_;
  mutable Index_counters counters_;
};

template <class Relation>
Priority_components components(Implicit_priority_graph<Relation>& graph) {
  return graph.find_components();
}

extern template class Implicit_priority_graph<Priority_relation<Exact_traits>>;  // compiled once

}  // namespace sightline
