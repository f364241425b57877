#pragma once
// Points and rays against an exact BSP tree, by descent.

#include <sightline/algorithms/bsp/tree.h>
#include <sightline/algorithms/rays/ray.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace sightline {

using Exact_tree = Bsp_tree<Exact_traits>;

/// A leaf cell of a tree: the front or back side of the last node on the way to it.
struct Bsp_leaf {
  std::int32_t node = Exact_tree::leaf;  ///< none where the tree is empty
  bool in_front = false;
  bool on_boundary = false;  ///< the point is in the plane of a node on the way; the front was taken there
  friend bool operator==(const Bsp_leaf&, const Bsp_leaf&) = default;
};

enum class Location { outside, inside, on, undefined };

/// Where a point is. `faces` are the faces that hold it (closed), ascending.
struct Point_location {
  Location location;
  Bsp_leaf leaf;
  std::vector<Face_id> faces;
};

/// The first point of a ray on a face: origin + t direction.
struct Ray_hit {
  Rational t;
  Face_id face;
  std::uint32_t number;  ///< of the fragment within the face
};

namespace bsp_detail {

/// A ray in grid coordinates, and what planes say along it.
class Grid_ray {
 public:
  Grid_ray(const Exact_traits& traits, const Exact_ray& ray);
  /// The value of a plane at origin + t direction is `at + t slope`, up to a positive factor of the plane.
  struct Line_value {
    Rational at, slope;
    Rational operator()(const Rational& t) const { return at + t * slope; }
  };
  Line_value value(Plane plane) const;
  /// The parameters t in [low, high] of the ray that a fragment holds, if the ray lies in its plane.
  std::optional<std::array<Rational, 2>> range_within(const Convex_polygon<Exact_traits>& polygon, Rational low,
                                                      std::optional<Rational> high) const;
  /// The side of the ray's point at t to the polygon within its plane: POSITIVE inside, ZERO on its boundary, NEGATIVE
  /// outside.
  Sign side_within(const Convex_polygon<Exact_traits>& polygon, const Rational& t) const;

 private:
  const Exact_traits& traits_;
  std::array<Rational, 3> origin_, direction_;
};

/// Goes through the cells along a ray, nearer ones first, but for those that begin at a parameter that `is_beyond`.
/// Calls along(fragment, range) for each fragment whose plane holds the ray and that it meets, and
/// at(fragment, t, rises) for each other one that it meets, at t: whether the ray goes to the front of the node's
/// plane.
void walk_along(const Exact_tree& tree, const Grid_ray& grid,
                const std::function<bool(const Rational& from)>& is_beyond,
                const std::function<void(const Fragment<Exact_traits>&, const std::array<Rational, 2>& range)>& along,
                const std::function<void(const Fragment<Exact_traits>&, const Rational& t, bool rises)>& at);

/// The winding number of the faces about a point off all of them; nothing where the ray meets an edge. `times`: how
/// often each piece counts.
std::optional<int> winding_along(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray,
                                 const std::vector<int>& times);

}  // namespace bsp_detail

/// The leaf cell of a point, by descent. Degenerate: in the plane of a node, its front. Cost: O(depth). Exact: yes.
Bsp_leaf find_leaf(const Exact_traits& traits, const Exact_tree& tree, const Exact_point& point,
                   Predicate_counts& counts);

/// The faces that hold a point, ascending. Faces are closed. Cost: O(depth), times the planes through the point. Exact:
/// yes.
std::vector<Face_id> faces_at(const Exact_traits& traits, const Exact_tree& tree, const Exact_point& point,
                              Predicate_counts& counts);

/// Where a point is: on a face, or else inside or outside the solid that the faces bound (inside: winding number not
/// zero, where a face counts as often as it is given). Degenerate: `undefined` where the scene is not closed (pass
/// closure(scene).closed) and the point is on no face. Cost: O(depth), and O(n) rational arithmetic for inside or
/// outside. Exact: yes. Proof: P-08
Point_location locate_point(const Exact_traits& traits, const Exact_tree& tree, const Exact_point& point, bool closed,
                            Predicate_counts& counts);

/// The first point of a ray on any face (closed, from both sides; t >= 0), by descent along the ray. Where several
/// fragments hold that point, the one of the lowest face and number. Degenerate: a ray in a face's plane hits the face
/// where it enters it; an origin on a face is hit at t = 0. Errors: std::domain_error for a zero direction. Cost:
/// O(nodes along the ray), rational arithmetic. Exact: yes.
std::optional<Ray_hit> first_hit(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray);

}  // namespace sightline
