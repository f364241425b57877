#pragma once
// An eye that moves along a segment, and the planes through it and the lines of edges.

#include <sightline/algorithms/weak_visibility/events/homogeneous.h>
#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cmath>

namespace sightline {

/// What a fraction is as a moment, that is as a root.
inline Quadratic_root moment(const Rational& t) { return {t.get_num(), 0, Integer(0), t.get_den()}; }

/// The point from + t (to - from), 0 <= t <= 1, in homogeneous grid coordinates that are linear in t, the last one
/// constant. Errors: std::invalid_argument where the segment has no length.
class Moving_eye {
 public:
  Moving_eye(const Scene& scene, const Near_frame& frame, const Exact_point& from, const Exact_point& to);

  const std::array<Homogeneous, 2>& ends() const { return ends_; }
  /// A positive multiple. Exact: yes
  Homogeneous at(const Rational& t) const;
  Near<4> near(const Quadratic_root& t) const;
  /// Its side of a plane, times a positive constant: linear. Exact: yes
  Quadratic side(const Homogeneous& plane) const;

 private:
  std::array<Homogeneous, 2> ends_;
  std::array<Near<4>, 2> near_;
};

/// A line of the scene, and the normal first + t change of the plane through it and the eye: zero where the eye is on
/// it. Its product with a direction is positive where line, from a to b, and direction r have det[eye, r, a, b] < 0.
struct Eye_line {
  Exact_pluecker line;
  Near<6> near;
  std::array<Integer, 3> first, change;
};
Eye_line eye_line(const Moving_eye& eye, const Near_frame& frame, const Exact_pluecker& line);

/// The determinant of three such normals: zero where the eye sees the three lines through one point. The third power
/// of t falls out: all changes are across the eye's way. Exact: yes. Proof: P-87
Quadratic determinant(const Eye_line& i, const Eye_line& j, const Eye_line& k);

/// Of a direction, for what doubles propose; itself where it is zero.
inline Triple unit_direction(const Triple& a) {
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  return length > 0 ? Triple{a[0] / length, a[1] / length, a[2] / length} : a;
}

/// The side of a point of the plane through the eye and a line: linear. Exact: yes
Quadratic side(const Moving_eye& eye, const Eye_line& line, const Homogeneous& point);

}  // namespace sightline
