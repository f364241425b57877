#pragma once
// Building a BSP tree of a scene.

#include <sightline/algorithms/bsp/tree.h>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <functional>

namespace sightline {

struct Bsp_options {
  unsigned candidates = 5;       ///< face planes tried for each node
  unsigned sample = 48;          ///< polygons that a candidate is scored on, at most
  unsigned split_weight = 3;     ///< a split costs as much as an imbalance of this many polygons
  std::uint64_t seed = 1;        ///< of the random choice of candidates
  std::optional<std::vector<std::uint32_t>> pieces = {};  ///< build of these pieces only, in this order
  std::vector<Plane> first = {}; ///< planes of the topmost nodes on every way from the root, in this order: a near plane, say
  int threads = 0;               ///< 0: as many as there are processors; the tree is the same for any number
  std::function<void(std::size_t done, std::size_t all)> progress = {};  ///< polygons settled, of the pieces given; called from any thread
};

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
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(static_cast<unsigned __int128>((*this)()) * n >> 64); }
};

template <Partition_traits Traits>
class Builder {
 public:
  using Polygon = Convex_polygon<Traits>;
  using Polygons = std::vector<Polygon>;
  using Tree = Bsp_tree<Traits>;

  Builder(const Traits& traits, const Bsp_options& options) : traits_(traits), options_(options) { options_.sample = std::max(1u, options_.sample); }

