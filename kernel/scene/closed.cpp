#include <sightline/kernel/scene/closed.h>

#include <sightline/kernel/line_table.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <span>
#include <unordered_map>

namespace sightline {

std::optional<Face_id> face_repeated_by(const Set_aside& entry) {
  if (entry.reason != Set_aside_reason::duplicate) return std::nullopt;
  Face_id face = 0;
  const char* const end = entry.why.data() + entry.why.size();
  std::from_chars(entry.why.data() + text_of(entry.reason).size(), end, face);
  return face;
}

std::vector<int> times_given(const Scene& scene) {
  std::unordered_map<Face_id, int> more;
  for (const Set_aside& entry : scene.set_aside())
    if (const std::optional<Face_id> face = face_repeated_by(entry)) ++more[*face];
  std::vector<int> times;
  for (const Piece& piece : scene.pieces()) {
    const auto found = more.find(piece.face);
    times.push_back(found == more.end() ? 1 : 1 + found->second);
  }
  return times;
}

Closure closure(const Scene& scene) {
  Line_table lines(scene.points());
  std::unordered_map<std::uint64_t, long>
      net;  // arrivals - departures by (line, point), along the line's canonical direction
  const std::vector<int> times = times_given(scene);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::span<const Piece_corner> corners = scene.corners(scene.pieces()[i]);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t p = corners[k].point, q = corners[k + 1 == corners.size() ? 0 : k + 1].point;
      const std::uint64_t line = std::uint64_t{lines.through(p, q).id} << 32;
      net[line | p] -= times[i];
      net[line | q] += times[i];
    }
  }
  return {std::all_of(net.begin(), net.end(), [](const auto& entry) { return entry.second == 0; }), lines.size()};
}

}  // namespace sightline
