#pragma once
// The priority relation within a scope: viewpoints in a convex region, one viewpoint, one ray. Laws, tested: a region's
// relation is part of the whole one and of that of each larger region; an eye's is part of each region's that holds it;
// a ray's of its eye's.

#include <sightline/algorithms/priority/pair_code.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/algorithms/priority/rounded_plane.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/traits/partition_traits.h>
#include <sightline/kernel/vectors.h>
#include <sightline/algorithms/priority/implicit_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sightline {

/// The convex hull of some points, of any dimension: a polyhedron of viewpoints; one point is one viewpoint, no point
/// no viewpoint.
struct View_region {
  std::vector<Exact_point> points;

  static View_region eye(const Exact_point& p) { return {{p}}; }
  /// All points between two corners. Degenerate: empty where `low` is above `high` on some axis; a rectangle, segment
  /// or point where they agree.
  static View_region box(const Exact_point& low, const Exact_point& high);
};

namespace priority_detail {

using Grid_point = std::array<Integer, 3>;

/// A face in integers.
struct Grid_face {
  std::vector<Grid_point> corners;
  Grid_point normal;
  Integer height(const Grid_point& p) const { return dot(normal, minus(p, corners[0])); }
};

/// Faces and further points, times one integer that makes them all integers.
struct Grid_scene {
  std::vector<Grid_face> faces;
  std::vector<Grid_point> points;
  Integer scale = 1;

  template <class Traits>
  Grid_scene(const Priority_relation<Traits>& relation, const std::vector<Exact_point>& further)
      : faces(relation.size()) {
    std::vector<std::vector<Exact_point>> corners(relation.size());
    const auto see = [&](const Exact_point& p) {
      for (const Rational& x : p) scale = lcm(scale, x.get_den());
    };
    for (std::uint32_t i = 0; i < relation.size(); ++i)
      for (const Corner<Traits>& corner : relation[i]) {
        corners[i].push_back(relation.traits().position(*corner.vertex));
        see(corners[i].back());
      }
    std::for_each(further.begin(), further.end(), see);
    const auto scaled = [&](const Exact_point& p) {
      Grid_point q;
      for (std::size_t k = 0; k < 3; ++k) q[k] = p[k].get_num() * (scale / p[k].get_den());
      return q;
    };
    for (const Exact_point& p : further) points.push_back(scaled(p));
    for (std::uint32_t i = 0; i < relation.size(); ++i) {
      Grid_face& face = faces[i];
      for (const Exact_point& p : corners[i]) face.corners.push_back(scaled(p));
      for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {  // the sum over a fan, as corners may be straight
        const Grid_point part =
            cross(minus(face.corners[k], face.corners[0]), minus(face.corners[k + 1], face.corners[0]));
        for (std::size_t axis = 0; axis < 3; ++axis) face.normal[axis] += part[axis];
      }
    }
  }
};

/// Whether some of the points' convex hull is an eye from which the inside of a may obscure that of b. Exact: yes, a
/// linear program in CGAL's solver.
bool an_eye_may_see_over(const Grid_face& a, const Grid_face& b, const std::vector<Grid_point>& eyes);

}  // namespace priority_detail

/// r1 < r2 from a region: some eye of the (closed) region, strictly in front of both planes, sends a ray through the
/// inside of r1 and then the inside of r2. With A the part of r1 in front of r2's plane and B the part of r2 behind
/// r1's, such eyes are the inside of conv A + cone {a - b}: a linear program, solved exactly, where the whole relation
/// has the arc and the region a point in front of both planes. Pre: exact traits.
template <class Model>
class Region_relation {
 public:
  using Traits = Model;

  /// Pre: `faces` outlives it. Cost: a side for each face and point of the region.
  Region_relation(Priority_relation<Traits>&&, const View_region&) = delete;
  Region_relation(const Priority_relation<Traits>& faces, const View_region& region)
      : faces_(&faces), grid_(faces, region.points), seen_(faces.size()) {
    for (std::uint32_t i = 0; i < faces.size(); ++i)
      seen_[i] = std::any_of(grid_.points.begin(), grid_.points.end(),
                             [&](const Grid_point& p) { return sgn(grid_.faces[i].height(p)) > 0; });
    if (grid_.points.size() == 1)
      for (const Grid_face& face : grid_.faces) {
        arms_.push_back(arms_of(face));
        cones_.push_back(cone_of(arms_.back()));
      }
  }

