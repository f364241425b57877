#pragma once
// A hierarchy of boxes for rays: four children a node, side by side, in floats that are rounded outwards.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

/// Boxes around boxes, by the surface area heuristic. All that a ray meets is in boxes that it visits: these are wider
/// on all sides than anything that is rounded on the way to them. Cost: O(n log n), in parallel; the same for any
/// number of threads. Exact: no, conservative. Proof: P-95
class Ray_boxes {
 public:
  struct Box {
    std::array<double, 3> low, high;
  };

  Ray_boxes() = default;
  /// Pre: coordinates from -1 to 1. Errors: std::length_error for 2^28 boxes or more.
  explicit Ray_boxes(std::span<const Box> boxes);

  /// The boxes given, in the order of the leaves.
  const std::vector<std::uint32_t>& order() const { return order_; }

  /// A ray in doubles: each coordinate of its origin is within `error`, and at most 16 in size; the
  /// direction's greatest is 1 or -1, and each is within a relative 2^-40, with its own sign.
  struct Ray {
    std::array<double, 3> origin, direction;
    double error;
  };

  /// Calls leaf(first, count) for places in order(), near boxes first, as long as a box may hold points of the ray at
  /// t <= limit(), in units of the direction. Returns the number of nodes opened.
  template <class Leaf, class Limit>
  std::size_t visit(const Ray& ray, Leaf leaf, Limit limit) const;

 private:
  using Four [[gnu::vector_size(16)]] = float;
  using Mask [[gnu::vector_size(16)]] = std::int32_t;
  /// Bit i: whether element i is not 0.
  static unsigned signs(Mask mask) {
#ifdef __SSE__
    return static_cast<unsigned>(__builtin_ia32_movmskps(std::bit_cast<Four>(mask)));
#else
    return (mask[0] != 0 ? 1u : 0u) | (mask[1] != 0 ? 2u : 0u) | (mask[2] != 0 ? 4u : 0u) | (mask[3] != 0 ? 8u : 0u);
#endif
  }
  struct alignas(64) Node {
    std::array<Four, 6> sides;  ///< low x, y, z, high x, y, z, of four boxes each; empty ones are inside out
    std::array<std::uint32_t, 4> child;
  };
  /// Children that are leaves: this bit, the number of things less one, and the first.
  static constexpr std::uint32_t leaf_bit = 0x80000000u, count_shift = 28, first_mask = 0x0FFFFFFFu;
  static constexpr std::uint32_t leaf_size = 4;
  struct Builder;

  std::vector<Node> nodes_;  // the root first; none where there is nothing
  std::vector<std::uint32_t> order_;
};

template <class Leaf, class Limit>
std::size_t Ray_boxes::visit(const Ray& ray, Leaf leaf, Limit limit) const {
  if (nodes_.empty()) return 0;
  // 1. Of each axis the side of boxes where the ray enters and where it leaves, the origin's bound on the safe side of
  // it, and one over the direction, at most 2^100: a slack is then longer than any way in the scene. P-95
  std::array<std::size_t, 3> enter, leave;
  std::array<Four, 3> enter_from, leave_from, inverse;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool back = ray.direction[k] < 0;
    enter[k] = back ? k + 3 : k;
    leave[k] = back ? k : k + 3;
    const auto low = static_cast<float>(ray.origin[k] - ray.error),
               high = static_cast<float>(ray.origin[k] + ray.error);
    const float size = static_cast<float>(back ? -ray.direction[k] : ray.direction[k]);
    const float over = size > 0x1p-100f ? 1 / size : 0x1p100f;
    const float enters = back ? low : high, leaves = back ? high : low, factor = back ? -over : over;
    enter_from[k] = Four{enters, enters, enters, enters};
    leave_from[k] = Four{leaves, leaves, leaves, leaves};
    inverse[k] = Four{factor, factor, factor, factor};
  }

  // 2. Nodes whose boxes it enters before it leaves them, before the limit.
  struct Entry {
    std::uint32_t child;
    float near;
  };
  std::array<Entry, 256> stack;  // of 4 children 3 wait, on each of at most 64 levels: Builder halves from there on
  std::size_t size = 0, opened = 0;
  stack[size++] = {0, 0};
  constexpr float wider = 1 + 0x1p-18f;
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.near > limit() * wider) continue;
    if ((entry.child & leaf_bit) != 0) {
      leaf(entry.child & first_mask, ((entry.child & ~leaf_bit) >> count_shift) + 1);
      continue;
    }
    ++opened;
    const Node& node = nodes_[entry.child];
    Four near{}, far = (node.sides[leave[0]] - leave_from[0]) * inverse[0];
    for (std::size_t k = 0; k < 3; ++k) {
      const Four in = (node.sides[enter[k]] - enter_from[k]) * inverse[k];
      near = in > near ? in : near;
      const Four out = (node.sides[leave[k]] - leave_from[k]) * inverse[k];
      far = out < far ? out : far;
    }
    const std::size_t begin = size;
    for (unsigned hits = signs(near <= far * wider); hits != 0; hits &= hits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(hits));
      // The nearest is to be on top.
      std::size_t at = size++;
      for (; at > begin && stack[at - 1].near < near[i]; --at) stack[at] = stack[at - 1];
      stack[at] = {node.child[i], near[i]};
      if ((node.child[i] & leaf_bit) == 0) {
        __builtin_prefetch(&nodes_[node.child[i]]);
        __builtin_prefetch(&nodes_[node.child[i]].sides[4]);
      }
    }
  }
  return opened;
}

}  // namespace sightline
