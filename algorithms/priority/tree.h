#pragma once
// A visibility order for all eyes at once, of whole faces wherever there is one: fixed priorities, planes that cut
// nothing, and, where neither helps, faces that are searched from each eye or cut beforehand.

#include <sightline/algorithms/priority/components.h>
#include <sightline/algorithms/priority/explicit_graph.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/priority/index.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/algorithms/priority/separation.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

struct Priority_tree_options {
  bool two_sided = false;  ///< every piece counts twice, once from each side
  bool split = false;      ///< cut faces until no order depends on a search
  std::function<void(std::size_t done, std::size_t all)> progress = {};  ///< polygons settled, and of how many so far
};

/// What a tree is made of. The three ways to settle a polygon add up to its polygons.
struct Priority_tree_counters {
  std::uint64_t pieces = 0;     ///< polygons given; with two_sided two a piece
  std::uint64_t polygons = 0;   ///< after cutting
  std::uint64_t by_number = 0;  ///< settled by h: alone in a component
  std::uint64_t by_plane = 0;   ///< settled as lying in a separating plane
  std::uint64_t left = 0;       ///< in components that no plane separates: searched from each eye
  std::uint64_t sequences = 0, planes = 0, cycles = 0;  ///< nodes by kind
  std::uint64_t free_planes = 0, cutting_planes = 0;  ///< of the planes: those that are no face's; those that cut faces
  std::uint64_t depth = 0;
  std::uint64_t splits = 0;  ///< cuts
  std::uint64_t graphs = 0;  ///< components searched for
  Index_counters search;
  Predicate_counts predicates;  ///< of planes and cuts
  /// What `sightline order` reports, in its order.
  template <class Visit>
  static void each(Visit visit) {
    visit("by_number", &Priority_tree_counters::by_number);
    visit("by_plane", &Priority_tree_counters::by_plane);
    visit("left", &Priority_tree_counters::left);
    visit("planes", &Priority_tree_counters::planes);
    visit("sequences", &Priority_tree_counters::sequences);
    visit("cycles", &Priority_tree_counters::cycles);
  }
};

/// Nodes of three kinds. `sequence`: children whose order is the same from every eye, highest priority first (h of the
/// paper). `plane`: what is behind, what is in front, what lies on it; the eye's side tells which is nearer. `cycle`: a
/// strongly connected component that no plane found separates.
template <class Traits>
struct Priority_tree {
  enum class Kind : std::uint8_t { sequence, plane, cycle };
  using Slot = std::int32_t;  ///< a polygon p >= 0, a node n as ~n, or nothing
  static constexpr Slot nothing = std::numeric_limits<Slot>::min();
  static constexpr Slot node(std::size_t n) { return ~static_cast<Slot>(n); }

  struct Node {
    Kind kind;
    Separating_plane plane;  ///< of a plane node
    /// Its slots; of a plane node the one behind, the one in front, then the polygons on it.
    std::uint32_t first, count;
  };

  std::vector<Node> nodes;
  std::vector<Slot> slots{nothing};  ///< slots[0] is the root
  std::vector<Convex_polygon<Traits>>
      polygons;              ///< counterclockwise seen from the side that counts; those that were cut stay, in no slot
  std::vector<char> turned;  ///< by polygon: whether that is the back of its piece
  bool two_sided = false;    ///< whether it holds backs
  Priority_tree_counters counters;
  std::vector<Polygon_store<Traits>> memory;  ///< what the polygons point into

  std::span<const Slot> slots_of(const Node& n) const { return std::span(slots).subspan(n.first, n.count); }
};

/// The same polygon seen from behind: corners in the opposite order, each with the edge that now follows it, and the
/// opposite plane.
template <class Traits>
Convex_polygon<Traits> turned_round(const Convex_polygon<Traits>& polygon, Polygon_store<Traits>& store) {
  std::vector<Corner<Traits>> corners;
  for (std::uint32_t k = polygon.size; k-- > 0;)
    corners.push_back({polygon.corners[k].vertex, polygon.corners[k == 0 ? polygon.size - 1 : k - 1].edge});
  return store.keep(corners, polygon.piece, polygon.support.opposite());
}

namespace priority_detail {

template <Bounded_traits Traits>
class Tree_builder {
 public:
  using Polygon = Convex_polygon<Traits>;
  using Tree = Priority_tree<Traits>;
  using Members = std::vector<std::uint32_t>;

  Tree_builder(const Traits& traits, const Priority_tree_options& options)
      : traits_(traits), options_(options), finder_(traits) {}

  void add(const Polygon& polygon, bool turned) {
    tree_.polygons.push_back(polygon);
    tree_.turned.push_back(turned);
    finder_.add(polygon);
  }
  Polygon_store<Traits>& store() { return store_; }

