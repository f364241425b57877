#pragma once
// The exact side of a vertex to a plane, decided by the first stage that can:
//   combinatorial -> double with a derived bound -> fixed width -> GMP.
// Laws, tested under all permutations and at every stage:
//   side(v, h) == -side(v, h.opposite());  side(meet(p, q, r), h) is the same for every order of p, q, r;
//   side(meet(p, q, r), p) == 0;  every stage that decides decides the same.

#include <sightline/kernel/arithmetic.h>
#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/located_point.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/prepared_plane.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/vertex.h>

#include <CGAL/Uncertain.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sightline {

/// The predicates over one scene's points and planes, and what is known of incidences. Cheap to copy: three references
/// and a width.
class Predicates {
 public:
  Predicates(Grid_points&&, const Plane_table&, const Point_planes&) = delete;
  Predicates(const Grid_points&, Plane_table&&, const Point_planes&) = delete;
  Predicates(const Grid_points&, const Plane_table&, Point_planes&&) = delete;
  Predicates(const Grid_points& points, const Plane_table& planes, const Point_planes& incidences)
      : points_(&points),
        planes_(&planes),
        incidences_(&incidences),
        arithmetic_(planes.budget().arithmetic()),
        range_(points.range()),
        underflow_(points.bits() <= 53 ? 0 : 0x1p-1000) {}

  const Grid_points& points() const { return *points_; }
  const Plane_table& planes() const { return *planes_; }
  Arithmetic arithmetic() const { return arithmetic_; }

  // ---- Constructions

  /// An input point as a corner where the three given planes meet.
  Vertex input_vertex(std::uint32_t point, std::uint32_t p, std::uint32_t q, std::uint32_t r) const {
    const bool exact = points_->is_exact(point, 0) && points_->is_exact(point, 1) && points_->is_exact(point, 2);
    const double error =
        exact ? 0.0 : 0x1p-53 * range_ + 0x1p-1000;  // each coordinate is the nearest double, or underflows
    return {points_->approximate(point, 0),
            points_->approximate(point, 1),
            points_->approximate(point, 2),
            error,
            {p, q, r},
            point};
  }

  /// The meet of three planes; `fourth`, where given, is known to pass through it. Pre: their normals are linearly
  /// independent, or std::domain_error. Exact: its position, yes; the doubles beside it are within `error`. Proof: P-04
  Vertex meet(std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t fourth = Vertex::no_plane) const;

  /// A plane made ready for side(). Proof of the bound: P-03
  Prepared_plane prepare(Plane plane) const {
    Approximate_plane f = approximate(plane.id());
    const double sense = 1 - 2 * static_cast<int>(plane.flipped());  // without a branch, which no processor can predict
    f = {sense * f.a, sense * f.b, sense * f.c, sense * f.d, f.exact};
    const double norm = (std::fabs(f.a) + std::fabs(f.b) + std::fabs(f.c)) * (1 + 0x1p-50);
    // The value a x + b y + c z + d: 2^-52 in each coefficient, three products and three sums of 2^-53, at coordinates
    // up to twice the range: below 6 x 2^-53 (norm 2 range + |d|) (1 + 2^-50), so 8 x 2^-53 covers it and the rounding
    // of the bound.
    const double size = norm * (2 * range_) + std::fabs(f.d);
    const bool exact = f.exact && size < 0x1p53;  // all terms and sums are integers below 2^53
    return {plane, exact, f.a, f.b, f.c, f.d, norm, 0x1p-50 * size + underflow_};
  }

  // ---- Stages of side()

  /// Stage 1: whether the plane is one of those that made the vertex, or of a face with a corner there.
  bool incident(const Vertex& v, std::uint32_t plane) const {
    if (v.plane[0] == plane || v.plane[1] == plane || v.plane[2] == plane) return true;
    return v.is_input() ? incidences_->contains(v.point, plane) : v.fourth_plane() == plane;
  }

  /// Stage 2: the sign in doubles where their error bound allows, else uncertain. Proof: P-03
  static CGAL::Uncertain<Sign> side_filtered(const Vertex& v, const Prepared_plane& h) {
    const double value = h.a * v.x + h.b * v.y + h.c * v.z + h.d;
    const double bound = h.bound + v.error * h.norm;
    if (value > bound) return CGAL::POSITIVE;
    if (value < -bound) return CGAL::NEGATIVE;
    if (h.exact && v.error == 0) return sign_of(value);
    return CGAL::Uncertain<Sign>::indeterminate();
  }

