#include <sightline/algorithms/weak_visibility/settle.h>

#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <limits>
#include <utility>

namespace sightline {
namespace {

constexpr std::size_t thorough_cells = 300;  // few that more would decide, and those take minutes
constexpr int thorough_bisections = 40;

struct Cell {
  Near_polygon source, target;
  std::vector<Open_cell::Side> sides;
};

/// The first open cells of a pair.
std::vector<Cell> cells_of_proof(const Occluders& occluders, const Weak_source& source,
                                 const Weakly_visible::Pair& pair, std::size_t most) {
  std::vector<Cell> found;
  std::vector<Cell> waiting{
      {source.polygon, occluders.polygon(pair.piece), {}}};  // the second parts, and the cell at hand on top
  for (const Weak_step& step : pair.answer.proof) {
    if (found.size() == most) break;
    Cell cell = std::move(waiting.back());
    waiting.pop_back();
    switch (step.kind) {
      case Weak_step::Kind::line:
        for (const int sign : {-1, 1}) {
          Cell& part = waiting.emplace_back(cell);
          part.sides.push_back({pair.answer.lines[step.index], sign});
        }
        break;
      case Weak_step::Kind::cut_source:
      case Weak_step::Kind::cut_target:
        for (const bool front : {false, true}) {
          Cell& part = waiting.emplace_back(cell);
          Near_polygon& polygon = step.kind == Weak_step::Kind::cut_source ? part.source : part.target;
          polygon = clip(occluders.frame(), polygon, near_plane(occluders.frame(), step.plane), front);
        }
        break;
      case Weak_step::Kind::open: found.push_back(std::move(cell)); break;
      case Weak_step::Kind::blocked:
      case Weak_step::Kind::empty:
      case Weak_step::Kind::away: break;
    }
  }
  return found;
}

/// Adds what another search found of faces that were undecided; `open` stays for whoever calls.
void add_decided(Weakly_visible& found, Weakly_visible&& more) {
  for (const Weak_status status : {Weak_status::visible, Weak_status::hidden}) {
    std::vector<Face_id>&all_of = found.of(status), &own = more.of(status);
    const auto middle = all_of.insert(all_of.end(), own.begin(), own.end());
    std::inplace_merge(all_of.begin(), middle, all_of.end());
  }
  std::move(more.pairs.begin(), more.pairs.end(), std::back_inserter(found.pairs));
  std::stable_sort(found.pairs.begin(), found.pairs.end(),
                   [](const auto& a, const auto& b) { return a.piece < b.piece; });
  found.undecided = std::move(more.undecided);
  found.counters += more.counters;
}

}  // namespace

std::vector<Open_cell> open_cells(const Occluders& occluders, const Weak_source& source,
                                  const Weakly_visible::Pair& pair, std::size_t most) {
  const auto points_of = [&](const Near_polygon& polygon) {
    std::vector<Exact_point> points;
    for (const Near_point& p : polygon) points.push_back(occluders.scene().position(p.exact));
    return points;
  };
  std::vector<Open_cell> found;
  for (Cell& cell : cells_of_proof(occluders, source, pair, most))
    found.push_back({points_of(cell.source), points_of(cell.target), std::move(cell.sides)});
  return found;
}

std::size_t edges_between(const Occluders& occluders, const Near_polygon& source, const Near_polygon& target) {
  std::size_t edges = 0;
  for (const std::uint32_t near : occluders.near_shaft(source, target)) edges += occluders.size(near);
  return edges;
}

Events_answer open_pair_by_events(const Occluders& occluders, const Weak_source& source,
                                  const Weakly_visible::Pair& pair, std::size_t most_edges,
                                  const Events_options& options, Event_counters& counters) {
  if (edges_between(occluders, source, pair.piece) <= most_edges)
    return weakly_visible_by_events(occluders, source, pair.piece, options, counters);
  struct Parts {
    Near_polygon source, target;
  };
  const auto same = [](const Near_polygon& a, const Near_polygon& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Near_point& p, const Near_point& q) { return p.exact == q.exact; });
  };
  std::vector<Parts> all;
  for (Cell& cell : cells_of_proof(occluders, source, pair, pair.answer.proof.size())) {
    if (cell.source.size() < 3 || cell.target.size() < 3) continue;  // no line
    if (std::any_of(all.begin(), all.end(), [&](const Parts& parts) {
          return same(parts.source, cell.source) && same(parts.target, cell.target);
        }))
      continue;
    if (has_run_out(options.out_of_time)) return {};
    if (edges_between(occluders, cell.source, cell.target) > most_edges) return {};
    all.push_back({std::move(cell.source), std::move(cell.target)});
  }
  Events_answer answer;
  answer.status = Weak_status::hidden;
  for (Parts& parts : all) {
    const Events_answer found = part_visible_by_events(occluders, {std::move(parts.source), source.plane}, parts.target,
                                                       pair.piece, options, counters);
    if (found.status == Weak_status::visible) return found;
    if (found.status == Weak_status::undecided) answer = found;
  }
  return answer;
}

