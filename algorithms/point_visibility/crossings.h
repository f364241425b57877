#pragma once
// Where faces cross: the lines along which the surfaces of a scene go through each other. No eye is asked for.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace sightline {

/// Where a stretch of a line ends: at a point of the scene (p = q), or on the edge between two.
struct Crossing_end {
  std::uint32_t p, q;
  std::array<Integer, 4> at;  ///< homogeneous grid coordinates, the last one positive
};

/// An open segment of which all points but finitely many are inside the surfaces of the same two planes or more.
struct Crossing {
  std::vector<Face_id> faces;         ///< that hold it, in these planes; ascending
  std::vector<std::uint32_t> pieces;  ///< one in each of the planes
  std::array<Crossing_end, 2> ends;
  /// Of the line, not within the segment: ends of pieces in the plane of the first one, of whatever faces.
  std::array<Crossing_end, 2> beyond;
};

/// Where faces cross. All pieces in one plane are one surface, however faces share it out; a point is listed that is
/// inside two such surfaces or more, up to finitely many. So the same points are listed in any order of the faces, and
/// if a face is cut in two. Each segment once, as long as the faces that hold it are the same. Degenerate: a face that
/// ends on another one does not cross it; a line along a fold of a face that is not planar is none of that face.
/// Cost: follows the pairs of pieces whose boxes meet. Exact: yes. Proof: P-65
std::vector<Crossing> crossings(const Scene& scene, const Piece_boxes& boxes);

/// The same up to what is not on some of the pieces: each point of these (closed) that crossings() lists is listed,
/// with the same faces, but finitely many; of others some are, perhaps with fewer faces. Pre: for each piece whether it
/// is one. Cost: follows the pairs of which one is among the pieces, or is in the plane of one or holds its edge.
/// `go_on` is asked now and again, and may end it by what it throws. Exact: yes. Proof: P-65
std::vector<Crossing> crossings_on(const std::vector<bool>& pieces, const Scene& scene, const Piece_boxes& boxes,
                                   const std::function<void()>& go_on = {});

}  // namespace sightline
