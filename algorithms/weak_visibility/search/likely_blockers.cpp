#include <sightline/algorithms/weak_visibility/search/likely_blockers.h>

#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace sightline {
namespace {

constexpr double on_plane = 1e-12;

/// The lines from the corners of a source to those of a box.
struct Lines_to_box {
  std::vector<Triple> from;
  std::array<Triple, 8> to;
  std::vector<Pluecker> pairs;

  Lines_to_box(const Near_polygon& source, const Piece_boxes::Box& box, double to_boxes) {
    for (const Near_point& p : source) from.push_back(p.near);
    for (std::size_t c = 0; c < to.size(); ++c)
      for (std::size_t k = 0; k < 3; ++k) to[c][k] = ((c >> k & 1) != 0 ? box.high[k] : box.low[k]) / to_boxes;
  }
  Triple middle_from() const { return middle(from); }
  Triple middle_to() const { return middle(to); }
  bool all_behind(const Near_plane& h) const {
    return std::all_of(to.begin(), to.end(), [&](const Triple& q) { return likely_value(h.near, q) < -on_plane; });
  }
  bool blocked_by(const Occluders& occluders, std::uint32_t piece) {
    const Near_plane& h = occluders.plane(piece);
    const double sense = likely_value(h.near, from[0]) > 0 ? 1 : -1;
    // 1. Its plane is between them, as that of the source itself is not.
    const auto on_side = [&](double side) {
      return [&h, side](const Triple& p) { return side * likely_value(h.near, p) > on_plane; };
    };
    if (!std::all_of(from.begin(), from.end(), on_side(sense)) || !std::all_of(to.begin(), to.end(), on_side(-sense)))
      return false;
    // 2. No line passes outside of an edge, as one does of most pieces.
    if (pairs.empty())
      for (const Triple& p : from)
        for (const Triple& q : to) pairs.push_back(pluecker_of_pair(p, q));
    for (const Pluecker& edge : occluders.edges(piece))
      for (const Pluecker& pair : pairs)
        if (!(sense * dot(pair, edge) > -on_plane)) return false;
    return true;
  }

 private:
  template <class Points>
  static Triple middle(const Points& points) {
    Triple sum{};
    for (const Triple& p : points)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k] / static_cast<double>(points.size());
    return sum;
  }
};

}  // namespace

std::vector<std::uint32_t> likely_blockers(const Occluders& occluders, const Weak_source& source,
                                           const std::function<bool()>& out_of_time) {
  std::vector<std::uint32_t> likely(occluders.scene().pieces().size(), no_blocker);
  const Piece_boxes& boxes = occluders.boxes();
  const std::span<const Piece_boxes::Node> nodes = boxes.nodes();
  std::vector<std::uint32_t> waiting;
  if (!nodes.empty()) waiting.push_back(0);
  while (!waiting.empty() && !has_run_out(out_of_time)) {
    const std::uint32_t at = waiting.back();
    waiting.pop_back();
    const Piece_boxes::Node& node = nodes[at];
    Lines_to_box lines(source.polygon, node.box, occluders.frame().to_boxes());
    if (lines.all_behind(source.plane)) continue;
    const std::optional<std::uint32_t> blocker = occluders.on_segment(
        {lines.middle_from(), lines.middle_to()},
        [&](std::uint32_t piece) { return lines.blocked_by(occluders, piece); },
        Occluders::segments_between({lines.from[0], lines.from[lines.from.size() / 2]}, {lines.to[0], lines.to[7]}));
    if (blocker) {
      for (std::uint32_t k = 0; k < node.count; ++k) likely[boxes.chunks()[node.first + k].piece] = *blocker;
    } else if (node.second != 0) {
      waiting.push_back(node.second);
      waiting.push_back(at + 1);
    }
  }
  return likely;
}

}  // namespace sightline
