#pragma once
// Building a BSP tree of a scene.

#include <sightline/algorithms/bsp/options.h>
#include <sightline/algorithms/bsp/tree.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/traits/partition_traits.h>
#include <sightline/kernel/vertex.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

namespace bsp_detail {

/// Random numbers that depend on the place in the tree only, so that threads change nothing.
struct Random {
  std::uint64_t state;
  std::uint64_t operator()() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(static_cast<unsigned __int128>((*this)()) * n >> 64);
  }
};

template <Partition_traits Traits>
class Builder {
 public:
  using Polygon = Convex_polygon<Traits>;
  using Polygons = std::vector<Polygon>;
  using Tree = Bsp_tree<Traits>;
  using Positions = typename Plane_group<Traits>::Positions;

  Builder(const Traits& traits, const Bsp_options& options) : traits_(traits), options_(options) {
    options_.sample = std::max(1u, options_.sample);
  }

  Tree build() {
    Part root;
    run_with_threads(options_.threads, [&] {
      Task_group group;
      group.run_and_wait([&] { settle({input(), options_.seed, 1, options_.given.empty() ? none : 0}, root, group); });
    });
    Tree tree;
    join(root, tree);
    finish(tree);
    return tree;
  }

 private:
  /// Polygons in a convex cell of space, to be divided.
  struct Cell {
    Polygons polygons;
    std::uint64_t seed;
    std::uint64_t depth;
    std::int32_t given;  // the node that it is to have, or none
  };
  /// A cell whose polygons are the last ones on a stack, from `begin` on; and the side of a node that waits for its
  /// number: 2 node + side, or none.
  struct Waiting {
    std::size_t begin;
    std::int64_t place;
    std::uint64_t seed;
    std::uint64_t depth;
    std::int32_t given;
  };
  /// The tree of a cell, in preorder; that of a large cell is its first node and those of its two sides.
  struct Part {
    std::vector<typename Tree::Node> nodes;
    std::vector<Fragment<Traits>> fragments;
    Part* front = nullptr;
    Part* behind = nullptr;
  };
  /// What a cell draws first: the seeds of its sides, and the random numbers for its own choices.
  struct Draws {
    explicit Draws(std::uint64_t seed) : own{seed}, behind(own()), front(own()) {}
    Random own;
    std::uint64_t behind, front;
  };
  /// What each thread keeps for itself until the end.
  struct Workspace {
    Polygon_store<Traits> store;
    Split_scratch<Traits> scratch;
    Bsp_counters counters;
    std::deque<Part> parts;
    Polygons front, sample;
    std::vector<Plane> planes;
    Plane_group<Traits> group;
    std::vector<Positions> positions, best_positions;
  };
  struct Score {
    std::size_t all, front, behind, across;  // polygons; those with corners in front, behind, both
    std::size_t only_front() const { return front - across; }
    std::size_t only_behind() const { return behind - across; }
  };
  /// The plane for a cell; and, where all polygons of the cell were scored, the place of their positions to it in
  /// best_positions.
  struct Choice {
    Plane plane;
    std::optional<std::size_t> scored = {};
  };

  static constexpr std::size_t worth_a_task = 1024;  // polygons; below, starting a task costs more than it gives
  static constexpr std::size_t ahead = 4;            // polygons whose memory is asked for before they are tested
  // Polygons; below, a chain of face planes is no deeper than free planes would be.
  static constexpr std::size_t worth_balance = 24;

  Polygons input() {
    Polygons polygons;
    Workspace& mine = workspaces_.local();
    polygons.reserve(traits_.piece_count());
    for (std::uint32_t i = 0; i < traits_.piece_count(); ++i) polygons.push_back(mine.store.piece(traits_, i));
    mine.counters.pieces = polygons.size();
    all_ = polygons.size();
    return polygons;
  }

