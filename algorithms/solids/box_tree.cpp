#include <sightline/algorithms/solids/box_tree.h>

#include <sightline/kernel/threads.h>

#include <algorithm>
#include <numeric>

namespace sightline {

namespace {

/// How many nodes a tree over so many pieces has, if it halves them down to leaves of at most so many.
std::uint32_t nodes_over(std::uint32_t pieces, std::uint32_t leaf_size) {
  if (pieces <= leaf_size) return 1;
  const std::uint32_t left = pieces / 2;
  return 1 + nodes_over(left, leaf_size) + nodes_over(pieces - left, leaf_size);
}

}  // namespace

Box_tree::Box_tree(const Operands& operands) : order_(operands.pieces().size()) {
  if (order_.empty()) return;
  // 1. Boxes.
  std::vector<Box> boxes(order_.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    Box& box = boxes[i];
    bool first = true;
    for (const Piece_corner& corner : operands.corners(i)) {
      for (int k = 0; k < 3; ++k) {
        const double x = operands.points().approximate(corner.point, k);
        const auto at = static_cast<std::size_t>(k);
        box.low[at] = first ? x : std::min(box.low[at], x);
        box.high[at] = first ? x : std::max(box.high[at], x);
      }
      first = false;
    }
  }
  // 2. The tree over them.
  std::iota(order_.begin(), order_.end(), 0u);
  boxes_ = std::move(boxes);
  const auto count = static_cast<std::uint32_t>(order_.size());
  nodes_.resize(nodes_over(count, leaf_size));
  build(0, 0, count);
  std::vector<Box> in_order(count);
  for (std::uint32_t i = 0; i < count; ++i) in_order[i] = boxes_[order_[i]];
  boxes_ = std::move(in_order);
  for (std::uint32_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].right == 0) leaves_.push_back(i);
  std::sort(leaves_.begin(), leaves_.end(),
            [&](std::uint32_t a, std::uint32_t b) { return nodes_[a].first < nodes_[b].first; });
}

void Box_tree::build(std::uint32_t at, std::uint32_t first, std::uint32_t last) {
  Node& node = nodes_[at];
  node.first = first;
  node.last = last;
  node.right = 0;
  // 1. Its box, and that of the boxes' centres.
  node.box = boxes_[order_[first]];
  std::array<double, 3> low{}, high{};
  for (std::uint32_t i = first; i < last; ++i) {
    const Box& box = boxes_[order_[i]];
    for (std::size_t k = 0; k < 3; ++k) {
      node.box.low[k] = std::min(node.box.low[k], box.low[k]);
      node.box.high[k] = std::max(node.box.high[k], box.high[k]);
      const double centre = box.low[k] + box.high[k];
      low[k] = i == first ? centre : std::min(low[k], centre);
      high[k] = i == first ? centre : std::max(high[k], centre);
    }
  }
  if (last - first <= leaf_size) return;
  // 2. Halves along the longest axis.
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = boxes_[a].low[axis] + boxes_[a].high[axis];
                     const double y = boxes_[b].low[axis] + boxes_[b].high[axis];
                     return x != y ? x < y : a < b;
                   });
  node.right = at + 1 + nodes_over(middle - first, leaf_size);
  if (last - first < 4096) {
    build(at + 1, first, middle);
    build(node.right, middle, last);
  } else {
    parallel_invoke([&] { build(at + 1, first, middle); }, [&, right = node.right] { build(right, middle, last); });
  }
}

}  // namespace sightline
