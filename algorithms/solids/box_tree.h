#pragma once
// A tree of boxes over the pieces of all operands: which boxes meet, and which a line along an axis meets.

#include <sightline/algorithms/solids/operands.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
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
  /// Pieces in the order of the leaves: what pairs are told in.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// Calls visit(i, j, met) with places in order(), so that each pair of different pieces whose boxes meet, one of them
  /// in the leaf and the other in it or in a later one, comes once: of place i with j + k for each bit k of `met`.
  /// Thread-safe. Cost: O(log n + pairs) if boxes are small.
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
    std::uint32_t leaf;         // its place in leaves_, if it is one
  };
  /// The boxes of a leaf, axis by axis, so that one box is compared with all of them.
  struct Leaf_boxes {
    alignas(16) std::array<std::array<double, leaf_size>, 3> low{}, high{};
    unsigned in_use = 0;  // bit k: whether there is a box k

    Box operator[](std::size_t place) const {
      Box box;
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = low[k][place];
        box.high[k] = high[k][place];
      }
      return box;
    }
    /// Bit k: whether the box meets box k.
    unsigned meeting(const Box& box) const {
      unsigned apart = 0;
#if defined(__GNUC__)  // two at once, which compilers do not make of the loop below
      using Two = double __attribute__((vector_size(16)));
      using Two_masks = std::int64_t __attribute__((vector_size(16)));  // all bits, or none
      Two_masks masks{};
      for (std::size_t place = 0; place < leaf_size; place += 2) {
        Two_masks is_apart{};
        for (std::size_t k = 0; k < 3; ++k) {
          Two own_low, own_high;
          std::memcpy(&own_low, &low[k][place], sizeof own_low);
          std::memcpy(&own_high, &high[k][place], sizeof own_high);
          const Two box_low{box.low[k], box.low[k]}, box_high{box.high[k], box.high[k]};
          is_apart |= (own_low > box_high) | (box_low > own_high);
        }
        masks |= is_apart & Two_masks{std::int64_t{1} << place, std::int64_t{2} << place};
      }
      apart = static_cast<unsigned>(masks[0] | masks[1]);
#else
      for (std::size_t place = 0; place < leaf_size; ++place)
        for (std::size_t k = 0; k < 3; ++k)
          apart |= unsigned{(low[k][place] > box.high[k]) | (box.low[k] > high[k][place])} << place;
#endif
      return ~apart & in_use;
    }
  };
  /// A piece as it is sorted: twice the centre of its box.
  struct Centre {
    std::array<double, 3> at;
    std::uint32_t piece;
  };
  void build(std::uint32_t node, std::vector<Centre>& centres, std::vector<Centre>& room, std::uint32_t first,
             std::uint32_t last);
  static void halve(std::span<Centre> centres, std::span<Centre> room, std::size_t axis, double low, double high);

  std::vector<Box> boxes_;  // by piece, while the tree is made
  std::vector<Leaf_boxes> leaf_boxes_;
  std::vector<std::uint32_t> order_;  // pieces
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaves_;  // nodes
};

template <class Visit>
void Box_tree::for_each_pair(std::size_t leaf, Visit visit) const {
  // 1. Pairs in the leaf.
  const Node& own = nodes_[leaves_[leaf]];
  const Leaf_boxes& boxes = leaf_boxes_[leaf];
  for (std::uint32_t i = own.first; i < own.last; ++i)
    if (const unsigned met = boxes.meeting(boxes[i - own.first]) & (~1u << (i - own.first)); met != 0)
      visit(i, own.first, met);
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
    const Leaf_boxes& others = leaf_boxes_[node.leaf];
    for (unsigned near = boxes.meeting(node.box); near != 0; near &= near - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(near));
      if (const unsigned met = others.meeting(boxes[i]); met != 0) visit(own.first + i, node.first, met);
    }
  }
}

template <class Visit>
void Box_tree::for_each_along(const std::array<double, 3>& from, std::size_t axis, bool upwards, Visit visit) const {
  Box way{from, from};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  (upwards ? way.high : way.low)[axis] = upwards ? infinity : -infinity;
  std::uint32_t stack[64];
  std::size_t size = 0;
  if (!nodes_.empty()) stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    if (!node.box.meets(way)) continue;
    if (node.right != 0) {
      stack[size++] = node.right;
      stack[size++] = at + 1;
      continue;
    }
    for (unsigned met = leaf_boxes_[node.leaf].meeting(way); met != 0; met &= met - 1)
      visit(order_[node.first + static_cast<std::uint32_t>(std::countr_zero(met))]);
  }
}

}  // namespace sightline
