#pragma once
// Faces of a soup as points, and boundaries as chains. To be read after numbered_points.h.

#include <sightline/algorithms/verify/numbered_points.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <optional>
#include <vector>

namespace sightline::certificate_check {

/// A face of the soup as points: consecutive repetitions dropped; if it is planar, holes turned so that they run
/// against the outer loop, or, if that has no front, clockwise as seen from the side that `plane` has in front.
struct Face {
  std::vector<Polygon> loops;
  bool planar = true;
  bool has_front = false;  // the outer loop's Newell normal is not zero
  Plane plane;  // of a planar face; if it has no front, either side of its plane; if all points are collinear, zero

  Face(const Polygon_soup& soup, Face_id f);

 private:
  Integer_vector some_normal() const;
};

/// A Numbered_chain that numbers its points itself.
class Boundary_chain {
 public:
  void add(const Polygon& loop, long multiplicity) { chain_.add(points_.add(loop), multiplicity); }
  void add(const std::vector<Polygon>& loops, long multiplicity) {
    for (const Polygon& loop : loops) add(loop, multiplicity);
  }
  /// A point where the chain is not zero, if there is one.
  std::optional<Exact_point> nonzero() const { return chain_.nonzero(points_); }

 private:
  Numbered_points points_;
  Numbered_chain chain_;
};

}  // namespace sightline::certificate_check
