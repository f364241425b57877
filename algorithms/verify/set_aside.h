#pragma once
// Faces that are not drawn: whether the reason that is given for it holds. Rationals and integers only; shares nothing
// with what sets faces aside but the list of reasons. Laws: proofs/order_certificate.md (P-21d, P-22).

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/faces.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

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

  /// Whether two edges cross in a point inside both that no loop uses. Cost: quadratic in the edges.
  bool crosses_itself() const;

  enum class Winding { none, once, other };  ///< the numbers of the cells: 0; 0 and 1; also others
  /// Where edges cross in points of the loops only, a sweep between neighbouring abscissae of those meets every cell.
  /// Pre: !crosses_itself(). Cost: edges times points. Proof: P-21d
  Winding winding() const;

  /// Whether an edge that is not walked back holds a point of the loops inside: no triangulation of the points has such
  /// an edge. Cost: edges times points.
  bool edge_passes_a_point() const;
};

/// Whether two edges of a planar face cross in a point inside both that is none of its loops', or its winding number is
/// neither 0 nor 1 somewhere. Pre: planar, not all points collinear. Proof: P-21d
bool self_intersecting(const Face& face);

/// Whether the projection along an axis gives a triangulation with the face's boundary: the contour has area and keeps
/// different points apart, no edge crosses another or passes a point, and all winding numbers are 0 or 1, and some
/// is 1. Pre: not planar. Proof: P-22
bool simple_along(const Face& face, std::size_t axis);

/// Whether two closed sequences of points are the same up to the place where they begin.
bool same_cycle(const Polygon& a, const Polygon& b);

/// Rejects unless the reason holds.
void check_set_aside(const Polygon_soup& soup, const Covering::Set_aside& entry, const std::set<Face_id>& set_aside);

}  // namespace sightline::certificate_check
