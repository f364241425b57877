#pragma once
// Whether a viewpoint is strictly in front of a face's plane, and how far it can move before that changes.

#include <sightline/kernel/partition_traits.h>
#include <sightline/kernel/scene/face_graph.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sightline {

/// A point to look from, or a direction towards a viewpoint at infinity (of any length but zero).
struct Viewpoint {
  Exact_point at;
  bool at_infinity = false;
};
inline bool operator==(const Viewpoint& a, const Viewpoint& b) {
  return a.at_infinity == b.at_infinity && std::equal(a.at.begin(), a.at.end(), b.at.begin());
}

/// The on-view predicate over the nodes of a face graph: a viewpoint in a node's plane is off-view, and so is one at infinity along it.
/// Doubles decide where their bound allows, and tell how far the viewpoint is from the plane; else the traits do. Exact: yes. Proof: P-51
template <Partition_traits Traits>
  requires(Traits::is_exact)
class On_view {
 public:
  /// A viewpoint made ready: doubles in the grid's approximate coordinates, each off by at most `error`; a value is off by at most `bound`.
  struct Eye {
    Viewpoint view;
    typename Traits::Eye exact;
    double x, y, z, w;  ///< w: 1 for a point, 0 for a direction
    double error, bound;
  };
  struct Answer {
    bool on;
    double clear;  ///< a distance that the viewpoint can move, in those coordinates, while the answer stays; 0: unknown
  };

  /// Pre: graph and traits are of one scene and outlive this.
  On_view(const Traits& traits, const Face_graph& graph) : traits_(&traits), graph_(&graph) {
    const Predicates predicates = graph.scene().predicates();
    rows_.reserve(graph.size());
    for (std::uint32_t node = 0; node < graph.size(); ++node) {
      const Prepared_plane h = predicates.prepare(graph.plane(node));
      // The largest entry first, so that no square overflows or is lost.
      const double largest = std::max({std::fabs(h.a), std::fabs(h.b), std::fabs(h.c)});
      const double a = h.a / largest, b = h.b / largest, c = h.c / largest, length = std::sqrt(a * a + b * b + c * c);
      rows_.push_back({a / length, b / length, c / length, h.d / largest / length});
      const Row& row = rows_.back();
      const bool finite = std::isfinite(row.a) && std::isfinite(row.b) && std::isfinite(row.c) && std::isfinite(row.d);
      reach_ = finite ? std::max(reach_, std::fabs(row.d)) : std::numeric_limits<double>::infinity();
    }
  }

  /// Errors: std::invalid_argument for a direction of length zero.
  Eye locate(const Viewpoint& view) const {
    if (!view.at_infinity) {
      const Located_point p = graph_->scene().locate(view.at);
      return {view, traits_->eye(view.at), p.ax, p.ay, p.az, 1, p.error, bound(p.ax, p.ay, p.az, p.error, reach_)};
    }
    Rational largest = 0;
    for (const Rational& x : view.at) largest = std::max(largest, Rational(abs(x)));
    if (largest == 0) throw std::invalid_argument("a viewpoint at infinity wants a direction that is not zero");
    std::array<double, 3> d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = nearest_double(view.at[k] / largest);
    constexpr double error = 0x1p-53;
    return {view, {}, d[0], d[1], d[2], 0, error, bound(d[0], d[1], d[2], error, 0)};
  }

  /// The distance from the plane, positive in front, in doubles: off by at most eye.bound.
  double height(std::uint32_t node, const Eye& eye) const {
    const Row& row = rows_[node];
    return row.a * eye.x + row.b * eye.y + row.c * eye.z + row.d * eye.w;
  }
  Answer test(std::uint32_t node, const Eye& eye, Predicate_counts& counts) const {
    const double value = height(node, eye);
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

  /// Whether the plane's height over the first eye, as a multiple of its depth below the second, is greater for node j than for node i. Pre: the second is behind both planes. Exact: yes
  bool is_higher(std::uint32_t j, std::uint32_t i, const Eye& over, const Eye& below) const {
    const double hi = height(i, over), hj = height(j, over), di = -height(i, below), dj = -height(j, below);
    const double left = hj * di, right = hi * dj;
    const double bound = over.bound * (std::fabs(di) + std::fabs(dj)) + below.bound * (std::fabs(hi) + std::fabs(hj)) + 4 * over.bound * below.bound + 0x1p-50 * (std::fabs(left) + std::fabs(right)) + 0x1p-1000;
    if (left - right > bound) return true;
    if (left - right < -bound) return false;
    return exact_height(j, over.view) * -exact_height(i, below.view) > exact_height(i, over.view) * -exact_height(j, below.view);
  }

 private:
  struct Row {
    double a, b, c, d;  ///< of unit length, each within a relative 2^-49
  };

  /// Four terms, each off by a relative 2^-49, three sums of 2^-53, and the viewpoint's own error along a unit normal: 2^-47 and twice the error cover that. P-51
  static double bound(double x, double y, double z, double error, double reach) {
    return 0x1p-47 * (std::fabs(x) + std::fabs(y) + std::fabs(z) + reach) + 2 * error + 0x1p-900 * (1 + std::fabs(x) + std::fabs(y) + std::fabs(z));
  }
  [[gnu::noinline]] bool test_exactly(std::uint32_t node, const Eye& eye, Predicate_counts& counts) const {
    if (!eye.view.at_infinity) return traits_->side(eye.exact, traits_->supporting_plane(graph_->piece(node)), counts) == CGAL::POSITIVE;
    ++counts.gmp;
    return exact_height(node, eye.view) > 0;
  }
  Rational exact_height(std::uint32_t node, const Viewpoint& view) const {
    const std::array<Rational, 4> h = graph_->scene().file_coefficients(graph_->plane(node));
    return h[0] * view.at[0] + h[1] * view.at[1] + h[2] * view.at[2] + (view.at_infinity ? Rational(0) : h[3]);
  }

  const Traits* traits_;
  const Face_graph* graph_;
  std::vector<Row> rows_;
  double reach_ = 0;  // |d| of every row
};

}  // namespace sightline
