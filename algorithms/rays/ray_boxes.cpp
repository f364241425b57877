#include <sightline/algorithms/rays/ray_boxes.h>

#include <sightline/kernel/threads.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace sightline {

/// A binary tree by the surface area heuristic, of which nodes with four children are made.
struct Ray_boxes::Builder {
  struct Binary {
    Box box;
    std::uint32_t first, count;
    std::uint32_t second;  ///< child; the first one is the next node; 0: a leaf
  };
  std::span<const Box> boxes;
  std::vector<std::array<double, 3>> middle;
  std::vector<std::uint32_t>& order;
  std::vector<Binary> binary;

  static constexpr std::size_t bins = 16;
  static constexpr std::uint32_t worth_a_task = 4096;
  static constexpr std::uint32_t deepest = 40;  // from here on in halves, which is 28 levels more at most

  static Box nothing() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  }
  static void add(Box& box, const Box& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], other.low[k]);
      box.high[k] = std::max(box.high[k], other.high[k]);
    }
  }
  static double area(const Box& box) {
    const double x = box.high[0] - box.low[0], y = box.high[1] - box.low[1], z = box.high[2] - box.low[2];
    return x * y + y * z + z * x;
  }

  /// Where the things of a node are parted, which brings them into this order; 0: it is a leaf.
  std::uint32_t part(const Binary& node, std::uint32_t depth) {
    const auto begin = order.begin() + node.first, end = begin + node.count;
    if (node.count == 1) return 0;
    Box middles = nothing();
    for (auto i = begin; i != end; ++i) add(middles, {middle[*i], middle[*i]});
    double least = std::numeric_limits<double>::infinity();
    std::size_t best_axis = 3, best_bin = 0;
    const auto bin_of = [&](std::uint32_t thing, std::size_t k) {
      const double share = (middle[thing][k] - middles.low[k]) / (middles.high[k] - middles.low[k]);
      return std::min(bins - 1, static_cast<std::size_t>(share * bins));
    };
    for (std::size_t k = 0; depth < deepest && k < 3; ++k) {
      if (!(middles.low[k] < middles.high[k])) continue;
      std::array<Box, bins> box;
      std::array<std::uint32_t, bins> count{};
      box.fill(nothing());
      for (auto i = begin; i != end; ++i) {
        const std::size_t b = bin_of(*i, k);
        add(box[b], boxes[*i]);
        ++count[b];
      }
      std::array<double, bins> behind{};  // what bins from here on cost
      Box all = nothing();
      std::uint32_t things = 0;
      for (std::size_t b = bins; b-- > 1;) {
        add(all, box[b]);
        things += count[b];
        behind[b] = things == 0 ? 0 : area(all) * things;
      }
      all = nothing();
      things = 0;
      for (std::size_t b = 0; b + 1 < bins; ++b) {
        add(all, box[b]);
        things += count[b];
        if (things == 0 || things == node.count) continue;
        const double cost = area(all) * things + behind[b + 1];
        if (cost < least) {
          least = cost;
          best_axis = k;
          best_bin = b;
        }
      }
    }
    const double whole = area(node.box);
    if (node.count <= leaf_size && !(least + 0.5 * whole < whole * node.count)) return 0;
    if (best_axis < 3)
      return static_cast<std::uint32_t>(
          std::partition(begin, end, [&](std::uint32_t thing) { return bin_of(thing, best_axis) <= best_bin; }) -
          begin);
    return node.count / 2;  // all in one place, or too deep
  }

  /// Node `at`, below which there is room for 2 count - 1 nodes.
  void build(std::uint32_t at, std::uint32_t first, std::uint32_t count, std::uint32_t depth) {
    Binary node{nothing(), first, count, 0};
    for (std::uint32_t i = first; i < first + count; ++i) add(node.box, boxes[order[i]]);
    const std::uint32_t mine = part(node, depth);
    node.second = mine == 0 ? 0 : at + 2 * mine;
    binary[at] = node;
    if (mine == 0) return;
    const auto left = [&] { build(at + 1, first, mine, depth + 1); };
    const auto right = [&] { build(at + 2 * mine, first + mine, count - mine, depth + 1); };
    if (count >= worth_a_task) {
      parallel_invoke(left, right);
    } else {
      left();
      right();
    }
  }

  /// The four or fewer nodes that a node of four children has below it: the largest are opened.
  std::vector<std::uint32_t> children_of(std::uint32_t at) const {
    std::vector<std::uint32_t> all{at};
    while (all.size() < 4) {
      std::size_t largest = all.size();
      for (std::size_t i = 0; i < all.size(); ++i)
        if (binary[all[i]].second != 0 &&
            (largest == all.size() || area(binary[all[largest]].box) < area(binary[all[i]].box)))
          largest = i;
      if (largest == all.size()) break;
      const std::uint32_t opened = all[largest];
      all[largest] = opened + 1;
      all.push_back(binary[opened].second);
    }
    return all;
  }
};

Ray_boxes::Ray_boxes(std::span<const Box> boxes) {
  if (boxes.size() >= (std::size_t{1} << count_shift))
    throw std::length_error("rays: scenes of up to 2^28 pieces only");
  if (boxes.empty()) return;
  // 1. Two children a node.
  const auto count = static_cast<std::uint32_t>(boxes.size());
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0u);
  Builder builder{boxes, std::vector<std::array<double, 3>>(count), order_,
                  std::vector<Builder::Binary>(2 * count - 1)};
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) builder.middle[i][k] = 0.5 * boxes[i].low[k] + 0.5 * boxes[i].high[k];
  builder.build(0, 0, count, 0);

  // 2. Four of them, in floats, wider by more than what rounding an origin and a side takes. P-95
  const float slack = 0x1p-18f;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  struct Waiting {
    std::uint32_t binary, parent, child;
  };
  std::vector<Waiting> waiting{{0, 0, 0}};
  while (!waiting.empty()) {  // the first child next to its parent
    const Waiting next = waiting.back();
    waiting.pop_back();
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    if (at > 0) nodes_[next.parent].child[next.child] = at;
    Node& node = nodes_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      node.sides[k] = Four{infinity, infinity, infinity, infinity};
      node.sides[k + 3] = -node.sides[k];
    }
    node.child.fill(leaf_bit);
    const std::vector<std::uint32_t> children = builder.children_of(next.binary);
    for (std::uint32_t i = static_cast<std::uint32_t>(children.size()); i-- > 0;) {
      const Builder::Binary& child = builder.binary[children[i]];
      for (std::size_t k = 0; k < 3; ++k) {
        node.sides[k][i] = static_cast<float>(child.box.low[k]) - slack;
        node.sides[k + 3][i] = static_cast<float>(child.box.high[k]) + slack;
      }
      if (child.second == 0) node.child[i] = leaf_bit | (child.count - 1) << count_shift | child.first;
      else waiting.push_back({children[i], at, i});
    }
  }
}

}  // namespace sightline
