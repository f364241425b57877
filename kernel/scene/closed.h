#pragma once
// Whether the faces of a scene bound a solid.

#include <sightline/kernel/line_table.h>
#include <sightline/kernel/scene/scene.h>

namespace sightline {

/// The lines that the pieces' edges lie on, and whether the pieces close up.
struct Closure {
  bool closed = false;
  std::size_t lines = 0;
};

/// Whether the oriented boundary of all pieces together is zero, so that every point off the faces has a winding
/// number. T-junctions, cracks of width zero and interpenetration are fine; a missing, doubled or turned face is not.
/// On each line the segments of all boundaries, with sign, form a chain; it is zero iff arrivals equal departures at
/// each point of the line. Degenerate: an empty scene is closed. Cost: O(edges). Exact: yes. Proof: P-08
inline Closure closure(const Scene& scene) {
  Line_table lines(scene.points());
  std::unordered_map<std::uint64_t, long>
      net;  // arrivals - departures by (line, point), along the line's canonical direction
  for (const Piece& piece : scene.pieces()) {
    const std::span<const Piece_corner> corners = scene.corners(piece);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t p = corners[k].point, q = corners[k + 1 == corners.size() ? 0 : k + 1].point;
      const std::uint64_t line = std::uint64_t{lines.through(p, q).id} << 32;
      --net[line | p], ++net[line | q];
    }
  }
  return {std::all_of(net.begin(), net.end(), [](const auto& entry) { return entry.second == 0; }), lines.size()};
}

}  // namespace sightline