  std::uint32_t size() const { return faces_->size(); }
  const Priority_relation<Traits>& faces() const { return *faces_; }
  /// Whether the face is on-view from some point of the region.
  bool on_view(std::uint32_t i) const { return seen_[i]; }

  /// Whether i < j from the region. Degenerate: an empty region, or one that no arc's eyes reach but with their
  /// boundary, has no arc; an eye in a face's plane does not see it; a region that faces cut is all its points, inside
  /// solids too. Exact: yes. Cost: a linear program of 6 rows, where no corner of the region and no edge of the faces
  /// tells; from one viewpoint none. Proof: P-33
  bool may_obscure(std::uint32_t i, std::uint32_t j, Relation_counters& counters) const {
    return arcs(i, j, counters).forth;
  }
  Arcs arcs(std::uint32_t i, std::uint32_t j, Relation_counters& counters) const {
    if (!seen_[i] || !seen_[j] || (!cones_.empty() && cones_[i].apart_from(cones_[j]))) return {};
    const Arcs whole = faces_->arcs(i, j, counters);
    if (!whole.forth && !whole.back) return {};
    if (!cones_.empty()) return arcs_of_eye(i, j, whole);
    const Grid_face &a = grid_.faces[i], &b = grid_.faces[j];
    // Where one corner of the region sees the one face before the other, or one edge keeps them apart for all corners,
    // that is the answer.
    if (apart_for_all(a, b) || apart_for_all(b, a)) return {};
    if ((!whole.forth || !whole.back) && overlap_from_some(a, b)) return whole;
    return {whole.forth && priority_detail::an_eye_may_see_over(a, b, grid_.points),
            whole.back && priority_detail::an_eye_may_see_over(b, a, grid_.points)};
  }

 private:
  using Grid_face = priority_detail::Grid_face;
  using Grid_point = priority_detail::Grid_point;

  // ---- One viewpoint

  /// Arcs of the one viewpoint, in front of both: if the cones overlap, a plane between the faces says which is nearer;
  /// if there is none, each is so somewhere.
  Arcs arcs_of_eye(std::uint32_t i, std::uint32_t j, Arcs whole) const {
    if (separable(i, j)) return {};
    if (!whole.forth || !whole.back) return whole;
    const auto exact_corners = [&](std::uint32_t face) {
      std::vector<Exact_point> points;
      for (const Grid_point& p : grid_.faces[face].corners)
        points.push_back({Rational(p[0]), Rational(p[1]), Rational(p[2])});
      return points;
    };
    const Grid_point& eye = grid_.points[0];
    const auto plane = priority_detail::plane_between(exact_corners(i), exact_corners(j));
    if (!plane) return {true, true};  // they cross
    const std::optional<bool> first =
        Pair_code{Precedence::by_plane, plane}.first_is_nearer({Rational(eye[0]), Rational(eye[1]), Rational(eye[2])});
    return {first == true, first == false};
  }

  /// From the viewpoint to the corners, each entry within a relative 2^-53; infinite where that is beyond doubles.
  std::vector<Triple> arms_of(const Grid_face& face) const {
    std::vector<Triple> arms;
    for (const Grid_point& p : face.corners) {
      const Grid_point arm = minus(p, grid_.points[0]);
      arms.push_back(
          {nearest_double(Rational(arm[0])), nearest_double(Rational(arm[1])), nearest_double(Rational(arm[2]))});
    }
    return arms;
  }
  static constexpr unsigned in_front = 1, behind = 2, unknown = 4, both = in_front | behind;
  /// On which sides of the plane some of the arms are: bits of the constants above, or no more than `both`. One place
  /// is left out; those next to it tell of most planes through it that they have the face on both sides.
  static unsigned sides_of(const std::vector<Triple>& arms, const priority_detail::Rounded_plane& plane,
                           std::size_t out = ~std::size_t{0}) {
    unsigned found = 0;
    const auto look_at = [&](std::size_t c) {
      const int side = plane.side(arms[c]);
      found |= side > 0 ? in_front : side < 0 ? behind : unknown;
    };
    if (out < arms.size()) {
      look_at(out + 1 == arms.size() ? 0 : out + 1);
      look_at(out == 0 ? arms.size() - 1 : out - 1);
    }
    for (std::size_t c = 0; c < arms.size() && (found & both) != both; ++c)
      if (c != out) look_at(c);
    return found;
  }

