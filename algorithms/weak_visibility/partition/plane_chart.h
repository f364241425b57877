#pragma once
// Coordinates in the plane of a polygon, and curves of degree two in them.

#include <sightline/algorithms/weak_visibility/events/homogeneous.h>
#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/partition/real_root.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace sightline {

/// c[0] + c[1] x + c[2] y + c[3] x^2 + c[4] x y + c[5] y^2 = 0. Canonical: without a common factor, the last
/// coefficient other than zero positive.
struct Plane_curve {
  std::array<Integer, 6> c;

  bool is_line() const { return sgn(c[3]) == 0 && sgn(c[4]) == 0 && sgn(c[5]) == 0; }
  int sign(const Rational& x, const Rational& y) const;
  /// As a polynomial in y: the coefficient of y^power, in x.
  Polynomial coefficient(int power) const;
  /// The only value of y for a value of x, or the lower or the upper one of two; nothing where there is none. Exact:
  /// yes
  std::optional<Quadratic_root> height(const Rational& x, bool upper) const;
  friend bool operator==(const Plane_curve& a, const Plane_curve& b) { return a.c == b.c; }
};

/// The curves that cannot be taken apart over the rationals, canonical, of which a curve consists. Degenerate: what has
/// no more than one real point is none; a double line is one; all of the plane is none. Exact: yes. Proof: P-86
std::vector<Plane_curve> components(const Plane_curve& curve);

/// An affine chart of a plane in which [0, 1] x [0, 1] holds a polygon: its bounding box along two axes, or, of a
/// sliver that fills less than 2^-20 of that, a parallelogram along its longest way of which it fills a tenth or more;
/// rational. Pre: the polygon has an inside.
class Plane_chart {
 public:
  Plane_chart(const Near_frame& frame, const Near_polygon& polygon, const Near_plane& plane);

  /// In homogeneous grid coordinates, w > 0.
  Homogeneous point(const Rational& x, const Rational& y) const;
  std::array<Rational, 2> at(const Homogeneous& p) const;
  /// Where a plane meets this one. Degenerate: all zero where it is this one, or parallel.
  Plane_curve trace(const Homogeneous& plane) const;
  /// Where lines that meet three lines meet it.
  Plane_curve trace(const Exact_pluecker& a, const Exact_pluecker& b, const Exact_pluecker& c) const;
  /// The line through two points of the plane.
  Plane_curve line(const Homogeneous& p, const Homogeneous& q) const;

  /// A rectangle that holds what of a curve's part is within the face's own, from 0 to 1 both ways; rounded outwards.
  struct Bounds {
    double x0, x1, y0, y1;
  };
  /// Of what lines meet that are sums, with weights of one sign, of given ones: everywhere where doubles do not tell.
  Bounds bounds(const std::array<Near<6>, 3>& lines) const;

 private:
  using Corners = std::vector<std::array<Rational, 2>>;
  std::array<Rational, 2> place(const Homogeneous& p) const;
  std::array<Rational, 2> range_of(std::size_t axis, const Corners& corners) const;
  void set_range(std::size_t axis, const Corners& corners, long power);
  void lean(const Corners& corners);

  std::size_t i_, j_, k_;               // axes of x and of y, and the other one
  Homogeneous zero_, x_, y_;            // points are zero + x times x_ + y times y_
  std::array<Rational, 2> low_, wide_;  // grid coordinates of the box along i_ and j_
  // A lean box's coordinate across `along_` is less by slope_ times the way along it.
  std::size_t along_ = 0;
  Rational slope_ = 0;
  std::array<double, 2> near_low_, near_wide_;
  double near_slope_ = 0;
  Near<4> near_plane_;
};

}  // namespace sightline
