#include <sightline/algorithms/weak_visibility/events/events.h>

#include <sightline/algorithms/weak_visibility/events/event_cells.h>
#include <sightline/algorithms/weak_visibility/events/event_lines.h>
#include <sightline/algorithms/weak_visibility/events/event_shaft.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <random>
#include <utility>

namespace sightline {
namespace {

/// Events of the shaft as a whole, and their surfaces.
Events_answer with_surfaces(const Occluders& occluders, const Near_polygon& source, const Near_plane& source_plane,
                            const Near_polygon& target, const Near_plane& target_plane, int beside,
                            const Events_options& options, Event_counters& counters,
                            const std::function<void(const Event_search::Surface&)>& keep) {
  const Event_lines lines(occluders, source, source_plane, target, target_plane, beside, options.out_of_time);
  Event_search search(occluders, lines, options, counters);
  const Events_answer found = search.run();
  if (keep) std::for_each(search.surfaces().begin(), search.surfaces().end(), keep);
  return found;
}

}  // namespace

Events_answer part_visible_by_events(const Occluders& occluders, const Weak_source& source, const Near_polygon& part,
                                     std::uint32_t piece, const Events_options& options, Event_counters& counters,
                                     const std::function<void(const Event_search::Surface&)>& keep) {
  ++counters.targets;
  const Near_plane& target_plane = occluders.plane(piece);
  const Near_polygon target = clip(occluders.frame(), part, source.plane, true);
  std::mt19937_64 dice(options.seed * 0x9e3779b97f4a7c15u + piece);
  const auto inner_point = [&](const Near_polygon& polygon) {
    Homogeneous sum{0, 0, 0, 0};
    for (const Near_point& corner : polygon) {
      const unsigned long weight = 1 + static_cast<unsigned long>(dice() >> 54);
      for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * corner.exact[k];
    }
    return near_point(occluders.frame(), sum);
  };
  const auto out_of_time = [&] { return has_run_out(options.out_of_time); };
  Events_answer answer;
  answer.status = Weak_status::hidden;
  std::size_t sides = 0;
  for (const int beside : {1, -1}) {
    if (beside < 0 && !options.two_sided) continue;
    const Near_polygon from = clip(occluders.frame(), source.polygon, target_plane, beside > 0);
    if (from.size() < 3 || target.size() < 3) continue;
    ++sides;
    for (int k = 0; k < options.rays && !options.surfaces && !out_of_time(); ++k) {
      const std::array<Near_point, 2> line{inner_point(from), inner_point(target)};
      if (occluders.blocker(line[0], line[1], source.plane, target_plane)) continue;
      ++counters.by_rays;
      return {Weak_status::visible, line};
    }
    if (out_of_time()) {
      if (answer.status == Weak_status::hidden) answer.status = Weak_status::undecided;
      break;
    }
    const Events_answer found =
        options.surfaces
            ? with_surfaces(occluders, from, source.plane, target, target_plane, beside, options, counters, keep)
            : search_shaft(occluders, from, source.plane, target, target_plane, beside, options, counters);
    if (found.status == Weak_status::visible && !options.surfaces) return found;
    if (answer.status != Weak_status::visible && found.status != Weak_status::hidden) answer = found;
  }
  if (sides == 0) ++counters.away;
  return answer;
}

Weakly_visible_by_events weakly_visible_by_events(const Occluders& occluders, const std::vector<Weak_source>& sources,
                                                  const Events_options& options) {
  struct Result {
    Weak_status status = Weak_status::hidden;
    Weakly_visible_by_events::Pair pair;
    std::vector<Event_surface> surfaces;
    Event_counters counters;
  };
  const std::vector<Piece>& pieces = occluders.scene().pieces();
  const std::vector<std::uint32_t> first = first_pieces(pieces);
  std::vector<Result> results(first.size());
  const auto decide = [&](std::size_t f, std::uint32_t begin, std::uint32_t end) {
    Result& result = results[f];
    const auto is_settled = [&] { return result.status == Weak_status::visible && !options.surfaces; };
    for (std::uint32_t piece = begin; piece < end && !is_settled(); ++piece)
      for (std::uint32_t s = 0; s < sources.size() && !is_settled(); ++s) {
        const auto keep = [&](const Event_search::Surface& surface) {
          Event_surface& kept = result.surfaces.emplace_back(Event_surface{surface.kind, piece, s, {}});
          for (const auto& [p, q] : surface.rulings)
            kept.rulings.push_back({occluders.scene().position(p), occluders.scene().position(q)});
        };
        const Events_answer answer =
            weakly_visible_by_events(occluders, sources[s], piece, options, result.counters, keep);
        if (answer.status != Weak_status::hidden && result.status != Weak_status::visible) {
          result.status = answer.status;
          result.pair = {piece, s, answer};
        }
      }
  };
  for_each_face(pieces, first, options.threads, options.progress, decide);

  Weakly_visible_by_events all;
  for (std::size_t f = 0; f < first.size(); ++f) {
    Result& result = results[f];
    all.of(result.status).push_back(pieces[first[f]].face);
    if (result.status == Weak_status::visible) all.sightlines.push_back(std::move(result.pair));
    all.counters += result.counters;
    std::move(result.surfaces.begin(), result.surfaces.end(), std::back_inserter(all.surfaces));
  }
  return all;
}

}  // namespace sightline