Weak_answer weak_answer(const Events_answer& found) {
  Weak_answer answer;
  answer.status = found.status;
  if (found.status == Weak_status::visible) answer.sightline.assign(found.sightline.begin(), found.sightline.end());
  return answer;
}

void search_thoroughly(const Occluders& occluders, const std::vector<Weak_source>& sources, Weak_options search,
                       Weakly_visible& found) {
  if (found.undecided.empty()) return;
  search.faces = found.undecided;
  search.together_after = {};  // what is left touches something, one here, one there
  search.search.thorough = true;
  search.search.rays = 0;
  search.search.open = 1;
  search.search.cells = std::min(search.search.cells, thorough_cells);
  search.search.bisections = thorough_bisections;
  add_decided(found, weakly_visible(occluders, sources, search));
  const auto is_undecided = [&](const Weakly_visible::Pair& pair) {
    const Face_id face = occluders.scene().pieces()[pair.piece].face;
    return std::binary_search(found.undecided.begin(), found.undecided.end(), face);
  };
  std::erase_if(found.open, [&](const Weakly_visible::Pair& pair) { return !is_undecided(pair); });
}

Event_counters decide_the_rest(const Occluders& occluders, const std::vector<Weak_source>& sources, Weak_options search,
                               std::size_t most_edges, Events_options events, Weakly_visible& found) {
  constexpr std::size_t few_events = 1000000;
  std::size_t all_edges = 0;
  for (std::uint32_t piece = 0; piece < occluders.scene().pieces().size(); ++piece) all_edges += occluders.size(piece);
  Event_counters counters;
  for (std::size_t most = few_events; !found.undecided.empty() && !has_run_out(events.out_of_time); most = 16 * most) {
    // 1. Events, as many as are soon looked at: where lines touch edges, cells never suffice.
    const bool all = most_edges >= all_edges;
    events.events = all ? std::numeric_limits<std::size_t>::max() : most;
    counters += settle_by_events(occluders, sources, all_edges, events, found);
    if (all || found.undecided.empty()) break;

    // 2. More cells.
    most_edges *= 2;
    search.search.cells *= 4;
    search.search.open *= 4;
    search.search.bisections += 4;
    search.faces = found.undecided;
    Weakly_visible more = weakly_visible(occluders, sources, search);
    found.open = std::move(more.open);
    add_decided(found, std::move(more));
  }
  return counters;
}

Event_counters settle_by_events(const Occluders& occluders, const std::vector<Weak_source>& sources,
                                std::size_t most_edges, const Events_options& options, Weakly_visible& found) {
  struct Settled {
    Face_id face;
    Weak_status status = Weak_status::hidden;
    std::vector<Weakly_visible::Pair> pairs;  // those that stay open, or the one with a sightline
    Event_counters counters;
  };
  if (found.open.empty() || has_run_out(options.out_of_time)) return {};
  // 1. The pairs of each face.
  std::vector<Settled> faces;
  for (Weakly_visible::Pair& pair : found.open) {
    const Face_id face = occluders.scene().pieces()[pair.piece].face;
    if (faces.empty() || faces.back().face != face) faces.emplace_back().face = face;
    faces.back().pairs.push_back(std::move(pair));
  }

  // 2. Events.
  std::atomic<std::size_t> done{0};
  const auto settle = [&](Settled& face) {
    std::vector<Weakly_visible::Pair> open;
    for (Weakly_visible::Pair& pair : face.pairs) {
      if (options.progress) options.progress(done.load(), faces.size());
      const Events_answer answer =
          has_run_out(options.out_of_time)
              ? Events_answer{}
              : open_pair_by_events(occluders, sources[pair.source], pair, most_edges, options, face.counters);
      if (answer.status == Weak_status::hidden) continue;
      if (answer.status == Weak_status::visible) {
        open.clear();
        open.push_back({pair.piece, pair.source, weak_answer(answer)});
        face.status = answer.status;
        break;
      }
      face.status = Weak_status::undecided;
      open.push_back(std::move(pair));
    }
    face.pairs = std::move(open);
    ++done;
  };
  run_with_threads(options.threads, [&] { parallel_for(faces.size(), [&](std::size_t f) { settle(faces[f]); }); });

  // 3. Faces and pairs to where they belong, in order.
  Event_counters counters;
  found.undecided.clear();
  found.open.clear();
  for (Settled& face : faces) {
    counters += face.counters;
    found.of(face.status).push_back(face.face);
    if (face.status == Weak_status::hidden) found.unproved.push_back(face.face);
    auto& pairs = face.status == Weak_status::visible ? found.pairs : found.open;
    std::move(face.pairs.begin(), face.pairs.end(), std::back_inserter(pairs));
  }
  for (std::vector<Face_id>* list : {&found.visible, &found.hidden, &found.unproved})
    std::sort(list->begin(), list->end());
  std::stable_sort(found.pairs.begin(), found.pairs.end(),
                   [](const auto& a, const auto& b) { return a.piece < b.piece; });
  return counters;
}

}  // namespace sightline
