#pragma once
// Checks that polygons are a scene: each face tiled by its fragments, or set aside for a reason that holds. What
// certificates of orders and of priority graphs have in common. Rationals and integers only; shares nothing with what
// makes certificates. Laws: proofs/order_certificate.md (P-21, P-22).

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

/// A convex part of a face (of piece `piece` of it, where the face has pieces).
struct Order_fragment {
  Face_id face = 0;
  std::uint32_t piece = 0;
  std::vector<Exact_point> vertices;  ///< counterclockwise as seen from the face's front; straight corners are welcome
};

/// The claim "the fragments are the scene".
struct Covering {
  std::vector<Order_fragment> fragments;

  /// A planar convex polygon on a face's own vertices. A non-planar face must have pieces, a planar one may.
  struct Piece {
    Face_id face = 0;
    std::uint32_t piece = 0;
    std::vector<Exact_point> vertices;
  };
  std::vector<Piece> pieces;

  /// A face that is not drawn. `why` begins with the text of a Set_aside_reason (kernel/scene/set_aside.h).
  struct Set_aside {
    Face_id face = 0;
    std::string why;
  };
  std::vector<Set_aside> set_aside;
};

/// What a checker answers.
struct Verdict {
  bool accepted = false;
  std::string why;                     ///< one line; where rejected, the first thing found wrong
  std::vector<std::size_t> fragments;  ///< the places in the order of the fragments at fault, where there are such
};

struct Verify_options {
  std::function<void(std::size_t done, std::size_t total)>
      progress;  ///< the share of pairs that are done with, of all fragments; may be empty
};

namespace certificate_check {

// ---- Vectors

using Integer_vector = std::array<Integer, 3>;
using Polygon = std::vector<Exact_point>;

Exact_point minus(const Exact_point& a, const Exact_point& b);

template <class Number>
std::array<Number, 3> cross(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]), Number(a[0] * b[1] - a[1] * b[0])};
}

Rational dot(const Integer_vector& a, const Exact_point& b);

Integer dot(const Integer_vector& a, const Integer_vector& b);

int sign_of_dot(const Integer_vector& a, const Integer_vector& b);

bool is_zero(const Integer_vector& a);
Integer_vector negated(const Integer_vector& a);

/// The coprime integer vector that is a positive multiple of v; zero for zero.
Integer_vector primitive(const Integer_vector& v);
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

/// Pre: the polygon has area. Post: it runs counterclockwise as seen from the front.
Homogeneous plane_of(const Polygon& polygon);

int side(const Homogeneous& plane, const Homogeneous& p);

// ---- Faces and polygons

/// A face of the soup as points: consecutive repetitions dropped; if it is planar, holes turned so that they run
/// against the outer loop, or, if that has no front, clockwise as seen from the side that `plane` has in front.
struct Face {
  std::vector<Polygon> loops;
  bool planar = true;
  bool has_front = false;  // the outer loop's Newell normal is not zero
  Plane plane;  // of a planar face; if it has no front, either side of its plane; if all points are collinear, zero

  Face(const Polygon_soup& soup, Face_id f);

  /// The loops, each hole turned against the outer one as they look along an axis; there a hole without area stays as
  /// it is. Nothing if the outer loop has no area there. Pre: not planar, as then holes are turned already.
  std::vector<Polygon> seen_along(std::size_t axis) const;

  std::size_t corner_count() const {
    std::size_t count = 0;
    for (const Polygon& loop : loops) count += loop.size();
    return count;
  }

 private:
  Integer_vector some_normal() const;
};

/// Why the polygon is not a convex one of positive area in the plane, counterclockwise around its normal; empty where
/// it is. Straight corners are allowed, repeated vertices and spikes are not. Pre: the normal is not zero. Cost:
/// linear. Proof: P-21a
std::string not_convex(const Polygon& polygon, const Plane& plane);

/// A sum of directed segments as a chain: two sums are the same chain iff on each line, at each point, the net number
/// of arrivals is the same. A line through a known point is its direction, so the key is (direction up to sign, point).
/// Proof: P-21b
class Boundary_chain {
 public:
  void add(const Polygon& loop, long multiplicity);
  void add(const std::vector<Polygon>& loops, long multiplicity) {
    for (const Polygon& loop : loops) add(loop, multiplicity);
  }
  /// A point where the chain is not zero, if there is one.
  std::optional<Exact_point> nonzero() const;

 private:
  std::map<std::pair<Integer_vector, Exact_point>, long> arrivals_;
};

// ---- What the eye sees of a polygon

/// The cone of directions from the eye to a convex polygon. Pre: not_convex() is empty for it.
struct Cone {
  bool edge_on = false;                     ///< the eye is in the polygon's plane; the rest is then empty
  std::vector<Integer_vector> rays;         ///< to the vertices, without straight corners
  std::vector<Integer_vector> edge_planes;  ///< normal, pointing inwards, of the plane of rays i and i + 1
  Integer_vector nearness;  ///< the polygon's plane is met along d at t where nearness.d x t = distance;
  Integer distance;         ///< nearness.d > 0 in the cone, distance > 0

  Cone(const Polygon& polygon, const Exact_point& eye);
};

/// Whether an edge plane of a has no ray of b on its inner side: then the cones have no open set in common.
bool separates(const Cone& a, const Cone& b);

// ---- The covering

struct Rejection {
  Verdict verdict;
};

[[noreturn]] inline void reject(std::string why, std::vector<std::size_t> fragments = {}) {
  throw Rejection{{false, std::move(why), std::move(fragments)}};
}

/// What a check answers that returns its line on acceptance and throws a Rejection otherwise.
template <class Check>
Verdict verdict_of(Check check) {
  try {
    return {true, check(), {}};
  } catch (const Rejection& rejection) {
    return rejection.verdict;
  }
}

inline std::string name(const char* kind, std::size_t number) { return kind + (' ' + std::to_string(number)); }

std::string name(const Exact_point& p);

bool canonical(const Rational& r);
template <std::size_t n>
bool canonical(const std::array<Rational, n>& all) {
  return std::all_of(all.begin(), all.end(), [](const Rational& r) { return canonical(r); });
}
bool canonical(const Polygon& polygon);

/// A polygon that should be part of a tiling, with its name for messages and its place in the order, if it has one.
struct Tile {
  const Polygon* polygon;
  std::string name;
  std::vector<std::size_t> fragments;
};

/// Rejects unless the tiles are convex polygons in the plane that cover once what `target` bounds, and nothing else.
/// `winds_once`: the target is known to be the boundary of a set, taken once. Proof: P-21
void check_tiling(const std::string& what, Boundary_chain target, const Plane& plane, bool winds_once,
                  const std::vector<Tile>& tiles);

/// Rejects unless the pieces make a surface on the face's own vertices that its loops bound. Proof: P-22
void check_pieces(const std::string& what, const Face& face, const std::vector<Tile>& pieces);

/// Rejects unless the fragments are the scene: they refer to it, tile each face piece by piece, and all else is set
/// aside rightly. With an eye, polygons that it is not strictly in front of may be left out, whole. Proof: P-21, P-22
void check_covering(const Polygon_soup& soup, const Covering& covering, const Exact_point* eye = nullptr);

}  // namespace certificate_check

}  // namespace sightline
