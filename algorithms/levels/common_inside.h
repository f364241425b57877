#pragma once
// Whether half-spaces have an inside in common: what tells whether convex polyhedra overlap.

#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <vector>

namespace sightline {

/// Whether some point of a box is behind each of these planes, and not in it. By a linear program in four unknowns, the
/// point and how far it is behind all of them, one plane after another. Degenerate: half-spaces that touch have none.
/// Cost: a number of steps in proportion to the planes, as expected over their order, which is drawn. Exact: yes.
/// Ref: Seidel 1991, Small-Dimensional Linear Programming and Convex Hulls Made Easy. Proof: P-88c
bool have_common_inside(const std::vector<Exact_plane>& planes, const std::array<Exact_point, 2>& box);

}  // namespace sightline