  /// Makes the tree of a cell. The sides of a large cell are parts of their own, and tasks of their own where they are
  /// large, too.
  void settle(Cell cell, Part& part, Task_group& group) {
    Workspace& mine = workspaces_.local();
    const auto is_large = [&](const Polygons& polygons) {
      return polygons.size() >= worth_a_task && options_.threads != 1;
    };
    if (!is_large(cell.polygons)) return settle_here(std::move(cell), part, mine);
    Draws draws(cell.seed);
    const std::size_t first_in_front =  // asked first: it moves the polygons
        divide(cell.polygons, {0, nowhere, cell.seed, cell.depth, cell.given}, draws.own, part, mine);
    const auto middle = cell.polygons.begin() + static_cast<std::ptrdiff_t>(first_in_front);
    const auto [given_front, given_behind] = given_below(cell.given, cell.depth);
    Cell front{{middle, cell.polygons.end()}, draws.front, cell.depth + 1, given_front};
    cell.polygons.erase(middle, cell.polygons.end());
    Cell behind{std::move(cell.polygons), draws.behind, cell.depth + 1, given_behind};
    const auto settle_side = [&](Cell side, Part*& place) {
      if (side.polygons.empty() && side.given < 0) return;
      place = &mine.parts.emplace_back();
      if (!is_large(side.polygons)) settle_here(std::move(side), *place, mine);
      else
        group.run([this, &group, to = place, from = std::make_shared<Cell>(std::move(side))] {
          settle(std::move(*from), *to, group);
        });
    };
    settle_side(std::move(behind), part.behind);
    settle_side(std::move(front), part.front);
  }

  /// Makes the tree of a cell in this thread, with an explicit stack.
  void settle_here(Cell cell, Part& part, Workspace& mine) {
    Polygons polygons = std::move(cell.polygons);
    std::vector<Waiting> stack;
    if (!polygons.empty() || cell.given >= 0) stack.push_back({0, nowhere, cell.seed, cell.depth, cell.given});
    while (!stack.empty()) {
      const Waiting job = stack.back();
      stack.pop_back();
      Draws draws(job.seed);
      const std::int64_t number = static_cast<std::int64_t>(part.nodes.size());
      const std::size_t middle = divide(polygons, job, draws.own, part, mine);
      const auto [front, behind] = given_below(job.given, job.depth);
      if (middle > job.begin || behind >= 0)
        stack.push_back({job.begin, 2 * number + 1, draws.behind, job.depth + 1, behind});
      if (polygons.size() > middle || front >= 0)
        stack.push_back({middle, 2 * number, draws.front, job.depth + 1, front});
    }
  }

  static constexpr std::int64_t nowhere = -1;
  static constexpr std::int32_t none = -1;

  /// The given nodes in front of a cell's plane and behind it.
  std::array<std::int32_t, 2> given_below(std::int32_t given, std::uint64_t depth) const {
    if (given < 0 || depth <= options_.first.size()) return {given, given};
    const Bsp_options::Given& node = options_.given[static_cast<std::size_t>(given)];
    return {node.front, node.behind};
  }

  /// Makes the node of a cell and replaces its polygons by those behind the node's plane and, from the index returned
  /// on, those in front.
  std::size_t divide(Polygons& polygons, const Waiting& job, Random& random, Part& part, Workspace& mine) {
    mine.counters.depth = std::max(mine.counters.depth, job.depth);
    if (job.place != nowhere) child(part.nodes, job.place) = static_cast<std::int32_t>(part.nodes.size());
    const std::span<const Polygon> cell = std::span<const Polygon>(polygons).subspan(job.begin);
    const bool is_first = job.depth <= options_.first.size(), is_given = is_first || job.given >= 0;
    const Choice choice = is_first   ? Choice{options_.first[job.depth - 1]}
                          : is_given ? Choice{options_.given[static_cast<std::size_t>(job.given)].plane}
                                     : choose(cell, random, mine);
    const std::uint32_t first = static_cast<std::uint32_t>(part.fragments.size());
    const std::size_t middle = cell.size() == 1 && !is_given ? keep_only(polygons, choice.plane, part)
                                                             : partition(polygons, job.begin, choice, part, mine);
    const std::uint32_t count = static_cast<std::uint32_t>(part.fragments.size()) - first;
    part.nodes.push_back({choice.plane, Tree::leaf, Tree::leaf, first, count});
    settled(count);
    return middle;
  }
  /// The child that a place names, as in Waiting.
  static std::int32_t& child(std::vector<typename Tree::Node>& nodes, std::int64_t place) {
    typename Tree::Node& node = nodes[static_cast<std::size_t>(place / 2)];
    return place % 2 == 0 ? node.front : node.behind;
  }

