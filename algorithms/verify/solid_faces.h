#pragma once
// Convex faces in space: on which side of one a point is, and what two of them have in common. Integers, where doubles
// with a bound on their error do not tell. To be read after numbered_points.h and boxes.h.

#include <sightline/algorithms/verify/boxes.h>
#include <sightline/algorithms/verify/numbered_points.h>
#include <sightline/algorithms/verify/polygons.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline::certificate_check {

/// A number that a double is near: not farther off than `error`, which is infinite where nothing is known. Each step
/// adds its rounding, in any rounding mode. Proof: P-116
struct Near {
  static constexpr double rounding = 0x1p-52, of_errors = 1 + 0x1p-48, of_underflow = 0x1p-1070;
  double value = 0, error = 0;
  /// The number's sign; 0 where it is not known.
  int sign() const { return value > error ? 1 : value < -error ? -1 : 0; }
};
inline Near operator+(Near a, Near b) {
  const double value = a.value + b.value;
  return {value, (a.error + b.error + std::fabs(value) * Near::rounding) * Near::of_errors};
}
inline Near operator-(Near a, Near b) { return a + Near{-b.value, b.error}; }
inline Near operator*(Near a, Near b) {
  const double value = a.value * b.value;
  return {value, (std::fabs(a.value) * b.error + std::fabs(b.value) * a.error + a.error * b.error +
                  std::fabs(value) * Near::rounding + Near::of_underflow) *
                     Near::of_errors};
}
Near operator/(Near a, Near b);  ///< nothing is known where b may be zero
using Near_point = std::array<Near, 3>;

/// A point, what is near it, and numbers of planes that are known to hold it, ascending.
struct Solid_point {
  Homogeneous exact;
  Near_point near;
  std::vector<std::uint32_t> planes;

  explicit Solid_point(const Exact_point& p);
};

/// The turn from p over q to r as seen against an axis; of what is near, 0 where that does not tell.
int turn_along(const Solid_point& p, const Solid_point& q, const Solid_point& r, std::size_t axis);
int turn_along(const Near_point& p, const Near_point& q, const Near_point& r, std::size_t axis);

/// A convex polygon in space; nothing is asked of its shape until its plane is not zero and it is known to be convex.
struct Solid_face {
  using Number = Numbered_points::Number;

  std::vector<Number> numbers;  ///< of its corners
  std::vector<const Solid_point*> corners;
  Homogeneous plane;     ///< canonical, so that equal planes are equal, or opposite
  std::size_t axis = 0;  ///< along which the plane's normal is longest
  Near_point normal;     ///< a positive multiple of it
  /// Of its plane, whichever side is its front; none: not known.
  static constexpr std::uint32_t no_number = 0xffffffff;
  std::uint32_t plane_number = no_number;

  /// Pre: the corners are points[number].
  Solid_face(std::vector<Number> numbers, const std::vector<Solid_point>& points);
  bool has_plane() const { return sgn(plane[axis]) != 0; }
  int side(const Solid_point& p) const;  ///< positive in front
  int side(const Near_point& p) const { return height(p).sign(); }
  Near height(const Near_point& p) const;  ///< of its side
  /// What is near the point of its plane that has the coordinates of p along the other axes. Pre: has_plane().
  Near_point lifted(Near_point p) const;
  Outward_box box() const;
};

/// Whichever way they face.
bool is_in_plane_of(const Solid_face& a, const Solid_face& b);

/// What two faces have in common. Proof: P-115
enum class Contact {
  little,  ///< nothing, a point, or a whole edge of both with the same ends
  edges,   ///< perhaps more, but no points inside either
  crossed  ///< a segment inside one of them, or area in one plane
};
/// Pre: where both planes have numbers, and points know planes, corners are on those.
Contact contact_of(const Solid_face& a, const Solid_face& b);

}  // namespace sightline::certificate_check
