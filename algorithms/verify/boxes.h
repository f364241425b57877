#pragma once
// Boxes about polygons in doubles, rounded outwards: which of them a segment comes near.

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
  bool meets(const Outward_box& other) const;
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

 private:
  /// Of the boxes order_[begin .. end); its halves are the next one and `other`, or none.
  struct Node {
    Outward_box box;
    std::uint32_t begin, end, other;
  };

  void add(std::uint32_t begin, std::uint32_t end);
  void find(const Outward_box& part, std::vector<std::size_t>& found) const;

  std::vector<Outward_box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace sightline::certificate_check