  /// The last polygon becomes the fragment of a node on its own plane.
  std::size_t keep_only(Polygons& polygons, Plane plane, Part& part) {
    add_fragment(polygons.back(), plane, part);
    polygons.pop_back();
    return polygons.size();
  }
  void add_fragment(const Polygon& polygon, Plane plane, Part& part) {
    part.fragments.push_back({polygon, traits_.same_sense(polygon.support, plane), 0});
  }

  /// The plane of one of the polygons, which is on it by its id whatever its corners say; or a free plane.
  Choice choose(std::span<const Polygon> polygons, Random& random, Workspace& mine) {
    const std::size_t n = polygons.size();
    if (n == 1) return {polygons[0].support};
    const std::size_t tries = std::min<std::size_t>(n, std::max(1u, options_.candidates));
    mine.planes.clear();
    for (std::size_t t = 0; t < tries; ++t) mine.planes.push_back(polygons[tries == n ? t : random.below(n)].support);
    const std::span<const Polygon> sample = sample_of(polygons, random, mine);
    std::size_t best = 0, best_cost = ~std::size_t{0};
    bool balanced = false;
    for (std::size_t begin = 0; begin < tries; begin += Plane_group<Traits>::most) {
      const std::span<const Plane> planes =
          std::span<const Plane>(mine.planes).subspan(begin, std::min(tries - begin, Plane_group<Traits>::most));
      const auto scores = scores_of(sample, planes, mine);
      const std::size_t before = best_cost;
      for (std::size_t t = 0; t < planes.size(); ++t) {
        balanced |= is_balanced(scores[t]);
        if (const std::size_t c = cost(scores[t]); c < best_cost) {
          best = begin + t;
          best_cost = c;
        }
      }
      if (best_cost < before) std::swap(mine.positions, mine.best_positions);
    }
    if (!balanced && n >= worth_balance) {
      if (const std::optional<Plane> plane = free_plane(polygons, sample, best_cost, mine)) {
        ++mine.counters.free_planes;
        return {*plane};
      }
    }
    return {mine.planes[best], sample.size() == n ? std::optional(best % Plane_group<Traits>::most) : std::nullopt};
  }

  /// All polygons where they are few, else one from each of `sample` equal stretches.
  std::span<const Polygon> sample_of(std::span<const Polygon> polygons, Random& random, Workspace& mine) {
    const std::size_t n = polygons.size();
    if (n <= options_.sample) return polygons;
    mine.sample.clear();
    for (std::size_t k = 0; k < options_.sample; ++k) {
      const std::size_t begin = k * n / options_.sample, end = (k + 1) * n / options_.sample;
      mine.sample.push_back(polygons[begin + random.below(end - begin)]);
      fetch_corners(mine.sample.back());
    }
    for (const Polygon& polygon : mine.sample) fetch_vertices(polygon);
    return mine.sample;
  }

  std::size_t cost(const Score& s) const {
    return (s.front > s.behind ? s.front - s.behind : s.behind - s.front) + options_.split_weight * s.across;
  }
  /// At most eleven twelfths of the polygons strictly on one side.
  static bool is_balanced(const Score& s) { return 12 * std::max(s.only_front(), s.only_behind()) <= 11 * s.all; }

