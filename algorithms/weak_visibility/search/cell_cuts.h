#pragma once
// Planes that cut the polygons of a cell which holds neither a line nor a proof as it is.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/search/line_cell.h>
#include <sightline/algorithms/weak_visibility/search/matrix_game.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace sightline {

/// A plane across the source, or the target, that a cell is cut by.
struct Cell_cut {
  bool source;
  Near_plane plane;
};

/// A plane that holds two of the cell's lines and cuts a polygon: the sides of lines in one plane depend on where one
/// crosses it, so that lines near the plane never resolve while their ends are on both sides of it. Exact: yes.
std::optional<Cell_cut> common_plane(const Line_cell& cell, const Occluders& occluders);

/// Planes parallel to edges, each with none of the cell's lines behind it, by doubles; none where together they leave
/// four fifths of the polygons. Pre: `game` is the cell's relaxation, solved.
std::vector<Cell_cut> shaves(const Line_cell& cell, Matrix_game<double>& game, const Near_frame& frame,
                             Weak_counters& counters);

/// A plane across the longest diagonal of the longer one of the two polygons, through its middle; none where doubles
/// cannot tell its ends apart.
std::optional<Cell_cut> bisector(const Line_domain& domain, const Near_frame& frame);

}  // namespace sightline