  Tree build() {
    if (options_.progress) {
      tick_ = [this](std::size_t, std::size_t) { options_.progress(done_, tree_.polygons.size() - gone_); };
      finder_.tick = [this] { tick_(0, 0); };
    }
    tree_.two_sided = options_.two_sided;
    tree_.counters.pieces = tree_.polygons.size();
    Job root;
    root.members.resize(tree_.polygons.size());
    for (std::uint32_t i = 0; i < root.members.size(); ++i) root.members[i] = i;
    push(std::move(root));
    while (!jobs_.empty()) {
      Job job = std::move(jobs_.back());
      jobs_.pop_back();
      settle(std::move(job));
    }
    tree_.counters.polygons = tree_.counters.by_number + tree_.counters.by_plane + tree_.counters.left;
    tree_.memory.push_back(std::move(store_));
    return std::move(tree_);
  }

 private:
  /// Polygons, what is known of them, and the slot that waits for their node.
  struct Job {
    Members members{};
    std::size_t slot = 0;
    std::uint64_t depth = 1;
    bool strong = false;  // they are one strongly connected component
  };

  /// One polygon, or none, needs no node.
  void push(Job job) {
    if (job.members.size() > 1) {
      jobs_.push_back(std::move(job));
    } else if (job.members.size() == 1) {
      tree_.slots[job.slot] = static_cast<typename Tree::Slot>(job.members[0]);
      settled(tree_.counters.by_number, 1);
    }
  }
  void settled(std::uint64_t& way, std::size_t count) {
    way += count;
    done_ += count;
    if (options_.progress) options_.progress(done_, tree_.polygons.size() - gone_);
  }

  /// Makes a node for the job, with empty slots.
  typename Tree::Node& add_node(const Job& job, typename Tree::Kind kind, std::size_t slots) {
    tree_.slots[job.slot] = Tree::node(tree_.nodes.size());
    tree_.counters.depth = std::max(tree_.counters.depth, job.depth);
    tree_.nodes.push_back(
        {kind, {}, static_cast<std::uint32_t>(tree_.slots.size()), static_cast<std::uint32_t>(slots)});
    tree_.slots.resize(tree_.slots.size() + slots, Tree::nothing);
    return tree_.nodes.back();
  }

  /// Planes that cut nothing and divide well first, as they are cheaper to find than the graph's components; then
  /// these; then planes again, however they divide; then cuts.
  void settle(Job job) {
    const std::size_t n = job.members.size();
    if (!job.strong && n > many)
      if (auto found = finder_.find(job.members, n / 8, some_directions, tree_.counters.predicates))
        return divide(job, std::move(*found));
    if (!job.strong && !enumerate(job)) return;
    if (auto found =
            finder_.find(job.members, 1, std::max<std::size_t>(some_directions, effort / n), tree_.counters.predicates))
      return divide(job, std::move(*found));
    if (!options_.split) return leave(job);
    divide(job, divided(job.members));
  }

  /// The node of a plane.
  void divide(const Job& job, Separation found) {
    const Members& on = found.sides[0];
    typename Tree::Node& node = add_node(job, Tree::Kind::plane, 2 + on.size());
    node.plane = found.plane;
    ++tree_.counters.planes;
    tree_.counters.free_planes += node.plane.is_free();
    const std::size_t first = node.first;
    for (std::size_t k = 0; k < on.size(); ++k) tree_.slots[first + 2 + k] = static_cast<typename Tree::Slot>(on[k]);
    settled(tree_.counters.by_plane, on.size());
    for (std::size_t side = 0; side < 2; ++side)
      push({std::move(found.sides[1 + side]), first + side, job.depth + 1, false});
  }

  /// The node of the components of the graph, highest priority first. Returns whether they are one, in which case there
  /// is no node.
  bool enumerate(Job& job) {
    const Priority_components found = components_of(job.members);
    if (found.size() == 1) return job.strong = true;
    const std::size_t first = add_node(job, Tree::Kind::sequence, found.size()).first;
    ++tree_.counters.sequences;
    for (std::size_t c = 0; c < found.size(); ++c) {
      Members members;
      for (const std::uint32_t i : found[c]) members.push_back(job.members[i]);
      push({std::move(members), first + c, job.depth + 1, found[c].size() > 1});
    }
    return false;
  }
  Priority_components components_of(const Members& members) {
    std::vector<Polygon> polygons;
    for (const std::uint32_t i : members) polygons.push_back(tree_.polygons[i]);
    const Priority_relation<Traits> relation(traits_, polygons);
    ++tree_.counters.graphs;
    if (members.size() <= few) {
      const Explicit_priority_graph graph(relation, tick_);
      tree_.counters.search.relation += graph.counters();
      return components(graph);
    }
    Implicit_priority_graph<Priority_relation<Traits>> graph(relation);
    Priority_components found = graph.find_components(nullptr, tick_);
    tree_.counters.search += graph.counters();
    return found;
  }

  /// The node of a component that stays one.
  void leave(const Job& job) {
    const std::size_t first = add_node(job, Tree::Kind::cycle, job.members.size()).first;
    ++tree_.counters.cycles;
    for (std::size_t k = 0; k < job.members.size(); ++k)
      tree_.slots[first + k] = static_cast<typename Tree::Slot>(job.members[k]);
    settled(tree_.counters.left, job.members.size());
  }

