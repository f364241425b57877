#pragma once
// Points of the plane as a triangulation of CGAL sees them: bounds first, then the exact coordinates.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/convex_parts.h>

#include <CGAL/Interval_nt.h>
#include <CGAL/enum.h>
#include <CGAL/mpz_class.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sightline::planar {

/// A point as the triangulation sees it: bounds of its coordinates after a common translation and scaling, and the
/// exact ones.
struct Site {
  CGAL::Interval_nt<false> x = 0.0, y = 0.0;
  const Planar_point* exact = nullptr;
};

/// A model of CGAL's ConstrainedDelaunayTriangulationTraits_2 without constructions: interval first, then GMP.
/// Exact: filtered
struct Traits {
  using Point_2 = Site;
  struct Segment_2 {};
  struct Triangle_2 {};
  struct Construct_segment_2 {};
  struct Construct_triangle_2 {};
  struct Construct_point_2 {
    const Site& operator()(const Site& a) const { return a; }
  };
  struct Compare_x_2 {
    CGAL::Comparison_result operator()(const Site& a, const Site& b) const {
      return CGAL::sign(cmp(a.exact->x, b.exact->x));
    }
  };
  struct Compare_y_2 {
    CGAL::Comparison_result operator()(const Site& a, const Site& b) const {
      return CGAL::sign(cmp(a.exact->y, b.exact->y));
    }
  };
  struct Compare_xy_2 {  // CGAL 6 asks for it
    CGAL::Comparison_result operator()(const Site& a, const Site& b) const {
      const CGAL::Comparison_result x = Compare_x_2()(a, b);
      return x == CGAL::EQUAL ? Compare_y_2()(a, b) : x;
    }
  };
  struct Orientation_2 {
    CGAL::Orientation operator()(const Site& a, const Site& b, const Site& c) const;
  };
  struct Side_of_oriented_circle_2 {
    CGAL::Oriented_side operator()(const Site& a, const Site& b, const Site& c, const Site& d) const;
  };
  Construct_point_2 construct_point_2_object() const { return {}; }
  Compare_x_2 compare_x_2_object() const { return {}; }
  Compare_y_2 compare_y_2_object() const { return {}; }
  Compare_xy_2 compare_xy_2_object() const { return {}; }
  Orientation_2 orientation_2_object() const { return {}; }
  Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const { return {}; }
};

/// An interval that holds n / 2^shift. Post: a point where n has at most 53 significant bits and nothing underflows.
CGAL::Interval_nt<false> interval(const Integer& n, long shift);

/// The points in use, relative to the first of them and scaled so that all coordinates are bounded in [-1, 1].
/// Pre: there is one; `points` outlives the sites.
std::vector<Site> sites_of(std::span<const Planar_point> points, const std::vector<std::uint32_t>& used);

}  // namespace sightline::planar
