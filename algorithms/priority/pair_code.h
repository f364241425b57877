#pragma once
// The codes of a cyclic component: for each two of its faces, which one is nearer along a ray that pierces both,
// without computing where it does (figure 9 of Fuchs, Kedem and Naylor, for any component). Laws, tested: along a ray
// that pierces some faces from the front, no two of which cross, the codes of each two of them are an order, that of
// the ray (P-38); so a component has codes for every pixel, whatever cycles its graph has.

#include <sightline/algorithms/priority/rational_geometry.h>
#include <sightline/algorithms/priority/relation.h>

#include <optional>

namespace sightline {

/// Which of two faces is nearer where both are seen along one ray.
enum class Precedence : std::uint8_t {
  never,     ///< no ray pierces both from the front
  first,     ///< the first, always
  second,    ///< the second, always
  by_plane,  ///< the one on the eye's side of a plane between them
  crossing   ///< they cross: it depends on the ray
};

namespace priority_detail {

struct Normal_and_point {
  Exact_point normal, point;
};

}  // namespace priority_detail

struct Pair_code {
  Precedence precedence;
  std::optional<priority_detail::Normal_and_point> plane =
      std::nullopt;  ///< the first face is not behind it, the second not in front

  /// Whether the first is nearer. Nothing where neither is known to be, or where the eye is in the plane, from which no
  /// ray pierces both. Pre: not `crossing`.
  std::optional<bool> first_is_nearer(const Exact_point& eye) const {
    if (precedence == Precedence::first || precedence == Precedence::second) return precedence == Precedence::first;
    if (precedence == Precedence::never) return std::nullopt;
    const int side = sgn(priority_detail::dot(plane->normal, priority_detail::minus(eye, plane->point)));
    return side == 0 ? std::nullopt : std::optional(side > 0);
  }
};

namespace priority_detail {

/// A plane with p on its closed front side and q on its closed back side, neither all on it. If there is one, there is
/// one through an edge of one and a corner of the other.
inline std::optional<Normal_and_point> plane_between(const std::vector<Exact_point>& p,
                                                     const std::vector<Exact_point>& q) {
  const auto side = [](const std::vector<Exact_point>& points, const Exact_point& normal,
                       const Exact_point& origin) -> std::optional<int> {
    int found = 0;
    for (const Exact_point& point : points) {
      const int s = sgn(dot(normal, minus(point, origin)));
      if (s * found < 0) return std::nullopt;
      if (s != 0) found = s;
    }
    return found;
  };
  for (const auto& [edges, corners] : {std::pair(&p, &q), std::pair(&q, &p)})
    for (std::size_t k = 0; k < edges->size(); ++k) {
      const Exact_point &origin = (*edges)[k], arm = minus((*edges)[k + 1 == edges->size() ? 0 : k + 1], origin);
      for (const Exact_point& corner : *corners) {
        const Exact_point normal = cross(arm, minus(corner, origin));
        const std::optional<int> of_p = side(p, normal, origin);
        if (!of_p || *of_p == 0) continue;
        const std::optional<int> of_q = side(q, normal, origin);
        if (!of_q || *of_q != -*of_p) continue;
        return Normal_and_point{*of_p > 0 ? normal : minus(Exact_point{0, 0, 0}, normal), origin};
      }
    }
  return std::nullopt;
}

}  // namespace priority_detail

/// The code of two faces of a relation. Degenerate: faces that touch have a plane between them; faces of one plane
/// never hide one another. Cost: that of two arcs, and where both hold, a search of the planes through an edge of one
/// and a corner of the other in rational arithmetic. Exact: yes. Pre: exact traits. Proof: P-38
template <class Traits>
Pair_code pair_code(const Priority_relation<Traits>& faces, std::uint32_t i, std::uint32_t j,
                    Relation_counters& counters) {
  const Arcs arcs = faces.arcs(i, j, counters);
  if (!arcs.forth || !arcs.back)
    return {arcs.forth ? Precedence::first : arcs.back ? Precedence::second : Precedence::never};
  const auto plane = priority_detail::plane_between(priority_detail::positions(faces.traits(), faces[i]),
                                                    priority_detail::positions(faces.traits(), faces[j]));
  if (!plane) return {Precedence::crossing};
  return {Precedence::by_plane, plane};
}

}  // namespace sightline
