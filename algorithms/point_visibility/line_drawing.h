#pragma once
// A line drawing of what an eye sees: edges of the scene, and lines where faces cross, visible and hidden.

#include <sightline/algorithms/point_visibility/hidden_lines.h>

#include <array>
#include <vector>

namespace sightline {

/// A line of the drawing, in the file's coordinates.
struct Drawn_line {
  std::array<Exact_point, 2> ends;
  const char* kind;              ///< boundary, silhouette, smooth, crease; intersection: where faces cross
  std::vector<Face_id> faces;    ///< that it bounds; that cross there
  std::vector<Line_part> parts;  ///< from one end to the other, one after the other

  Exact_point at(const Rational& t) const;  ///< ends[0] + t (ends[1] - ends[0])
};

/// Edges of the scene of which something is within the surface's cones, then what is seen of lines where faces cross.
/// Pre: surface and boxes are the view's. Threads, progress: as of hidden_lines(). Exact: yes. Proof: P-64, P-65
std::vector<Drawn_line> line_drawing(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                     const Piece_boxes& boxes, int threads = 0, const Line_progress& progress = {});

}  // namespace sightline
