#pragma once
// Convex faces in space: on which side of one a point is, and what two of them have in common. Integers, where doubles
// with a bound on their error do not tell. To be read after numbered_points.h.

#include <sightline/algorithms/verify/numbered_points.h>
#include <sightline/algorithms/verify/polygons.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline::certificate_check {

/// A number that a double is near: not farther off than `error`, which is infinite where nothing is known. Proof: P-116
struct Near {
  double value = 0, error = 0;
  /// The number's sign; 0 where it is not known.
  int sign() const { return value > error ? 1 : value < -error ? -1 : 0; }
};
Near operator+(Near a, Near b);
Near operator-(Near a, Near b);
Near operator*(Near a, Near b);

/// A point, and what is near it.
struct Solid_point {
  Homogeneous exact;
  std::array<Near, 3> near;

  explicit Solid_point(const Exact_point& p);
};

/// The turn from p over q to r as seen against an axis.
int turn_along(const Solid_point& p, const Solid_point& q, const Solid_point& r, std::size_t axis);

/// A convex polygon in space; nothing is asked of its shape until its plane is not zero and it is known to be convex.
struct Solid_face {
  using Number = Numbered_points::Number;

  std::vector<Number> numbers;  ///< of its corners
  std::vector<const Solid_point*> corners;
  Homogeneous plane;                       ///< canonical, so that equal planes are equal, or opposite
  std::size_t axis = 0;                    ///< along which the plane's normal is longest
  std::array<Near, 3> normal;              ///< a positive multiple of it
  std::array<std::uint32_t, 3> low, high;  ///< ranks of its coordinates

  /// Pre: the corners are points[number].
  Solid_face(std::vector<Number> numbers, const std::vector<Solid_point>& points);
  bool has_plane() const { return sgn(plane[axis]) != 0; }
  int side(const Solid_point& p) const;  ///< positive in front
};

/// What two faces have in common. Proof: P-115
enum class Contact {
  little,  ///< nothing, a point, or a whole edge of both with the same ends
  edges,   ///< perhaps more, but no points inside either
  crossed  ///< a segment inside one of them, or area in one plane
};
Contact contact_of(const Solid_face& a, const Solid_face& b);

}  // namespace sightline::certificate_check
