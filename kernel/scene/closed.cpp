#include <sightline/kernel/scene/closed.h>

#include <sightline/kernel/line_table.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_map>

namespace sightline {

Closure closure(const Scene& scene) {
  Line_table lines(scene.points());
  std::unordered_map<std::uint64_t, long>
      net;  // arrivals - departures by (line, point), along the line's canonical direction
  for (const Piece& piece : scene.pieces()) {
    const std::span<const Piece_corner> corners = scene.corners(piece);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t p = corners[k].point, q = corners[k + 1 == corners.size() ? 0 : k + 1].point;
      const std::uint64_t line = std::uint64_t{lines.through(p, q).id} << 32;
      --net[line | p];
      ++net[line | q];
    }
  }
  return {std::all_of(net.begin(), net.end(), [](const auto& entry) { return entry.second == 0; }), lines.size()};
}

}  // namespace sightline