  /// How many of the polygons lie where to a few planes, and in mine.positions each of them.
  std::array<Score, Plane_group<Traits>::most> scores_of(std::span<const Polygon> polygons,
                                                         std::span<const Plane> planes, Workspace& mine) {
    mine.counters.polygon_tests += polygons.size() * planes.size();
    if (mine.positions.size() < polygons.size()) mine.positions.resize(polygons.size());
    mine.group.prepare(traits_, planes);
    mine.group.find(traits_, polygons, mine.positions.data(), mine.counters.predicates);
    Positions front{}, behind{}, across{};
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      for (std::size_t t = 0; t < front.size(); ++t) {
        const std::uint64_t p = mine.positions[i][t];
        front[t] += p >> 1;
        behind[t] += p & 1;
        across[t] += p >> 1 & p;
      }
    }
    std::array<Score, Plane_group<Traits>::most> scores;
    for (std::size_t t = 0; t < scores.size(); ++t) scores[t] = {polygons.size(), front[t], behind[t], across[t]};
    return scores;
  }

  /// The best axis plane through a median corner of the sample, if it balances and costs less than the best face plane
  /// (convex bodies: n).
  std::optional<Plane> free_plane(std::span<const Polygon> polygons, std::span<const Polygon> sample,
                                  std::size_t best_cost, Workspace& mine) {
    std::vector<Plane> planes;
    const std::size_t step = std::max<std::size_t>(1, polygons.size() / (std::size_t{4} * options_.sample));
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::pair<double, const typename Traits::Vertex*>> corners;
      for (std::size_t i = 0; i < polygons.size(); i += step)
        for (const Corner<Traits>& corner : polygons[i])
          if (traits_.is_input(*corner.vertex))
            corners.emplace_back(traits_.coordinate(*corner.vertex, axis), corner.vertex);
      if (corners.empty()) continue;
      const auto middle = corners.begin() + static_cast<std::ptrdiff_t>(corners.size() / 2);
      std::nth_element(corners.begin(), middle, corners.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
      planes.push_back(*traits_.axis_plane(axis, *middle->second));
    }
    if (planes.empty()) return std::nullopt;
    const auto scores = scores_of(sample, planes, mine);
    std::optional<Plane> best;
    for (std::size_t t = 0; t < planes.size(); ++t) {
      // Both sides must shrink to three quarters, or cutting would go on without an end.
      if (4 * std::max(scores[t].front, scores[t].behind) > 3 * scores[t].all) continue;
      if (const std::size_t c = cost(scores[t]); c < best_cost) {
        best = planes[t];
        best_cost = c;
      }
    }
    return best;
  }

  /// Replaces the polygons from `begin` on by those behind the plane and, from the index returned on, those in front.
  std::size_t partition(Polygons& polygons, std::size_t begin, const Choice& choice, Part& part, Workspace& mine) {
    const auto cutter = traits_.prepare(choice.plane);
    const auto position_at = [&](std::size_t i) {
      if (choice.scored) return static_cast<Position>(mine.best_positions[i - begin][*choice.scored]);
      ++mine.counters.polygon_tests;
      if (!traits_.same_plane(polygons[i].support, choice.plane))
        return classify(traits_, polygons[i], cutter, mine.scratch, mine.counters.predicates);
      ++mine.counters.predicates.combinatorial;
      return Position::on;
    };
    const std::uint64_t splits = mine.counters.splits;
    std::size_t behind = begin;  // where the next one behind goes: at most one for each polygon read
    mine.front.clear();
    const auto is_kept = [&](const Polygon& polygon) {
      if (polygon.size < 3) ++mine.counters.degenerate;
      return polygon.size >= 3;
    };
    for (std::size_t i = begin; i < polygons.size(); ++i) {
      if (i + 2 * ahead < polygons.size()) {
        fetch_corners(polygons[i + 2 * ahead]);
        fetch_vertices(polygons[i + ahead]);
      }
      switch (position_at(i)) {
        case Position::on: add_fragment(polygons[i], choice.plane, part); break;
        case Position::behind: polygons[behind++] = polygons[i]; break;
        case Position::in_front: mine.front.push_back(polygons[i]); break;
        case Position::across: {
          ++mine.counters.splits;
          if (choice.scored) classify(traits_, polygons[i], cutter, mine.scratch, mine.counters.predicates);
          const std::array<Polygon, 2> halves = split(traits_, polygons[i], cutter, mine.scratch, mine.store);
          mine.store.reuse(polygons[i]);
          if (is_kept(halves[0])) polygons[behind++] = halves[0];
          if (is_kept(halves[1])) mine.front.push_back(halves[1]);
        }
      }
    }
    polygons.erase(polygons.begin() + static_cast<std::ptrdiff_t>(behind), polygons.end());
    polygons.insert(polygons.end(), mine.front.begin(), mine.front.end());
    if (options_.progress) all_ += mine.counters.splits - splits;
    return behind;
  }

  void settled(std::size_t fragments) {
    if (!options_.progress || fragments == 0) return;
    const std::size_t done = settled_.fetch_add(fragments) + fragments;
    options_.progress(done, all_.load());
  }

  /// Makes one tree of the parts: the nodes of a part, its front, what is behind.
  void join(Part& root, Tree& tree) {
    tree.nodes = std::move(root.nodes);
    tree.fragments = std::move(root.fragments);
    std::vector<std::pair<Part*, std::int64_t>> stack{{root.behind, 1},
                                                      {root.front, 0}};  // and the side of a node, as in Waiting
    while (!stack.empty()) {
      const auto [part, place] = stack.back();
      stack.pop_back();
      if (part == nullptr) continue;
      const std::int32_t number = static_cast<std::int32_t>(tree.nodes.size());
      const std::uint32_t fragments = static_cast<std::uint32_t>(tree.fragments.size());
      child(tree.nodes, place) = number;
      for (typename Tree::Node node : part->nodes) {
        if (node.front != Tree::leaf) node.front += number;
        if (node.behind != Tree::leaf) node.behind += number;
        node.first += fragments;
        tree.nodes.push_back(node);
      }
      tree.fragments.insert(tree.fragments.end(), part->fragments.begin(), part->fragments.end());
      stack.emplace_back(part->behind, 2 * std::int64_t{number} + 1);
      stack.emplace_back(part->front, 2 * std::int64_t{number});
    }
  }

  /// Numbers the fragments of each face and moves all memory to the tree.
  void finish(Tree& tree) {
    std::vector<std::uint32_t> fragments_of;  // by face
    for (Fragment<Traits>& fragment : tree.fragments) {
      const std::uint32_t face = traits_.face(fragment.polygon.piece);
      if (face >= fragments_of.size()) fragments_of.resize(face + 1);
      fragment.number = fragments_of[face]++;
    }
    workspaces_.for_each([&](Workspace& workspace) {
      const Bsp_counters& c = workspace.counters;
      tree.counters.pieces += c.pieces;
      tree.counters.splits += c.splits;
      tree.counters.free_planes += c.free_planes;
      tree.counters.degenerate += c.degenerate;
      tree.counters.polygon_tests += c.polygon_tests;
      tree.counters.depth = std::max(tree.counters.depth, c.depth);
      tree.counters.predicates += c.predicates;
      tree.memory.push_back(std::move(workspace.store));
    });
    tree.counters.nodes = tree.nodes.size();
    tree.counters.fragments = tree.fragments.size();
  }

  const Traits& traits_;
  Bsp_options options_;
  Per_thread<Workspace> workspaces_;
  std::atomic<std::size_t> settled_{0};
  std::atomic<std::size_t> all_{0};  // fragments so far
};

}  // namespace bsp_detail

/// A BSP tree of all pieces of the scene: every piece, or each part of it, lies on the plane of a node. The plane of
/// each node is the best of `candidates` random face planes by splits and balance, or, where none balances, an axis
/// plane through an input vertex. Degenerate: coplanar pieces share a node, with their sense; a piece that touches a
/// plane is not split. Cost: expected O(n log n) tests where splits are few. Memory: the fragments and what they were
/// cut from. Exact: as the traits are; the tree ends for any traits. Source: Fuchs, Kedem, Naylor 1980; lecture slides
/// "Visibility Computation"; Naylor, "Visibility Orderings". Proof: P-06
template <Partition_traits Traits>
Bsp_tree<Traits> build_bsp(const Traits& traits, const Bsp_options& options = {}) {
  return bsp_detail::Builder<Traits>(traits, options).build();
}

// Compiled once, in build.cpp; for CGAL's kernels see kernels.h.
extern template Bsp_tree<Exact_traits> build_bsp(const Exact_traits&, const Bsp_options&);

}  // namespace sightline
