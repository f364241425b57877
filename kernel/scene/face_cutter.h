#pragma once
// One face after another, cut into convex pieces on its own points, with the planes of the pieces and of their edges.

#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/scene/pieces.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/set_aside.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace sightline {

using Point_loop = std::vector<std::uint32_t>;  ///< points of the grid, one after the other; the first follows the last

/// Whether pieces get the planes through their edges at once, or by bound_piece(), if they are asked for at all.
enum class Piece_bounds { at_once, left_out };

/// Adds the convex pieces of a face to `faces`, and what there is to list and to count of it; or says why it has none,
/// which is for the caller to note. Planar faces are cut as convex_parts() does, others into triangles, along the first
/// axis that can.
/// Pre: loops[0] is the contour; no point follows itself; all are of the grid that the planes of `faces` are of.
/// Cost: O(k) for k points of a convex face, else O(k log k) on usual input, and O(k^2) for one that is not planar and
/// that no projection makes simple. Exact: yes. Proof: P-00, P-02, P-05
std::optional<Set_aside_reason> cut_face(const Grid_points& points, Face_id f, const std::vector<Point_loop>& loops,
                                         Scene_faces& faces, Piece_bounds edges = Piece_bounds::at_once);

/// Makes the planes through a piece's edges, if they were left out. Exact: yes. Proof: P-05
void bound_piece(const Grid_points& points, Scene_faces& faces, std::size_t piece);

}  // namespace sightline
