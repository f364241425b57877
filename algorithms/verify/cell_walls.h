#pragma once
// The walls of a cell of a level, for the checks of levels. To be read after weak_lines.h and before level_cell.cpp.

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/weak_lines.h>

#include <vector>

namespace sightline::level_check {

using certificate_check::Homogeneous;
using certificate_check::Polygon;
using weak_check::Outline;

/// The planes that stand on a convex polygon's edges, its inside in front of them.
std::vector<Homogeneous> edge_planes(const Outline& polygon);

/// Rejects unless the polygons, counterclockwise as seen from outside, bound a convex polyhedron that has an inside.
/// Proof: P-88b
std::vector<Outline> outlines_of_walls(const std::vector<Polygon>& walls);

/// Whether a polygon in a wall's plane, either way round, is within the wall.
bool is_within(const Outline& polygon, const Outline& wall);

}  // namespace sightline::level_check
