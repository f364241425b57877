#pragma once
// The codes of a cyclic component: for each two of its faces, which one is nearer along a ray that pierces both,
// without computing where it does (figure 9 of Fuchs, Kedem and Naylor, for any component). Laws, tested: along a ray
// that pierces some faces from the front, no two of which cross, the codes of each two of them are an order, that of
// the ray (P-38); so a component has codes for every pixel, whatever cycles its graph has.

#include <sightline/algorithms/priority/rounded_plane.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstdint>
#include <optional>
#include <vector>

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
  std::optional<bool> first_is_nearer(const Exact_point& eye) const;
};

namespace priority_detail {

/// A plane with p on its closed front side and q on its closed back side, neither all on it. If there is one, there is
/// one through an edge of one and a corner of the other. Degenerate: of polygons of one plane none is told.
std::optional<Normal_and_point> plane_between(const std::vector<Exact_point>& p, const std::vector<Exact_point>& q);

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