  /// Cuts a member along a plane that it is across: its parts behind and in front, as new polygons.
  std::array<std::uint32_t, 2> cut(std::uint32_t member, const typename Traits::Cutter& cutter) {
    const Polygon polygon = tree_.polygons[member];
    classify(traits_, polygon, cutter, scratch_, tree_.counters.predicates);
    const std::uint32_t next = static_cast<std::uint32_t>(tree_.polygons.size());
    for (const Polygon& half : split(traits_, polygon, cutter, scratch_, store_)) add(half, tree_.turned[member] != 0);
    ++gone_;
    return {next, next + 1};
  }

  /// The members divided by the plane of one of them, those across it cut: of the planes tried the first one of the
  /// least cost, which is what it cuts, times split_cost, and by how many its sides differ.
  Separation divided(const Members& members) {
    const std::size_t n = members.size(), tries = std::min(n, std::max<std::size_t>(64, effort / n));
    std::size_t best_cost = std::numeric_limits<std::size_t>::max();
    Plane best;
    std::set<std::uint32_t> seen;
    for (std::size_t t = 0; t < tries; ++t) {
      const Plane plane = tree_.polygons[members[t * n / tries]].support;
      if (!seen.insert(plane.id()).second) continue;
      if (tick_) tick_(0, 0);
      const auto cutter = traits_.prepare(plane);
      std::array<std::size_t, 4> at{};
      for (std::size_t k = 0; k < n && split_cost * at[3] < best_cost; ++k) {
        ++at[static_cast<std::size_t>(
            position_to(traits_, tree_.polygons[members[k]], cutter, plane, tree_.counters.predicates))];
      }
      if (const std::size_t cost = split_cost * at[3] + std::max(at[1], at[2]) - std::min(at[1], at[2]);
          cost < best_cost) {
        best_cost = cost;
        best = plane;
      }
    }

    Separation found{{best, {}}, {}};
    const std::uint64_t before = tree_.counters.splits;
    const auto cutter = traits_.prepare(best);
    for (const std::uint32_t i : members) {
      const Position at = position_to(traits_, tree_.polygons[i], cutter, best, tree_.counters.predicates);
      if (at != Position::across) {
        found.sides[static_cast<std::size_t>(at)].push_back(i);
        continue;
      }
      const auto [behind, front] = cut(i, cutter);
      ++tree_.counters.splits;
      found.sides[1].push_back(behind);
      found.sides[2].push_back(front);
    }
    tree_.counters.cutting_planes += tree_.counters.splits > before;
    return found;
  }

  static constexpr std::size_t few = 24;  // members; up to here comparing all pairs is faster than an index
  // Members; above, a plane that divides well is looked for before the graph is searched.
  static constexpr std::size_t many = 128;
  static constexpr std::size_t some_directions = 16;  // to look along for planes that divide well
  static constexpr std::size_t effort = 1 << 20;      // projections or tests for one plane, about, where any will do
  static constexpr std::size_t split_cost = 4;        // a cut costs as much as an imbalance of this many polygons

  const Traits& traits_;
  Priority_tree_options options_;
  Separation_finder<Traits> finder_;
  std::function<void(std::size_t, std::size_t)> tick_;  // the tree's own progress, from within a long step
  Tree tree_;
  Polygon_store<Traits> store_;
  Split_scratch<Traits> scratch_;
  std::vector<Job> jobs_;
  std::size_t done_ = 0, gone_ = 0;
};

}  // namespace priority_detail

/// A tree of all pieces of the scene. Degenerate: coplanar pieces lie on one node together; pieces that cross stay in a
/// cycle, or, with `split`, are cut. Cost: a search of the graph for every few levels; without `split` no face is cut.
/// Pre: exact traits, or what kernels.h says. Exact: as the traits are. Proof: P-37
template <Bounded_traits Traits>
Priority_tree<Traits> build_priority_tree(const Traits& traits, const Priority_tree_options& options = {}) {
  priority_detail::Tree_builder<Traits> builder(traits, options);
  for (std::uint32_t i = 0; i < traits.piece_count(); ++i) {
    const Convex_polygon<Traits> polygon = builder.store().piece(traits, i);
    builder.add(polygon, false);
    if (options.two_sided) builder.add(turned_round(polygon, builder.store()), true);
  }
  return builder.build();
}
/// A tree of these polygons, `turned` those that are the backs of their pieces. Pre: what the polygons point into
/// outlives the tree.
template <Bounded_traits Traits>
Priority_tree<Traits> build_priority_tree(const Traits& traits, std::span<const Convex_polygon<Traits>> polygons,
                                          std::span<const char> turned, const Priority_tree_options& options = {}) {
  priority_detail::Tree_builder<Traits> builder(traits, options);
  for (std::size_t i = 0; i < polygons.size(); ++i) builder.add(polygons[i], turned[i] != 0);
  return builder.build();
}

// Compiled once, in tree.cpp.
extern template Priority_tree<Exact_traits> build_priority_tree(const Exact_traits&, const Priority_tree_options&);
extern template Priority_tree<Exact_traits> build_priority_tree(const Exact_traits&,
                                                                std::span<const Convex_polygon<Exact_traits>>,
                                                                std::span<const char>, const Priority_tree_options&);

}  // namespace sightline