  /// Stages 3 and 4: the sign of an exact determinant in the given number type. Pre: Number is wide enough for the
  /// scene. Proof: P-02
  template <class Number>
  Sign side_exact(const Vertex& v, Plane plane) const;

  /// Stage 3 at the scene's own width; uncertain where that is GMP.
  CGAL::Uncertain<Sign> side_fixed(const Vertex& v, Plane plane) const;

  /// The side of a vertex to an oriented plane: POSITIVE in front, ZERO on it, NEGATIVE behind.
  /// Degenerate: a vertex on the plane is ZERO, always. Cost: about four multiplications; 0.2 us where doubles cannot
  /// tell. Exact: yes.
  Sign side(const Vertex& v, const Prepared_plane& h, Predicate_counts& counts) const {
    // side_filtered() without a branch on the sign, which no processor can predict.
    const double value = h.a * v.x + h.b * v.y + h.c * v.z + h.d;
    const double bound = h.bound + v.error * h.norm;
    const int sign = int{value > bound} - int{value < -bound};
    if (sign != 0) [[likely]] {
      ++counts.filtered;
      return static_cast<Sign>(sign);
    }
    return side_unfiltered(v, h, counts);
  }

  /// The side of a point that is not of the scene. Exact: filtered, then GMP.
  Sign side(const Located_point& q, Plane plane, Predicate_counts& counts) const;
  /// The first stage of it, which reads the point's doubles only. Proof: P-03
  CGAL::Uncertain<Sign> side_filtered(const Located_point& q, Plane plane) const;

  // ---- Exact values

  /// A vertex in homogeneous integer grid coordinates (x, y, z, w), w > 0, not reduced.
  std::array<Integer, 4> homogeneous(const Vertex& v) const;

  /// The coefficients (a, b, c, d) of an oriented plane.
  std::array<Integer, 4> coefficients(Plane plane) const;

  /// The sign of the determinant of three oriented planes' normals. Laws: exchanging two, or turning one round, negates
  /// it; equal planes give ZERO. Exact: filtered, then GMP. Proof: P-04
  Sign orientation(Plane p, Plane q, Plane r, Predicate_counts& counts) const;

  /// The sign of the determinant of three planes' canonical normals. Exact: yes, in GMP.
  int orientation_exact(std::uint32_t p, std::uint32_t q, std::uint32_t r) const;

 private:
  template <class Number>
  using Row = std::array<Number, 4>;

  static double largest(const Approximate_plane& f) {
    return std::max({std::fabs(f.a), std::fabs(f.b), std::fabs(f.c)});
  }

  Approximate_plane approximate(std::uint32_t id) const {
    const Plane plane(id, false);
    return plane.is_axis_plane() ? approximate_axis(plane) : planes_->approximate(id);
  }
  Approximate_plane approximate_axis(Plane plane) const {
    const int axis = plane.axis();
    return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0,
            -points_->approximate(plane.axis_point(), axis), points_->is_exact(plane.axis_point(), axis)};
  }

  template <class Number>
  Number coordinate(std::uint32_t point, int axis) const;
  template <class Number>
  Row<Number> row(std::uint32_t id) const;
  template <class Number>
  static Number determinant(const Row<Number>& p, const Row<Number>& q, const Row<Number>& r, const Row<Number>& s);

  /// What side() does where the sign of doubles alone cannot tell.
  Sign side_unfiltered(const Vertex& v, const Prepared_plane& h, Predicate_counts& counts) const;

  const Grid_points* points_;
  const Plane_table* planes_;
  const Point_planes* incidences_;
  Arithmetic arithmetic_;
  double range_;      // |approximate coordinate| <= range_
  double underflow_;  // covers what is lost below 2^-1074: nothing where doubles are integers. P-03, P-04
};

extern template Sign Predicates::side_exact<Fixed_integer<2>>(const Vertex&, Plane) const;
extern template Sign Predicates::side_exact<Fixed_integer<4>>(const Vertex&, Plane) const;
extern template Sign Predicates::side_exact<Fixed_integer<8>>(const Vertex&, Plane) const;
extern template Sign Predicates::side_exact<Fixed_integer<16>>(const Vertex&, Plane) const;
extern template Sign Predicates::side_exact<Integer>(const Vertex&, Plane) const;

}  // namespace sightline
