#pragma once
// Whether a viewpoint is strictly in front of a face's plane, and how far it can move before that changes.

#include <sightline/algorithms/cutset/viewpoint.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>

namespace sightline {

/// The on-view predicate over the nodes of a face graph: a viewpoint in a node's plane is off-view, and so is one at
/// infinity along it. Doubles decide where their bound allows, and tell how far the viewpoint is from the plane; else
/// the traits do. Exact: yes. Proof: P-51
template <Partition_traits Traits>
requires(Traits::is_exact) class On_view {
 public:
  /// A viewpoint made ready: doubles in the grid's approximate coordinates, each off by at most `error`; a height is
  /// off by at most `bound`.
  struct Eye {
    Viewpoint view;
    double x, y, z, w;  ///< w: 1 for a point, 0 for a direction
    double error, bound;
    mutable std::optional<typename Traits::Eye> exact;  ///< of a point, where it was needed
  };
  /// A node's plane as a unit normal and an offset, each within a relative 2^-49.
  struct Row {
    double a, b, c, d;
  };
  struct Answer {
    bool on;
    double clear;  ///< a distance that the viewpoint can move, in those coordinates, while the answer stays; 0: unknown
  };

  /// Pre: graph and traits are of one scene and outlive this.
  On_view(Traits&&, const Face_graph&) = delete;
  On_view(const Traits&, Face_graph&&) = delete;
  On_view(const Traits& traits, const Face_graph& graph)
      : traits_(&traits),
        graph_(&graph),
        predicates_(graph.scene().predicates()),
        reach_(2 * graph.scene().points().range()) {}

  Row row(std::uint32_t node) const {
    const Prepared_plane h = predicates_.prepare(graph_->plane(node));
    // Over the largest entry first, so that no square overflows or is lost.
    const double largest = std::max({std::fabs(h.a), std::fabs(h.b), std::fabs(h.c)});
    const double a = h.a / largest, b = h.b / largest, c = h.c / largest, length = std::sqrt(a * a + b * b + c * c);
    return {a / length, b / length, c / length, h.d / largest / length};
  }

  /// Errors: std::invalid_argument for a direction of length zero.
  Eye locate(const Viewpoint& view) const {
    if (!view.at_infinity) {
      const Located_point p = graph_->scene().locate(view.at);
      return {view, p.ax, p.ay, p.az, 1, p.error, bound(p.ax, p.ay, p.az, p.error, reach_), std::nullopt};
    }
    Rational largest = 0;
    for (const Rational& x : view.at) largest = std::max(largest, Rational(abs(x)));
    if (largest == 0) throw std::invalid_argument("a viewpoint at infinity wants a direction that is not zero");
    std::array<double, 3> d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = nearest_double(Rational(view.at[k] / largest));
    constexpr double error = 0x1p-53;
    return {view, d[0], d[1], d[2], 0, error, bound(d[0], d[1], d[2], error, 0), std::nullopt};
  }

  /// The distance from the plane, positive in front, in doubles: off by at most eye.bound.
  static double height(const Row& row, const Eye& eye) {
    return row.a * eye.x + row.b * eye.y + row.c * eye.z + row.d * eye.w;
  }
  /// Pre: the row is the node's.
  Answer test(std::uint32_t node, const Row& row, const Eye& eye, Predicate_counts& counts) const {
    const double value = height(row, eye);
    if (const double clear = std::fabs(value) - eye.bound; clear > 0) [[likely]] {
      ++counts.filtered;
      return {value > 0, clear};
    }
    return {test_exactly(node, eye, counts), 0};
  }

  /// At least the distance between two viewpoints; infinite between a point and a direction.
  static double distance(const Eye& from, const Eye& to) {
    if (from.view == to.view) return 0;
    if (from.w != to.w) return std::numeric_limits<double>::infinity();
    const double x = to.x - from.x, y = to.y - from.y, z = to.z - from.z;
    return std::sqrt(x * x + y * y + z * z) * (1 + 0x1p-49) + 2 * (from.error + to.error) + 0x1p-500;
  }

  /// Whether the plane's height over the first eye, as a multiple of its depth below the second, is greater for node j
  /// than for node i. Pre: the second is behind both planes. Exact: yes
  bool is_higher(std::uint32_t j, std::uint32_t i, const Eye& over, const Eye& below) const {
    const Row of_i = row(i), of_j = row(j);
    const double hi = height(of_i, over), hj = height(of_j, over), di = -height(of_i, below), dj = -height(of_j, below);
    const double left = hj * di, right = hi * dj;
    const double bound = over.bound * (std::fabs(di) + std::fabs(dj)) + below.bound * (std::fabs(hi) + std::fabs(hj)) +
                         4 * over.bound * below.bound + 0x1p-50 * (std::fabs(left) + std::fabs(right)) + 0x1p-1000;
    if (left - right > bound) return true;
    if (left - right < -bound) return false;
    return exact_height(j, over.view) * -exact_height(i, below.view) >
           exact_height(i, over.view) * -exact_height(j, below.view);
  }

 private:
  /// Four terms, each off by a relative 2^-49, three sums of 2^-53, and the viewpoint's own error along a unit normal:
  /// 2^-47 and twice the error cover that; where a height might overflow it is infinite. P-51
  static double bound(double x, double y, double z, double error, double reach) {
    return 0x1p-57 * (0x1p10 * (std::fabs(x) + std::fabs(y) + std::fabs(z) + reach)) + 2 * error +
           0x1p-900 * (1 + std::fabs(x) + std::fabs(y) + std::fabs(z));
  }
  [[gnu::noinline]] bool test_exactly(std::uint32_t node, const Eye& eye, Predicate_counts& counts) const {
    if (!eye.view.at_infinity && !eye.exact) eye.exact = traits_->eye(eye.view.at);
    if (eye.exact)
      return traits_->side(*eye.exact, traits_->supporting_plane(graph_->piece(node)), counts) == CGAL::POSITIVE;
    ++counts.gmp;
    return exact_height(node, eye.view) > 0;
  }
  Rational exact_height(std::uint32_t node, const Viewpoint& view) const {
    const std::array<Rational, 4> h = graph_->scene().file_coefficients(graph_->plane(node));
    return h[0] * view.at[0] + h[1] * view.at[1] + h[2] * view.at[2] + (view.at_infinity ? Rational(0) : h[3]);
  }

  const Traits* traits_;
  const Face_graph* graph_;
  Predicates predicates_;
  // Every |d|: a plane passes through points of the scene, which are within the range in each coordinate.
  double reach_;
};

}  // namespace sightline
