#pragma once
// Targets that lie in one plane and hang together, as the triangles of a street do: one search for a polygon that holds
// them may hide them all.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

using Targets = std::vector<std::uint32_t>;  ///< pieces

/// Whether another piece lies in the same oriented plane and has a corner in common.
bool has_neighbour_in_plane(const Occluders& occluders, std::uint32_t piece);

/// Of some pieces, sorted, those that hang together by corners in one oriented plane: two or more each, sorted, in
/// order of their first. Cost: linear in the pieces at their corners.
std::vector<Targets> hanging_together(const Occluders& occluders, std::span<const std::uint32_t> pieces);

/// Those on either side of the middle one, along the axis on which they reach farthest; sorted. Pre: two or more.
std::array<Targets, 2> halves(const Occluders& occluders, std::span<const std::uint32_t> pieces);

/// The convex hull of pieces in one oriented plane, counterclockwise as seen from its front, without straight corners.
/// Exact: yes.
Near_polygon polygon_around(const Occluders& occluders, std::span<const std::uint32_t> pieces);

/// Whether a point of a piece's plane is inside it, and not on an edge. Exact: yes.
bool has_inside(const Occluders& occluders, std::uint32_t piece, const Near_point& point);

}  // namespace sightline
