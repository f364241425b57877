#include <sightline/algorithms/solids/box_tree.h>

#include <sightline/kernel/threads.h>

#include <algorithm>

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
  const auto count = static_cast<std::uint32_t>(order_.size());
  std::vector<Centre> centres(count), room(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) centres[i].at[k] = boxes[i].low[k] + boxes[i].high[k];
    centres[i].piece = i;
  }
  boxes_ = std::move(boxes);
  nodes_.resize(nodes_over(count, leaf_size));
  build(0, centres, room, 0, count);
  for (std::uint32_t i = 0; i < count; ++i) order_[i] = centres[i].piece;
  // 3. Its leaves, which come in the order of their pieces.
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    if (node.right != 0) continue;
    node.leaf = static_cast<std::uint32_t>(leaves_.size());
    leaves_.push_back(n);
    Leaf_boxes& leaf = leaf_boxes_.emplace_back();
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      const std::uint32_t place = i - node.first;
      leaf.in_use |= 1u << place;
      for (std::size_t k = 0; k < 3; ++k) {
        leaf.low[k][place] = boxes_[order_[i]].low[k];
        leaf.high[k][place] = boxes_[order_[i]].high[k];
      }
    }
  }
  boxes_ = {};
}

/// Brings the middle one along an axis to its place, lesser ones before it and greater ones behind. As many steps as
/// centres, without a branch that no processor can predict: by counting those in stretches between `low` and `high`.
void Box_tree::halve(std::span<Centre> centres, std::span<Centre> room, std::size_t axis, double low, double high) {
  constexpr std::size_t few = 48;
  constexpr std::uint32_t stretches = 128;
  const std::size_t middle = centres.size() / 2;
  const auto select = [&](std::size_t first, std::size_t last) {
    const auto begin = centres.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(last), [axis](const Centre& a, const Centre& b) {
                       return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.piece < b.piece;
                     });
  };
  const double scale = stretches / (high - low);
  if (centres.size() <= few || !(scale > 0 && scale < 0x1p1000)) return select(0, centres.size());
  // 1. How many are in each stretch: it rises with the coordinate, also where it is rounded.
  const auto stretch = [&](const Centre& c) {
    return std::min(stretches - 1, static_cast<std::uint32_t>(static_cast<std::int32_t>((c.at[axis] - low) * scale)));
  };
  std::array<std::uint32_t, stretches> count{};
  for (const Centre& c : centres) ++count[stretch(c)];
  std::size_t before = 0, of_middle = 0;
  while (before + count[of_middle] <= middle) before += count[of_middle++];
  // 2. Those before the middle one's stretch, in it, and behind it.
  std::array<std::size_t, 3> next{0, before, before + count[of_middle]};
  for (const Centre& c : centres) {
    const std::uint32_t s = stretch(c);
    room[next[static_cast<std::size_t>(s >= of_middle) + static_cast<std::size_t>(s > of_middle)]++] = c;
  }
  std::copy(room.begin(), room.end(), centres.begin());
  select(before, before + count[of_middle]);
}

void Box_tree::build(std::uint32_t at, std::vector<Centre>& centres, std::vector<Centre>& room, std::uint32_t first,
                     std::uint32_t last) {
  Node& node = nodes_[at];
  node.first = first;
  node.last = last;
  node.right = 0;
  const auto widen = [&](const Box& box) {
    for (std::size_t k = 0; k < 3; ++k) {
      node.box.low[k] = std::min(node.box.low[k], box.low[k]);
      node.box.high[k] = std::max(node.box.high[k], box.high[k]);
    }
  };
  if (last - first <= leaf_size) {
    node.box = boxes_[centres[first].piece];
    for (std::uint32_t i = first; i < last; ++i) widen(boxes_[centres[i].piece]);
    return;
  }
  // 1. Halves along the axis on which the centres reach farthest.
  std::array<double, 3> low = centres[first].at, high = low;
  for (std::uint32_t i = first; i < last; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], centres[i].at[k]);
      high[k] = std::max(high[k], centres[i].at[k]);
    }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  const std::uint32_t middle = first + (last - first) / 2;
  const auto part_of = [&](std::vector<Centre>& all) { return std::span(all).subspan(first, last - first); };
  halve(part_of(centres), part_of(room), axis, low[axis], high[axis]);
  node.right = at + 1 + nodes_over(middle - first, leaf_size);
  if (last - first < 4096) {
    build(at + 1, centres, room, first, middle);
    build(node.right, centres, room, middle, last);
  } else {
    parallel_invoke([&] { build(at + 1, centres, room, first, middle); },
                    [&, right = node.right] { build(right, centres, room, middle, last); });
  }
  // 2. The box of both.
  node.box = nodes_[at + 1].box;
  widen(nodes_[node.right].box);
}

}  // namespace sightline