  /// Whether a plane through the one viewpoint has face i on one side and face j on the other: in doubles where these
  /// tell, else exactly.
  bool separable(std::uint32_t i, std::uint32_t j) const {
    using priority_detail::Rounded_plane;
    for (const auto& [a, b] : {std::pair(i, j), std::pair(j, i)})
      for (std::size_t k = 0; k < arms_[a].size(); ++k) {
        const unsigned sides =
            sides_of(arms_[b], Rounded_plane(arms_[a][k], arms_[a][k + 1 == arms_[a].size() ? 0 : k + 1]));
        if ((sides & behind) == 0 &&
            ((sides & unknown) == 0 || apart(grid_.points[0], grid_.faces[a], k, grid_.faces[b])))
          return true;
      }
    for (std::size_t k = 0; k < arms_[i].size(); ++k)
      for (std::size_t l = 0; l < arms_[j].size(); ++l) {
        const Rounded_plane plane(arms_[i][k], arms_[j][l]);
        const unsigned of_i = sides_of(arms_[i], plane, k), of_j = sides_of(arms_[j], plane, l);
        if ((of_i & both) == both || (of_j & both) == both || (of_i & of_j & both) != 0) continue;
        if (((of_i | of_j) & unknown) == 0 || divides(grid_.points[0], grid_.faces[i], k, grid_.faces[j], l))
          return true;
      }
    return false;
  }

  /// A round cone, narrower than a half-space, of all directions from the one eye to a face, in doubles; or, with a
  /// cosine of 0, nothing known.
  struct Round_cone {
    Triple axis{};
    double cosine = 0, sine = 1;
    /// Whether the cones share no direction, rounding included: each of the three terms is within 2^-48.
    bool apart_from(const Round_cone& other) const {
      const double between = axis[0] * other.axis[0] + axis[1] * other.axis[1] + axis[2] * other.axis[2];
      return cosine > 0 && other.cosine > 0 && between < cosine * other.cosine - sine * other.sine - 0x1p-44;
    }
  };
  static Round_cone cone_of(const std::vector<Triple>& arms) {
    std::vector<Triple> directions = arms;
    Round_cone cone;
    const auto normalize = [](Triple& d) {
      const double length = std::hypot(d[0], d[1], d[2]);
      for (double& x : d) x /= length;
    };
    for (Triple& d : directions) {
      normalize(d);
      for (std::size_t k = 0; k < 3; ++k) cone.axis[k] += d[k];
    }
    normalize(cone.axis);
    double least = 1;
    for (const auto& d : directions)
      least = std::min(least, cone.axis[0] * d[0] + cone.axis[1] * d[1] + cone.axis[2] * d[2]);
    if (!(least > 0x1p-20)) return {};  // also where a number is beyond doubles
    cone.cosine = least - 0x1p-48;
    cone.sine = std::sqrt(1 - cone.cosine * cone.cosine);
    return cone;
  }

  // ---- Any viewpoint

  /// Whether the plane through an eye and edge k of a has b on its outer side. Pre: the eye is in front of a.
  static bool apart(const Grid_point& eye, const Grid_face& a, std::size_t k, const Grid_face& b) {
    using namespace priority_detail;
    const Grid_point edge = cross(minus(a.corners[k], eye),
                                  minus(a.corners[(k + 1) % a.corners.size()], eye));  // a is where it is negative
    return std::all_of(b.corners.begin(), b.corners.end(),
                       [&](const Grid_point& p) { return sgn(dot(edge, minus(p, eye))) >= 0; });
  }
  /// Whether one edge of a does so for all points of the region: then for all eyes in it, as the sign is that of a
  /// linear form in the eye.
  bool apart_for_all(const Grid_face& a, const Grid_face& b) const {
    for (std::size_t k = 0; k < a.corners.size(); ++k)
      if (std::all_of(grid_.points.begin(), grid_.points.end(),
                      [&](const Grid_point& eye) { return apart(eye, a, k, b); }))
        return true;
    return false;
  }
  /// Whether from some point of the region, in front of both, the cones of the insides meet.
  bool overlap_from_some(const Grid_face& a, const Grid_face& b) const {
    return std::any_of(grid_.points.begin(), grid_.points.end(), [&](const Grid_point& eye) {
      return sgn(a.height(eye)) > 0 && sgn(b.height(eye)) > 0 && !separable(eye, a, b);
    });
  }
  /// Whether a plane through the eye has a on one side and b on the other. If there is one, there is one through two
  /// corners: of one edge, or of a and of b.
  static bool separable(const Grid_point& eye, const Grid_face& a, const Grid_face& b) {
    using namespace priority_detail;
    for (std::size_t k = 0; k < a.corners.size(); ++k)
      if (apart(eye, a, k, b)) return true;
    for (std::size_t k = 0; k < b.corners.size(); ++k)
      if (apart(eye, b, k, a)) return true;
    for (std::size_t k = 0; k < a.corners.size(); ++k)
      for (std::size_t l = 0; l < b.corners.size(); ++l)
        if (divides(eye, a, k, b, l)) return true;
    return false;
  }
  /// Whether the plane through the eye and a corner of each has a on one side and b on the other.
  static bool divides(const Grid_point& eye, const Grid_face& a, std::size_t k, const Grid_face& b, std::size_t l) {
    using namespace priority_detail;
    const Grid_point normal = cross(minus(a.corners[k], eye), minus(b.corners[l], eye));
    if (sgn(normal[0]) == 0 && sgn(normal[1]) == 0 && sgn(normal[2]) == 0) return false;
    const auto on_side = [&](const Grid_face& face, int side) {
      return std::all_of(face.corners.begin(), face.corners.end(),
                         [&](const Grid_point& p) { return side * sgn(dot(normal, minus(p, eye))) >= 0; });
    };
    return (on_side(a, 1) && on_side(b, -1)) || (on_side(a, -1) && on_side(b, 1));
  }

