#pragma once
// A tree of boxes around the pieces of a scene: what lies wholly behind something, or outside of a field of view, is never looked at piece by piece.

#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <cmath>

namespace sightline {

/// Boxes in the grid's approximate coordinates, rounded outwards, halved at the median of their longest side. It serves any number of eyes.
/// Cost: O(n log n). Exact: no, conservative; nothing is decided by a box but that all in it is away.
class Piece_boxes {
 public:
  struct Box {
    std::array<double, 3> low, high;
  };
  struct Node {
    Box box;
    std::uint32_t first, count;  ///< places in pieces()
    std::uint32_t second;        ///< the second child; the first is the next node; 0: a leaf
  };
  static constexpr std::uint32_t leaf_size = 4;

  explicit Piece_boxes(const Scene& scene) : pieces_(scene.pieces().size()) {
    const Grid_points& points = scene.points();
    const double error = points.bits() <= 53 ? 0 : 0x1p-50 * points.range() + 0x1p-1000;
    std::vector<Box> boxes(pieces_.size());
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      pieces_[i] = i;
      Box& box = boxes[i];
      box.low.fill(std::numeric_limits<double>::infinity()), box.high.fill(-std::numeric_limits<double>::infinity());
      for (const Piece_corner& corner : scene.corners(scene.pieces()[i]))
        for (int k = 0; k < 3; ++k) {
          const double x = points.approximate(corner.point, k);
          double &low = box.low[static_cast<std::size_t>(k)], &high = box.high[static_cast<std::size_t>(k)];
          low = std::min(low, x - error), high = std::max(high, x + error);
        }
    }
    if (!pieces_.empty()) build(boxes, 0, static_cast<std::uint32_t>(pieces_.size()));
  }

  std::span<const Node> nodes() const { return nodes_; }  ///< the root first; none for an empty scene
  std::span<const std::uint32_t> pieces(const Node& node) const { return {pieces_.data() + node.first, node.count}; }

  /// Whether all of a box is strictly behind a plane, for certain.
  static bool is_behind(const Box& box, const Prepared_plane& h) {
    const std::array<double, 3> n{h.a, h.b, h.c};
    double value = h.d;
    for (std::size_t k = 0; k < 3; ++k) value += n[k] * (n[k] > 0 ? box.high[k] : box.low[k]);
    return value < -2 * h.bound;
  }
  /// Whether all of a box is strictly behind a plane through the eye, for certain. `size`: of its normal; each entry is within `error`.
  static bool is_behind(const Box& box, const std::array<double, 3>& n, double size, double error, const Located_point& eye) {
    const std::array<double, 3> e{eye.ax, eye.ay, eye.az};
    double value = 0, reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = (n[k] > 0 ? box.high[k] : box.low[k]) - e[k];
      value += n[k] * x;
      reach = std::max({reach, std::fabs(x), std::fabs(e[k])});
    }
    return value < -(reach * (error + 0x1p-49 * size) + 2 * size * eye.error + 0x1p-1000 * (1 + size));
  }
  /// At most the distance from the eye, but for rounding by a relative 2^-50 and errors of the eye.
  static double distance(const Box& box, const Located_point& eye) {
    const std::array<double, 3> e{eye.ax, eye.ay, eye.az};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = std::max({box.low[k] - e[k], e[k] - box.high[k], 0.0});
      sum += x * x;
    }
    return std::sqrt(sum);
  }

 private:
  std::uint32_t build(const std::vector<Box>& boxes, std::uint32_t first, std::uint32_t count) {
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    Box all = boxes[pieces_[first]];
    for (std::uint32_t i = first; i < first + count; ++i)
      for (std::size_t k = 0; k < 3; ++k) all.low[k] = std::min(all.low[k], boxes[pieces_[i]].low[k]), all.high[k] = std::max(all.high[k], boxes[pieces_[i]].high[k]);
    nodes_.push_back({all, first, count, 0});
    if (count <= leaf_size) return at;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (all.high[k] - all.low[k] > all.high[axis] - all.low[axis]) axis = k;
    const std::uint32_t half = count / 2;
    const auto begin = pieces_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t i, std::uint32_t j) {
      const double x = boxes[i].low[axis] + boxes[i].high[axis], y = boxes[j].low[axis] + boxes[j].high[axis];
      return x < y || (x == y && i < j);
    });
    build(boxes, first, half);
    nodes_[at].second = build(boxes, first + half, count - half);
    return at;
  }

  std::vector<std::uint32_t> pieces_;
  std::vector<Node> nodes_;
};

}  // namespace sightline
