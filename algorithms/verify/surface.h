#pragma once
// The one surface of a face that is not planar, and whether pieces are it. Rationals only; shares nothing with what
// cuts faces. Laws: proofs/order_certificate.md (P-22). To be read after faces.h and contour.h.

#include <sightline/algorithms/verify/faces.h>
#include <sightline/algorithms/verify/polygons.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sightline::certificate_check {

/// The loop without points that lie on one line with their neighbours, again until there are none: straight points and
/// spikes. Nothing if fewer than three are left. Pre: no point repeats its predecessor.
Polygon without_straight_points(const Polygon& loop);

/// A face that is not planar, less the accidents of its loops.
struct Skew_face {
  std::vector<Polygon> loops;  ///< without straight points; nothing if none is left of the contour, else that first

  explicit Skew_face(const Face& face);

  /// The loops, each hole turned against the contour as they look along an axis; nothing if one has no area there.
  std::vector<Polygon> seen_along(std::size_t axis) const;

  /// Whether the projection along an axis gives a triangulation with the face's boundary: all loops have area,
  /// different points stay apart, no edge crosses another or passes a point, and all winding numbers are 0 or 1, and
  /// some is 1.
  bool simple_along(std::size_t axis) const;

  /// The axis along which it is simple and has most area; of equal ones, the first.
  std::optional<std::size_t> axis() const;
};

struct Surface_piece {
  const Polygon* polygon;
  std::string name;
};

/// Rejects unless the pieces are the surface of the face: along its axis the constrained Delaunay triangulation,
/// polygons with all corners on one circle cut from their least corner; else the cone from its least point. Pre: not
/// planar. Cost: quadratic in the corners, or corners times pieces. Proof: P-22
void check_surface(const std::string& what, const Face& face, const std::vector<Surface_piece>& pieces);

}  // namespace sightline::certificate_check
