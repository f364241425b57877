#pragma once
// A tree of boxes over the pieces of all operands: which boxes meet, and which a line along an axis meets.

#include <sightline/algorithms/solids/operands.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

/// Boxes in approximate coordinates (Grid_points). These are the true ones, divided and rounded to the nearest double,
/// and rounding keeps the order: so closed boxes of pieces that meet do meet. Proof: P-110
class Box_tree {
 public:
  struct Box {
    std::array<double, 3> low, high;
    bool meets(const Box& other) const {
      unsigned apart = 0;  // without a branch for each of six, which no processor can predict
      for (std::size_t k = 0; k < 3; ++k) apart |= unsigned{low[k] > other.high[k]} | unsigned{other.low[k] > high[k]};
      return apart == 0;
    }
  };

  /// Cost: O(n log n), on the threads of run_with_threads().
  explicit Box_tree(const Operands& operands);

  /// Leaves, in which pieces that are near to each other stand together.
  std::size_t leaf_count() const { return leaves_.size(); }
  /// Calls visit(i, j) once for each pair of different pieces whose boxes meet, one of them in the leaf and the other
  /// in it or in a later one. Thread-safe. Cost: O(log n + pairs) if boxes are small.
  template <class Visit>
  void for_each_pair(std::size_t leaf, Visit visit) const;

  /// Whether a point is in the upper half of the tree's box along an axis. Pre: there are pieces.
  bool is_high(double at, std::size_t axis) const {
    return at > nodes_[0].box.low[axis] / 2 + nodes_[0].box.high[axis] / 2;
  }
  /// Calls visit(i) for each piece whose box meets the ray from `from` along an axis, upwards or downwards.
  /// Thread-safe.
  template <class Visit>
  void for_each_along(const std::array<double, 3>& from, std::size_t axis, bool upwards, Visit visit) const;

 private:
  static constexpr std::uint32_t leaf_size = 8;
  struct Node {
    Box box;
    std::uint32_t first, last;  // pieces order_[first, last)
    std::uint32_t right;        // its second child, the first being the next node; 0: a leaf
  };
  /// A piece as it is sorted: twice the centre of its box.
  struct Centre {
    std::array<double, 3> at;
    std::uint32_t piece;
  };
  void build(std::uint32_t node, std::vector<Centre>& centres, std::vector<Centre>& room, std::uint32_t first,
             std::uint32_t last);
  static void halve(std::span<Centre> centres, std::span<Centre> room, std::size_t axis, double low, double high);

  std::vector<Box> boxes_;            // by place in order_
  std::vector<std::uint32_t> order_;  // pieces
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaves_;  // nodes
};

template <class Visit>
void Box_tree::for_each_pair(std::size_t leaf, Visit visit) const {
  // 1. Pairs in the leaf.
  const Node& own = nodes_[leaves_[leaf]];
  for (std::uint32_t i = own.first; i < own.last; ++i)
    for (std::uint32_t j = i + 1; j < own.last; ++j)
      if (boxes_[i].meets(boxes_[j])) visit(order_[i], order_[j]);
  // 2. What is on the right of the way down to it has the later leaves; the least of them comes last on the stack.
  std::uint32_t stack[64];
  std::size_t size = 0;
  for (std::uint32_t at = 0; nodes_[at].right != 0;) {
    const std::uint32_t right = nodes_[at].right;
    if (nodes_[right].first <= own.first) {
      at = right;
    } else {
      stack[size++] = right;
      ++at;
    }
  }
  // 3. Pairs with these.
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    if (!node.box.meets(own.box)) continue;
    if (node.right != 0) {
      stack[size++] = node.right;
      stack[size++] = at + 1;
      continue;
    }
    for (std::uint32_t i = own.first; i < own.last; ++i) {
      if (!boxes_[i].meets(node.box)) continue;
      for (std::uint32_t j = node.first; j < node.last; ++j)
        if (boxes_[i].meets(boxes_[j])) visit(order_[i], order_[j]);
    }
  }
}

template <class Visit>
void Box_tree::for_each_along(const std::array<double, 3>& from, std::size_t axis, bool upwards, Visit visit) const {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto is_on_way = [&](const Box& box) {
    const unsigned within_u = unsigned{box.low[u] <= from[u]} & unsigned{from[u] <= box.high[u]};
    const unsigned within_v = unsigned{box.low[v] <= from[v]} & unsigned{from[v] <= box.high[v]};
    return (within_u & within_v) != 0 && (upwards ? from[axis] <= box.high[axis] : box.low[axis] <= from[axis]);
  };
  std::uint32_t stack[64];
  std::size_t size = 0;
  if (!nodes_.empty()) stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    if (!is_on_way(node.box)) continue;
    if (node.right != 0) {
      stack[size++] = node.right;
      stack[size++] = at + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i)
      if (is_on_way(boxes_[i])) visit(order_[i]);
  }
}

}  // namespace sightline
