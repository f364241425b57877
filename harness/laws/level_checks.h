#pragma once
// What checks of levels share.

#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sightline::harness::levels_subject {

inline constexpr std::size_t most_undecided_cells = 3000;  ///< of a search; more are for `fuzz weak`

/// How tables are asked for: one thread, with the outside or without.
Pvs_options options_of(Random& random);

/// A tree of planes along axes and through points of the scene: some miss what those above leave, some come twice.
Space_tree any_tree(const Polygon_soup& soup, Random& random);

/// The box about all corners of faces.
std::array<Exact_point, 2> box_of_corners(const Polygon_soup& soup);

/// Six times the volume of the cone from the origin to a polygon, positive where its front looks away.
Rational six_cones(const generate::Points& polygon);

/// A random point of a cell's inside.
Exact_point any_point_of(const Level_cells& level, Cell_id cell, Random& random);

/// Whether a wall between two cells has an open part.
bool have_a_way(const Level_cells& level, Cell_id a, Cell_id b);

// ---- Cells together

/// Walls between cells of a set and others, or the end of the world, each with the cell of the set.
std::vector<std::pair<std::uint32_t, Cell_id>> walls_about(const Level_cells& level, const std::vector<Cell_id>& cells);
/// Their open parts, as sources that look out of the set.
std::vector<generate::Points> portals_about(const Level_cells& level, const std::vector<Cell_id>& cells);
/// A set of cells as a closed polyhedron, fronts outwards.
Polygon_soup polyhedron(const Level_cells& level, const std::vector<Cell_id>& cells);

/// What a set of cells that is convex together sees, asked of it alone: what portals see outwards, and what the
/// polyhedron sees from within.
Weakly_visible seen_alone(const Level_cells& level, const Occluders& occluders, const std::vector<Cell_id>& cells);

}  // namespace sightline::harness::levels_subject
