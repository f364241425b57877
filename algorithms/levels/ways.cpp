#include <sightline/algorithms/levels/ways.h>

#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>

#include <algorithm>
#include <utility>

namespace sightline::levels_detail {

Way_line::Way_line(const Triple& p, const Triple& q)
    : pair(pluecker_of_pair(p, q)), ends(sightline::ends(size(p), size(q))) {}

bool comes_through(const Way& way, const Way_line& line) {
  for (std::size_t i = 0; i < way.edges.size(); ++i) {
    const double side = dot(line.pair, way.edges[i]), error = side_error(line.ends, way.ends[i]);
    if (!(side < -error)) return false;
  }
  return true;
}

std::vector<Exact_point> looking_from(const Level_cells& level, const Cell_wall& wall,
                                      const std::vector<std::uint32_t>& part, Cell_id from) {
  std::vector<Exact_point> polygon = level.polygon(part);
  if (wall.front == from) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

Ways::Ways(const Level_cells& level, const Occluders& occluders, bool outside, const std::function<bool()>& out_of_time)
    : is_asked_(asked_cells(level, outside)),
      cells_asked_(is_asked_.size() - static_cast<std::size_t>(std::count(is_asked_.begin(), is_asked_.end(), 0))) {
  into_.resize(is_asked_.size());
  for (const Cell_wall& wall : level.walls()) {
    if (wall.behind == no_cell || is_asked_[wall.front] == 0 || is_asked_[wall.behind] == 0) continue;
    if (is_whole_ = !out_of_time || !out_of_time(); !is_whole_) return;
    for (const std::vector<std::uint32_t>& part : wall.open)
      for (const Cell_id from : {wall.front, wall.behind})
        add(from, from == wall.front ? wall.behind : wall.front,
            weak_source(occluders, looking_from(level, wall, part, from)));
  }
}

void Ways::add(Cell_id from, Cell_id to, Weak_source source) {
  into_[to].push_back(ways_.size());
  Way& way = ways_.emplace_back(Way{from, to, std::move(source), {}, {}});
  const Near_polygon& corners = way.source.polygon;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Triple &a = corners[i].near, &b = corners[(i + 1) % corners.size()].near;
    way.edges.push_back(pluecker_of_edge(a, b));
    way.ends.push_back(ends(size(a), size(b)));
  }
}

Weak_answer visible_at_any_cost(const Occluders& occluders, const Weak_source& source, Face_id face,
                                const Pvs_options& options) {
  Weak_options search;
  search.search = options.search;
  search.faces = {face};
  search.threads = 1;
  const std::vector<Weak_source> sources{source};
  Weakly_visible found = weakly_visible(occluders, sources, search);
  search_thoroughly(occluders, sources, search, found);
  Events_options events;
  events.two_sided = options.search.two_sided;
  events.seed = options.search.seed;
  events.threads = 1;
  events.out_of_time = options.search.out_of_time;
  settle_by_events(occluders, sources, options.event_edges, events, found);
  if (!found.undecided.empty()) decide_the_rest(occluders, sources, search, options.event_edges, events, found);
  Weak_answer answer = nothing_known();
  if (!found.hidden.empty()) answer.status = Weak_status::hidden;
  for (const Weakly_visible::Pair& pair : found.pairs)
    if (pair.answer.status == Weak_status::visible) answer = pair.answer;
  return answer;
}

}  // namespace sightline::levels_detail
