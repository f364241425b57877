#pragma once
// Loops as they look along an axis: crossings, winding numbers, and the sides of edges. Rationals only. To be read
// after polygons.h.

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <set>
#include <vector>

namespace sightline::certificate_check {

/// The loops of a face as they look along an axis.
struct Contour {
  using Point = std::array<Rational, 2>;
  struct Edge {
    Point from, to;
  };
  std::vector<Edge> edges;
  std::set<Point> points;  ///< what the loops use

  /// Seen from where the axis points to; `mirrored`: from the other side.
  Contour(const std::vector<Polygon>& loops, std::size_t axis, bool mirrored);
  static Point look(const Exact_point& p, std::size_t axis, bool mirrored);

  /// Whether two edges cross in a point inside both that no loop uses. Cost: n log n and what edges are near each
  /// other.
  bool crosses_itself() const;

  enum class Winding { none, once, other };  ///< the numbers of the cells: 0; 0 and 1; also others
  /// Where edges cross in points of the loops only, a sweep between neighbouring abscissae of those meets every cell.
  /// Pre: !crosses_itself(). Cost: points times edges over one abscissa, times their logarithm. Proof: P-21d
  Winding winding() const;

  /// Whether an edge that is not walked back holds a point of the loops inside: no triangulation of the points has such
  /// an edge. Cost: edges times points.
  bool edge_passes_a_point() const;
};

/// The loops of a planar face as they look from its front, in the first coordinate plane that shows them. Pre: the
/// normal is not zero.
Contour seen_from_front(const std::vector<Polygon>& loops, const Plane& plane);

/// +1 where p is on the left of the edge, 0 on its line, -1 on the right.
int side(const Contour::Edge& e, const Contour::Point& p);

/// Whether the edges cross in a point inside both.
bool cross_inside(const Contour::Edge& e, const Contour::Edge& f);

/// Whether p lies on the edge, between its ends.
bool inside(const Contour::Edge& e, const Contour::Point& p);

}  // namespace sightline::certificate_check
