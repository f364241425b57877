#pragma once
// Binary space partitioning trees: nodes, the fragments that lie on their planes, and what building one took.

#include <sightline/kernel/plane.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

/// What building a tree modelled, and what it cost.
struct Bsp_counters {
  std::uint64_t pieces = 0;                  ///< polygons given
  std::uint64_t splits = 0;                  ///< polygons cut in two
  std::uint64_t fragments = 0;               ///< polygons in the tree: pieces + splits, where arithmetic is exact
  std::uint64_t nodes = 0, free_planes = 0;  ///< inner nodes; those on an axis plane instead of a face's
  std::uint64_t depth = 0;                   ///< most nodes on a way from the root
  std::uint64_t degenerate = 0;  ///< fragments of fewer than three corners that an inexact model made; they are dropped
  std::uint64_t polygon_tests = 0;  ///< polygons tested against a plane, for choosing planes and for partitioning
  Predicate_counts predicates;
};

/// A polygon of the scene, or a part of one, on the plane of its node.
template <class Traits>
struct Fragment {
  Convex_polygon<Traits> polygon;
  bool same_sense;       ///< its front is the front of the node's plane
  std::uint32_t number;  ///< 0-based among the fragments of its face, in the order of the nodes
};

/// A BSP tree. Nodes are in preorder, front child first; the tree is empty for an empty scene.
template <class Traits>
struct Bsp_tree {
  static constexpr std::int32_t leaf = -1;
  struct Node {
    Plane plane;
    std::int32_t front = leaf, behind = leaf;  ///< children, or leaf
    std::uint32_t first = 0, count = 0;        ///< its fragments
  };

  std::vector<Node> nodes;
  std::vector<Fragment<Traits>> fragments;
  Bsp_counters counters;
  std::vector<Polygon_store<Traits>> memory;  ///< what the fragments point into

  std::span<const Fragment<Traits>> on(const Node& node) const { return {fragments.data() + node.first, node.count}; }
};

}  // namespace sightline
