#include <sightline/algorithms/weak_visibility/partition/seen_part.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace sightline {
namespace {

/// The part where a plane's sign is `sense`, its new edge on `line`; empty where that has no area.
Seen_part::Polygon clipped(const Seen_part::Polygon& polygon, const std::vector<Integer>& heights, int sense,
                           std::uint32_t line) {
  Seen_part::Polygon part;
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    const int from = sense * sgn(heights[i]), to = sense * sgn(heights[next]);
    inside |= from > 0;
    if (from >= 0) part.push_back(polygon[i]);
    if (from >= 0 && to < 0 && from == 0) part.back().line = line;
    if (from * to >= 0) continue;
    const Integer at = abs(heights[i]), after = abs(heights[next]);
    Homogeneous x;
    Integer common = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      x[k] = after * polygon[i].at[k] + at * polygon[next].at[k];
      common = gcd(common, x[k]);
    }
    for (Integer& c : x) c /= common;
    part.push_back({std::move(x), from > 0 ? line : polygon[i].line});
  }
  return inside ? part : Seen_part::Polygon{};
}

/// What of a polygon is left without the inside of a convex set: in convex parts, appended. Returns whether any of it
/// was taken away.
bool subtract(Seen_part::Polygon polygon, std::span<const Event_lines::Literal> literals,
              std::span<const Homogeneous> planes, std::vector<Seen_part::Polygon>& left) {
  std::vector<Seen_part::Polygon> outside;
  const Seen_part::Polygon whole = polygon;
  std::vector<Integer> heights;
  for (std::size_t k = 0; k < literals.size(); ++k) {
    heights.clear();
    bool in = false, out = false;
    for (const Seen_part::Corner& corner : polygon) {
      heights.push_back(dot(planes[k], corner.at));
      // The side of the line from the point to the corner is minus that.
      const int holds = -literals[k].sense * sgn(heights.back());
      in |= holds > 0;
      out |= holds < 0;
    }
    if (!in) {  // nothing is taken away
      left.push_back(whole);
      return false;
    }
    if (!out) continue;
    outside.push_back(clipped(polygon, heights, literals[k].sense, literals[k].line));
    polygon = clipped(polygon, heights, -literals[k].sense, literals[k].line);
  }
  std::move(outside.begin(), outside.end(), std::back_inserter(left));
  return true;
}

}  // namespace

Seen_part::Seen_part(const Event_lines& lines, const Homogeneous& point, std::span<const std::uint32_t> blockers) {
  Polygon& source = parts_.emplace_back();
  for (std::size_t i = 0; i < lines.target().size(); ++i)
    source.push_back({lines.target()[i].exact, lines.to()[i].line});
  std::vector<Homogeneous> planes;
  for (const std::uint32_t b : blockers) {
    const std::vector<Event_lines::Literal>& literals = lines.blockers()[b].literals;
    planes.clear();
    for (const Event_lines::Literal& literal : literals)
      planes.push_back(join(point, lines.lines()[literal.line].pluecker));
    std::vector<Polygon> left;
    for (Polygon& part : parts_) cut_ |= subtract(std::move(part), literals, planes, left);
    parts_ = std::move(left);
    if (parts_.empty()) return;
  }
}

std::vector<std::uint32_t> Seen_part::outline() const {
  // Of each line, the ends of edges on it less their beginnings: nothing is left of what two parts share.
  std::map<std::uint32_t, std::map<Homogeneous, int, Less_entries>> ends;
  for (const Polygon& part : parts_)
    for (std::size_t i = 0; i < part.size(); ++i) {
      Homogeneous from = part[i].at, to = part[(i + 1) % part.size()].at;
      make_canonical(from);
      make_canonical(to);
      std::map<Homogeneous, int, Less_entries>& of_line = ends[part[i].line];
      --of_line[from];
      ++of_line[to];
    }
  std::vector<std::uint32_t> found;
  for (const auto& [line, of_line] : ends)
    if (std::any_of(of_line.begin(), of_line.end(), [](const auto& end) { return end.second != 0; }))
      found.push_back(line);
  return found;
}

}  // namespace sightline
