#pragma once
// Why something changes along a path, held to what the eye sees at that moment, in numbers x + y sqrt(d). Shares
// nothing with the search but the moment.

#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstdint>
#include <string>

namespace sightline::harness {

/// What is wrong with the kind and the edges of a change at t; empty: nothing. A horizon has the eye in the plane of
/// the face, a contact on some face; of the other kinds there is one ray of the eye that goes to the closed face and
/// meets all edges that are named, closed, before it or on it, and that are three different lines, not concurrent for
/// all t, as the kind says in a plane or not. Where less than three are named, it ends in so many planes of other faces
/// as are missing. Exact: yes
std::string flaw_of_change(const Scene& scene, const Exact_point& from, const Exact_point& to, const Quadratic_root& t,
                           const Along_event::Change& change);

/// Whether the ray in which the eye sees the lines of two edges cross, each a piece and a corner, goes to a closed
/// piece and meets edges of three lines, closed, before it or on it, which are not concurrent for all t, and not all
/// seen as one. Edges of pieces whose plane holds the path, or that point at the eye, are none. Exact: yes
bool meets_three(const Scene& scene, const Exact_point& from, const Exact_point& to, const Quadratic_root& t,
                 std::uint32_t piece, const std::array<std::array<std::uint32_t, 2>, 2>& crossed);

}  // namespace sightline::harness
