#pragma once
// Vectors, planes, convex polygons and the cones in which an eye sees them: rationals and integers only, what all
// checks stand on. To be read first.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace sightline::certificate_check {

// ---- Vectors

using Integer_vector = std::array<Integer, 3>;
using Polygon = std::vector<Exact_point>;

Exact_point minus(const Exact_point& a, const Exact_point& b);

template <class Number>
std::array<Number, 3> cross(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]), Number(a[0] * b[1] - a[1] * b[0])};
}

Integer_vector cross(const Integer_vector& a, const Integer_vector& b);

Rational dot(const Integer_vector& a, const Exact_point& b);

Integer dot(const Integer_vector& a, const Integer_vector& b);

int sign_of_dot(const Integer_vector& a, const Integer_vector& b);

bool is_zero(const Integer_vector& a);
Integer_vector negated(const Integer_vector& a);

/// The coprime integer vector that is a positive multiple of v; zero for zero.
Integer_vector primitive(Integer_vector v);
Integer_vector primitive(const Exact_point& v);

/// The direction of Newell's normal: the loop runs counterclockwise around it. Zero where the signed areas cancel.
Integer_vector newell_normal(const Polygon& loop);

struct Plane {
  Integer_vector normal;
  Exact_point origin;
  int side(const Exact_point& p) const { return sgn(dot(normal, minus(p, origin))); }
};

/// A point, with a positive last coordinate, or a plane: at a point, positive in front.
using Homogeneous = std::array<Integer, 4>;

Homogeneous homogeneous(const Exact_point& p);
std::vector<Homogeneous> homogeneous(const Polygon& polygon);

/// A positive multiple of a - b, of points.
Integer_vector minus(const Homogeneous& a, const Homogeneous& b);

/// Pre: the polygon has area. Post: it runs counterclockwise as seen from the front.
Homogeneous plane_of(const Polygon& polygon);
/// Post: in front where the plane is.
Homogeneous plane_of(const Plane& plane);

int side(const Homogeneous& plane, const Homogeneous& p);
/// A number of that sign, linear in both.
Integer height(const Homogeneous& plane, const Homogeneous& p);

// ---- Convex polygons

/// Why the polygon is not a convex one of positive area in the plane, counterclockwise around its normal; empty where
/// it is. Straight corners are allowed, repeated vertices and spikes are not. Pre: the normal is not zero. Cost:
/// linear. Proof: P-21a
std::string not_convex(const Polygon& polygon, const Plane& plane);
/// Corner_places that stand elsewhere, as many polygons have them.
using Corner_places = std::span<const Homogeneous* const>;
std::string not_convex(Corner_places polygon, const Homogeneous& plane);
std::string not_convex(const std::vector<Homogeneous>& polygon, const Homogeneous& plane);

// ---- What the eye sees of a polygon

/// The direction from the eye to a point, coprime integers.
Integer_vector ray_to(const Homogeneous& p, const Homogeneous& eye);

/// The cone of directions from the eye to a convex polygon. Pre: not_convex() is empty for it.
struct Cone {
  bool edge_on = false;                     ///< the eye is in the polygon's plane; the rest is then empty
  std::vector<Integer_vector> rays;         ///< to the vertices, without straight corners
  std::vector<Integer_vector> edge_planes;  ///< normal, pointing inwards, of the plane of rays i and i + 1: sense x
                                            ///< their product
  int sense = 1;                            ///< 1, or -1 where the eye is in front
  Integer_vector nearness;  ///< the polygon's plane is met along d at t where nearness.d x t = distance;
  Integer distance;         ///< nearness.d > 0 in the cone, distance > 0

  Cone() = default;
  Cone(const Polygon& polygon, const Exact_point& eye);
  Cone(const std::vector<Homogeneous>& polygon, const Homogeneous& eye);
  /// Pre: the second ones are the ray_to() of each of the polygon's corners.
  Cone(Corner_places polygon, std::span<const Integer_vector* const> to_corners, const Homogeneous& eye);
};

/// Whether an edge plane of a has no ray of b on its inner side: then the cones have no open set in common.
bool separates(const Cone& a, const Cone& b);

}  // namespace sightline::certificate_check
