#include <sightline/algorithms/weak_visibility/events/edge_planes.h>

#include <sightline/algorithms/weak_visibility/events/event_curve.h>

#include <algorithm>
#include <span>
#include <utility>

namespace sightline {

bool Edge_planes::find(const std::function<bool()>& out_of_time) {
  const std::vector<Event_lines::Event_line>& lines = lines_->lines();
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    if (out_of_time()) return false;
    for (std::uint32_t j = i + 1; j < lines.size(); ++j) {
      const Event_lines::Event_line &a = lines[i], &b = lines[j];
      const bool is_passed = in_source_ ? a.in_source && b.in_source : a.in_source || b.in_source;
      if (!a.real || !b.real || is_passed || certain_side(a.near, b.near) != 0 ||
          sgn(side(a.pluecker, b.pluecker)) != 0)
        continue;
      const Homogeneous& off = (all_zero(join(b.hull[0].exact, a.pluecker)) ? b.hull[1] : b.hull[0]).exact;
      Homogeneous plane = join(off, a.pluecker);
      make_canonical(plane);
      Flat& flat = flats_[plane];
      for (const std::uint32_t edge : {i, j})
        if (std::find(flat.edges.begin(), flat.edges.end(), edge) == flat.edges.end()) flat.edges.push_back(edge);
      if (a.in_source || b.in_source) continue;
      Homogeneous at = meet(join(off_plane(plane), a.pluecker), b.pluecker);
      if (!Event_lines::in_hull(a, at) || !Event_lines::in_hull(b, at)) continue;
      make_canonical(at);
      vertices_[at].insert(plane);
      flat.points.insert(std::move(at));
    }
  }
  return true;
}

Edge_planes::Section Edge_planes::section_of(const Homogeneous& plane) const {
  Section found{{plane, near(near_plane(*frame_, plane))}, false, false, {}};
  // Where it only touches the target in a corner, that may be the point of a pencil.
  bool in_front = false, behind = false, touches = false;
  for (const Filtered& corner : lines_->target()) {
    const int at = sign_of_dot(found.plane, corner);
    (at > 0 ? in_front : at < 0 ? behind : touches) = true;
  }
  found.crosses_target = in_front && behind;
  if ((!in_front || !behind) && !touches) return found;
  // The segment in which it meets the source.
  std::vector<Homogeneous> ends;
  const std::span<const Filtered> source = lines_->source();
  std::vector<int> sides;
  for (const Filtered& corner : source) sides.push_back(sign_of_dot(found.plane, corner));
  for (std::size_t i = 0; i < source.size(); ++i) {
    const std::size_t next = (i + 1) % source.size();
    const Homogeneous &a = source[i].exact, &b = source[next].exact;
    if (sides[i] == 0) ends.push_back(a);
    if (sides[i] * sides[next] >= 0) continue;
    const Integer at = abs(dot(plane, a)), after = abs(dot(plane, b));
    Homogeneous x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = after * a[k] + at * b[k];
    make_canonical(x);
    ends.push_back(x);
  }
  found.is_usable = ends.size() == 2;
  if (found.is_usable)
    for (std::size_t k = 0; k < 2; ++k) found.ends[k] = point(ends[k]);
  return found;
}

Edge_planes::Points Edge_planes::points_in(const Homogeneous& plane, const Flat& flat, std::size_t& dropped) const {
  const Near<4> near_of_plane = near(near_plane(*frame_, plane));
  Points points = flat.points;
  for (const Event_lines::Event_line& line : lines_->lines()) {
    if (!line.real || line.in_source || certain_side(near_of_plane, line.hull) != 0) continue;
    Homogeneous at = meet(plane, line.pluecker);
    if (all_zero(at) || !Event_lines::in_hull(line, at)) continue;
    make_canonical(at);
    if (points.count(at) != 0) continue;
    const Filtered filtered = point(at);
    if (std::any_of(flat.edges.begin(), flat.edges.end(),
                    [&](std::uint32_t edge) { return may_pass(filtered, lines_->lines()[edge]); }))
      points.insert(std::move(at));
    else ++dropped;
  }
  return points;
}

Edge_planes::Planes Edge_planes::planes_through(const Filtered& vertex, std::size_t& dropped) const {
  Planes planes;
  for (const Event_lines::Event_line& line : lines_->lines()) {
    if (!line.real || (line.in_source && !in_source_)) continue;
    const Near<4> near_of_plane = join(vertex.near, line.near);
    if (certain_side(near_of_plane, lines_->target()) != 0 || certain_side(near_of_plane, lines_->source()) != 0 ||
        !may_pass(vertex, line)) {
      ++dropped;
      continue;
    }
    Homogeneous plane = join(vertex.exact, line.pluecker);
    if (all_zero(plane)) continue;
    make_canonical(plane);
    planes.insert(std::move(plane));
  }
  return planes;
}

bool Edge_planes::leads_nowhere(const Filtered& vertex) const {
  return sign_of_dot(lines_->source_plane(), vertex) <= 0 ||
         sign_of_dot(lines_->target_plane(), vertex) * lines_->beside() < 0;
}

bool Edge_planes::may_pass(const Filtered& vertex, const Event_lines::Event_line& line) const {
  const std::array<Near<6>, 2> between{join(vertex.near, line.hull[0].near), join(vertex.near, line.hull[1].near)};
  return lines_->may_pass(between, lines_->from()) && lines_->may_pass(between, lines_->to());
}

}  // namespace sightline