  const Priority_relation<Traits>* faces_;
  priority_detail::Grid_scene grid_;
  std::vector<char> seen_;
  std::vector<Round_cone> cones_;  // of one viewpoint
  std::vector<std::vector<Triple>> arms_;
};

/// r1 < r2 along one ray from one eye: both are on-view, and the ray goes through the inside of r1 and then through the
/// inside of r2. Degenerate: a ray through an edge or a corner goes through no inside. Pre: exact traits; direction !=
/// 0. Exact: yes.
template <class Model>
class Ray_relation {
 public:
  using Traits = Model;

  /// Pre: `faces` outlives it. Errors: std::domain_error for a zero direction. Cost: linear in the corners.
  Ray_relation(Priority_relation<Traits>&&, const Exact_point&, const Exact_point&) = delete;
  Ray_relation(const Priority_relation<Traits>& faces, const Exact_point& eye, const Exact_point& direction)
      : faces_(&faces), pierced_(faces.size()) {
    if (sgn(direction[0]) == 0 && sgn(direction[1]) == 0 && sgn(direction[2]) == 0)
      throw std::domain_error("a ray needs a direction");
    const priority_detail::Grid_scene grid(faces, {eye, direction});
    for (std::uint32_t i = 0; i < faces.size(); ++i)
      pierced_[i] = pierced(grid.faces[i], grid.points[0], grid.points[1]);
  }

  std::uint32_t size() const { return faces_->size(); }
  const Priority_relation<Traits>& faces() const { return *faces_; }
  /// Where the ray goes through the face's inside, if it does and the eye is in front: eye + t direction.
  const std::optional<Rational>& parameter(std::uint32_t i) const { return pierced_[i]; }

  bool may_obscure(std::uint32_t i, std::uint32_t j, Relation_counters&) const {
    return pierced_[i] && pierced_[j] && *pierced_[i] < *pierced_[j];
  }
  Arcs arcs(std::uint32_t i, std::uint32_t j, Relation_counters& counters) const {
    return {may_obscure(i, j, counters), may_obscure(j, i, counters)};
  }

 private:
  static std::optional<Rational> pierced(const priority_detail::Grid_face& face, const priority_detail::Grid_point& eye,
                                         const priority_detail::Grid_point& direction) {
    using namespace priority_detail;
    const Integer height = face.height(eye), slope = dot(face.normal, direction);
    if (sgn(height) <= 0 || sgn(slope) >= 0) return std::nullopt;  // off-view, or never there
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const Grid_point from = minus(face.corners[k], eye), to = minus(face.corners[(k + 1) % face.corners.size()], eye);
      if (sgn(dot(cross(from, to), direction)) >= 0)
        return std::nullopt;  // seen from the front the corners run counterclockwise
    }
    Rational t(height, -slope);
    t.canonicalize();
    return t;
  }

  const Priority_relation<Traits>* faces_;
  std::vector<std::optional<Rational>> pierced_;
};

// Compiled once.
extern template priority_detail::Grid_scene::Grid_scene(const Priority_relation<Exact_traits>&,
                                                        const std::vector<Exact_point>&);
extern template class Region_relation<Exact_traits>;
extern template class Ray_relation<Exact_traits>;
extern template class Implicit_priority_graph<Region_relation<Exact_traits>>;
extern template class Implicit_priority_graph<Ray_relation<Exact_traits>>;

}  // namespace sightline