  Tree build() {
    Tree tree;
    Branch* root = nullptr;
    std::optional<tbb::global_control> more;  // threads than processors
    if (options_.threads > tbb::info::default_concurrency()) more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options_.threads));
    tbb::task_arena arena(options_.threads > 0 ? options_.threads : tbb::task_arena::automatic);
    arena.execute([&] {
      tbb::task_group group;
      Job job{input(), &root, options_.seed, 1};
      group.run_and_wait([&] { work(std::move(job), group); });
    });
    flatten(root, tree);
    return tree;
  }

 private:
  /// A node while the tree grows.
  struct Branch {
    Plane plane;
    Branch* front = nullptr;
    Branch* behind = nullptr;
    std::span<Polygon> on;
  };
  /// A set of polygons in one cell, and where the node made of them goes.
  struct Job {
    Polygons polygons;
    Branch** place;
    std::uint64_t seed;
    std::uint64_t depth;
  };
  /// What each thread keeps for itself until the end.
  struct Workspace {
    Polygon_store<Traits> store;
    Split_scratch<Traits> scratch;
    std::deque<Branch> branches;
    Bsp_counters counters;
    std::vector<Polygons> spare;  // lists to use again
    Polygons on;

    Polygons list() {
      if (spare.empty()) return {};
      Polygons taken = std::move(spare.back());
      spare.pop_back();
      return taken;
    }
    void give_back(Polygons&& taken) {
      taken.clear();
      if (taken.capacity() <= worth_a_task) spare.push_back(std::move(taken));
    }
  };
  struct Score {
    std::array<std::size_t, 4> at{};  // by Position
    std::size_t of(Position p) const { return at[static_cast<std::size_t>(p)]; }
    std::size_t front_most() const { return of(Position::in_front) + of(Position::across); }
    std::size_t behind_most() const { return of(Position::behind) + of(Position::across); }
    std::size_t all() const { return at[0] + at[1] + at[2] + at[3]; }
  };

  static constexpr std::size_t worth_a_task = 1024;  // polygons; below, starting a task costs more than it gives
  static constexpr std::size_t worth_balance = 24;   // polygons; below, a chain of face planes is no deeper than free planes would be

  Polygons input() {
    Polygons polygons;
    Workspace& mine = workspaces_.local();
    polygons.reserve(options_.pieces ? options_.pieces->size() : traits_.piece_count());
    if (options_.pieces) {
      for (const std::uint32_t i : *options_.pieces) polygons.push_back(mine.store.piece(traits_, i));
    } else {
      for (std::uint32_t i = 0; i < traits_.piece_count(); ++i) polygons.push_back(mine.store.piece(traits_, i));
    }
    mine.counters.pieces = polygons.size();
    all_ = polygons.size();
    return polygons;
  }

  /// Settles a job and all that follows from it. Large cells become tasks of their own, the rest an explicit stack.
  void work(Job first, tbb::task_group& group) {
    Workspace& mine = workspaces_.local();
    std::vector<Job> stack;
    if (!first.polygons.empty()) stack.push_back(std::move(first));
    while (!stack.empty()) {
      Job job = std::move(stack.back());
      stack.pop_back();
      std::array<Job, 2> parts = divide(std::move(job), mine);
      for (Job& part : parts) {
        if (part.polygons.empty()) {
          mine.give_back(std::move(part.polygons));
          continue;
        }
        if (part.polygons.size() < worth_a_task || options_.threads == 1) stack.push_back(std::move(part));
        else group.run([this, &group, p = std::make_shared<Job>(std::move(part))] { work(std::move(*p), group); });
      }
    }
  }

  /// Makes the node of a job and returns what is behind its plane and what is in front.
  std::array<Job, 2> divide(Job job, Workspace& mine) {
    Random random{job.seed};
    Branch& branch = mine.branches.emplace_back();
    *job.place = &branch;
    mine.counters.depth = std::max(mine.counters.depth, job.depth);
    std::array<Job, 2> parts{Job{mine.list(), &branch.behind, random(), job.depth + 1}, Job{mine.list(), &branch.front, random(), job.depth + 1}};
    const auto [plane, root] = job.depth <= options_.first.size() ? std::pair(options_.first[job.depth - 1], no_root) : choose(job.polygons, random, mine);
    branch.plane = plane;
    if (root == no_root && job.depth > options_.first.size()) ++mine.counters.free_planes;
    partition(job.polygons, plane, root, branch, parts, mine);
    settled(branch.on.size());
    mine.give_back(std::move(job.polygons));
    return parts;
  }

  static constexpr std::size_t no_root = ~std::size_t{0};

  /// The plane for a cell, and the polygon it is taken from (no_root for a free plane).
  std::pair<Plane, std::size_t> choose(const Polygons& polygons, Random& random, Workspace& mine) {
    const std::size_t n = polygons.size();
    const auto plane_of = [&](std::size_t i) { return polygons[i].support; };
    if (n == 1) return {plane_of(0), 0};
    const std::size_t tries = std::min<std::size_t>(n, std::max(1u, options_.candidates));
    std::size_t best = no_root, best_cost = ~std::size_t{0};
    bool balanced = false;
    for (std::size_t t = 0; t < tries; ++t) {
      const std::size_t i = tries == n ? t : random.below(n);
      const Score score = score_of(polygons, plane_of(i), random, mine);
      balanced |= is_balanced(score);
      if (const std::size_t c = cost(score); c < best_cost) best = i, best_cost = c;
    }
    if (!balanced && n >= worth_balance) {
      if (const std::optional<Plane> plane = free_plane(polygons, best_cost, random, mine)) return {*plane, no_root};
    }
    return {plane_of(best), best};
  }

  std::size_t cost(const Score& s) const {
    const std::size_t front = s.of(Position::in_front), behind = s.of(Position::behind);
    return (front > behind ? front - behind : behind - front) + options_.split_weight * s.of(Position::across);
  }
  /// At most eleven twelfths of the polygons strictly on one side.
  static bool is_balanced(const Score& s) { return 12 * s.of(Position::in_front) <= 11 * s.all() && 12 * s.of(Position::behind) <= 11 * s.all(); }

  Score score_of(const Polygons& polygons, Plane plane, Random& random, Workspace& mine) {
    const auto cutter = traits_.prepare(plane);
    Score score;
    const auto count = [&](const Polygon& polygon) {
      const bool on = is_on(polygon, plane, mine);
      ++score.at[static_cast<std::size_t>(on ? Position::on : position(traits_, polygon, cutter, mine.counters.predicates))];
    };
    if (polygons.size() <= options_.sample) {
      for (const Polygon& polygon : polygons) count(polygon);
    } else {
      // One from each of `sample` equal stretches.
      const std::size_t n = polygons.size();
      for (std::size_t k = 0; k < options_.sample; ++k) {
        const std::size_t begin = k * n / options_.sample, end = (k + 1) * n / options_.sample;
        count(polygons[begin + random.below(end - begin)]);
      }
    }
    return score;
  }

  /// Whether a polygon is known to lie on the plane without looking at its corners.
  bool is_on(const Polygon& polygon, Plane plane, Workspace& mine) {
    ++mine.counters.polygon_tests;
    if (!traits_.same_plane(polygon.support, plane)) return false;
    ++mine.counters.predicates.combinatorial;
    return true;
  }

  /// The best axis plane through a median corner of the sample, if it balances and costs less than the best face plane (convex bodies: n).
  std::optional<Plane> free_plane(const Polygons& polygons, std::size_t best_cost, Random& random, Workspace& mine) {
    std::optional<Plane> best;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::pair<double, const typename Traits::Vertex*>> corners;
      const std::size_t step = std::max<std::size_t>(1, polygons.size() / (4 * options_.sample));
      for (std::size_t i = 0; i < polygons.size(); i += step)
        for (const Corner<Traits>& corner : polygons[i])
          if (traits_.axis_plane(axis, *corner.vertex)) corners.emplace_back(traits_.coordinate(*corner.vertex, axis), corner.vertex);
      if (corners.empty()) continue;
      const auto middle = corners.begin() + static_cast<std::ptrdiff_t>(corners.size() / 2);
      std::nth_element(corners.begin(), middle, corners.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      const Plane plane = *traits_.axis_plane(axis, *middle->second);
      const Score score = score_of(polygons, plane, random, mine);
      // Both sides must shrink to three quarters, or cutting would go on without an end.
      if (4 * score.front_most() > 3 * score.all() || 4 * score.behind_most() > 3 * score.all()) continue;
      if (const std::size_t c = cost(score); c < best_cost) best = plane, best_cost = c;
    }
    return best;
  }

  void partition(const Polygons& polygons, Plane plane, std::size_t root, Branch& branch, std::array<Job, 2>& parts, Workspace& mine) {
    const auto cutter = traits_.prepare(plane);
    const auto put = [&](Polygons& list, const Polygon& polygon) {
      if (polygon.size >= 3) list.push_back(polygon);
      else ++mine.counters.degenerate;
    };
    mine.on.clear();
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      const Polygon& polygon = polygons[i];
      const bool on = i == root || is_on(polygon, plane, mine);
      switch (on ? Position::on : classify(traits_, polygon, cutter, mine.scratch, mine.counters.predicates)) {
        case Position::on: mine.on.push_back(polygon); break;
        case Position::behind: parts[0].polygons.push_back(polygon); break;
        case Position::in_front: parts[1].polygons.push_back(polygon); break;
        case Position::across: {
          ++mine.counters.splits;
          const std::array<Polygon, 2> halves = split(traits_, polygon, cutter, mine.scratch, mine.store);
          put(parts[0].polygons, halves[0]), put(parts[1].polygons, halves[1]);
        }
      }
    }
    branch.on = mine.store.list(std::span<const Polygon>(mine.on));
  }

  void settled(std::size_t fragments) {
    if (!options_.progress || fragments == 0) return;
    options_.progress(settled_.fetch_add(fragments) + fragments, all_);
  }

  /// Numbers nodes and fragments in preorder and moves all memory to the tree.
  void flatten(Branch* root, Tree& tree) {
    std::vector<std::uint32_t> fragments_of;  // by face
    std::vector<std::pair<const Branch*, std::int32_t>> stack;  // and the place in the tree that waits for its number: 2 node + side
    if (root != nullptr) stack.emplace_back(root, -1);
    while (!stack.empty()) {
      const auto [branch, place] = stack.back();
      stack.pop_back();
      const std::int32_t number = static_cast<std::int32_t>(tree.nodes.size());
      if (place >= 0) (place % 2 == 0 ? tree.nodes[static_cast<std::size_t>(place / 2)].front : tree.nodes[static_cast<std::size_t>(place / 2)].behind) = number;
      tree.nodes.push_back({branch->plane, Tree::leaf, Tree::leaf, static_cast<std::uint32_t>(tree.fragments.size()), static_cast<std::uint32_t>(branch->on.size())});
      for (const Polygon& polygon : branch->on) {
        const std::uint32_t face = traits_.face(polygon.piece);
        if (face >= fragments_of.size()) fragments_of.resize(face + 1);
        const bool same = traits_.same_sense(polygon.support, branch->plane);
        tree.fragments.push_back({polygon, same, fragments_of[face]++});
      }
      if (branch->behind != nullptr) stack.emplace_back(branch->behind, 2 * number + 1);
      if (branch->front != nullptr) stack.emplace_back(branch->front, 2 * number);
    }
    for (Workspace& workspace : workspaces_) {
      const Bsp_counters& c = workspace.counters;
      tree.counters.pieces += c.pieces, tree.counters.splits += c.splits, tree.counters.free_planes += c.free_planes;
      tree.counters.degenerate += c.degenerate, tree.counters.polygon_tests += c.polygon_tests;
      tree.counters.depth = std::max(tree.counters.depth, c.depth);
      tree.counters.predicates += c.predicates;
      tree.memory.push_back(std::move(workspace.store));
    }
    tree.counters.nodes = tree.nodes.size(), tree.counters.fragments = tree.fragments.size();
  }

  const Traits& traits_;
  Bsp_options options_;
  tbb::enumerable_thread_specific<Workspace> workspaces_;
  std::atomic<std::size_t> settled_{0};
  std::size_t all_ = 0;
};

}  // namespace bsp_detail

/// A BSP tree of all pieces of the scene: every piece, or each part of it, lies on the plane of a node. The plane of each node is the best of
/// `candidates` random face planes by splits and balance, or, where none balances, an axis plane through an input vertex.
/// Degenerate: coplanar pieces share a node, with their sense; a piece that touches a plane is not split. Cost: expected O(n log n) tests where
/// splits are few. Memory: the fragments and what they were cut from. Exact: as the traits are; the tree ends for any traits.
/// Source: Fuchs, Kedem, Naylor 1980; lecture slides "Visibility Computation"; Naylor, "Visibility Orderings". Proof: P-06
template <Partition_traits Traits>
Bsp_tree<Traits> build_bsp(const Traits& traits, const Bsp_options& options = {}) {
  return bsp_detail::Builder<Traits>(traits, options).build();
}

}  // namespace sightline
