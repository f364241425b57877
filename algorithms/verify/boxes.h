#pragma once
// Boxes about polygons in doubles, rounded outwards: which of them a segment comes near, and which meet each other.

#include <sightline/algorithms/verify/polygons.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sightline::certificate_check {

/// low <= x <= high for all coordinates x of what it holds; the ends may be infinite.
struct Outward_box {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  Outward_box() = default;  ///< holds nothing
  explicit Outward_box(const Polygon& points);
  bool meets(const Outward_box& other) const {
    int apart = 0;  // summed up without a branch: it is hard to foresee which boxes meet
    for (std::size_t k = 0; k < 3; ++k) {
      apart += high[k] < other.low[k];
      apart += low[k] > other.high[k];
    }
    return apart == 0;
  }
  void join(const Outward_box& other);
};

/// A tree of boxes, each the join of two halves.
class Boxes {
 public:
  /// Cost: O(n log n).
  explicit Boxes(const std::vector<Outward_box>& boxes);

  /// The places of all boxes that a segment meets, and of others near it, each once, in their order. Cost: about what
  /// is near the segment, times log n. Exact: none is left out. Proof: P-72b
  std::vector<std::size_t> near_segment(const Exact_point& from, const Exact_point& to) const;

  /// The join of all.
  Outward_box all() const { return nodes_.empty() ? Outward_box() : nodes_[0].box; }
  /// All places, those of boxes that are near each other together.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// Adds the places of all boxes that meet `part`, each once.
  void find(const Outward_box& part, std::vector<std::size_t>& found) const;
  /// Pairs are found leaf by leaf, of so many: calls visit(i, j) for all boxes i of a leaf, and j of the same or of
  /// later ones, that meet. Post: over all leaves each pair comes once.
  std::size_t leaves() const { return leaves_.size(); }
  template <class Visit>
  void for_each_pair(std::size_t leaf, const Visit& visit) const;

 private:
  /// Of the boxes of places order_[begin .. end). Halves come after it, all of the first one before the second; what
  /// comes after all of them is `next`. A leaf has none.
  struct Node {
    Outward_box box;
    std::uint32_t begin, end, next;
  };

  using Middle = std::array<double, 3>;  ///< of a box
  void add(const std::vector<Outward_box>& boxes, const std::vector<Middle>& middles, std::uint32_t begin,
           std::uint32_t end);

  std::vector<std::uint32_t> order_;
  std::vector<Outward_box> boxes_;  // in that order
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaves_;  // places of nodes
};

template <class Visit>
void Boxes::for_each_pair(std::size_t leaf, const Visit& visit) const {
  const std::uint32_t here = leaves_[leaf];
  const Node& mine = nodes_[here];
  for (std::uint32_t i = mine.begin; i < mine.end; ++i)
    for (std::uint32_t j = i + 1; j < mine.end; ++j)
      if (boxes_[i].meets(boxes_[j])) visit(order_[i], order_[j]);
  for (std::uint32_t at = here + 1; at < nodes_.size();) {
    const Node& node = nodes_[at];
    const bool is_leaf = node.next == at + 1;
    if (!node.box.meets(mine.box)) {
      at = node.next;
      continue;
    }
    ++at;
    if (!is_leaf) continue;
    for (std::uint32_t i = mine.begin; i < mine.end; ++i) {
      if (!boxes_[i].meets(node.box)) continue;
      for (std::uint32_t j = node.begin; j < node.end; ++j)
        if (boxes_[i].meets(boxes_[j])) visit(order_[i], order_[j]);
    }
  }
}

}  // namespace sightline::certificate_check
