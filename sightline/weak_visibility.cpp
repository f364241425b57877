#include <sightline/model_inside.h>
#include <sightline/told_text.h>

#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/algorithms/weak_visibility/along/certificate.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/conservative.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/kernel/time_limit.h>

#include <atomic>
#include <list>
#include <ostream>
#include <stdexcept>
#include <utility>

namespace sightline {

// ---- Weak visibility

namespace {

std::vector<Weak_source> weak_sources(const Occluders& occluders,
                                      const std::vector<std::vector<Exact_point>>& sources) {
  std::vector<Weak_source> polygons;
  for (const std::vector<Exact_point>& source : sources) polygons.push_back(weak_source(occluders, source));
  return polygons;
}

/// What was found of faces, with its certificate.
Weak_visibility weak_answer(const Model& model, const std::vector<std::vector<Exact_point>>& sources,
                            const Asking& asking, std::shared_ptr<const Weakly_visible> found) {
  auto certify = [inside = model.inside(), sources, found,
                  two_sided = asking.two_sided](const Asking::Progress& progress) {
    return told_text(progress, [&](std::ostream& out, const Asking::Progress&) {
      write_certificate(out, weak_certificate(inside->scene(), sources, two_sided, *found));
    });
  };
  return {Answer(std::move(certify)), found->visible, found->hidden, found->undecided};
}

/// Faces that are seen from polygons, by lines, and by events where that helps.
Weakly_visible seen_by_lines(const Occluders& occluders, const std::vector<Weak_source>& polygons,
                             const Asking& asking) {
  Weak_options options;
  options.threads = asking.threads;
  options.progress = asking.progress;
  options.search.two_sided = asking.two_sided;
  options.search.out_of_time = end_of_budget(asking);
  Weakly_visible found = weakly_visible(occluders, polygons, options);
  search_thoroughly(occluders, polygons, options, found);
  Events_options events;
  events.threads = asking.threads;
  events.progress = asking.progress;
  events.two_sided = asking.two_sided;
  events.out_of_time = options.search.out_of_time;
  settle_by_events(occluders, polygons, usual_event_edges, events, found);
  decide_the_rest(occluders, polygons, options, usual_event_edges, events, found);
  return found;
}

/// A superset of them.
Weakly_visible seen_by_boxes(const Occluders& occluders, const std::vector<Weak_source>& polygons,
                             const Asking& asking) {
  Conservative_options options;
  options.two_sided = asking.two_sided;
  options.threads = asking.threads;
  options.progress = progress_within_budget(asking);
  return possibly_visible(occluders, polygons, options);
}

/// What solids, which are given besides polygons, see outwards by `search`, and from within.
Weak_visibility seen_from_solids(const Model& model, const std::vector<Polygon_soup>& solids,
                                 std::vector<std::vector<Exact_point>> sources, const Asking& asking,
                                 Weakly_visible (*search)(const Occluders&, const std::vector<Weak_source>&,
                                                          const Asking&)) {
  const std::function<bool()> out_of_time = end_of_budget(asking);
  const Occluders& occluders = model.inside()->occluders(asking.progress);
  std::list<Weak_volume> volumes;
  const auto dividing = [&](std::size_t, std::size_t) {
    if (asking.progress) asking.progress(0, 1);  // which may end the question
  };
  for (const Polygon_soup& solid : solids) {
    const std::vector<std::vector<Exact_point>>& surface = volumes.emplace_back(solid, dividing).surface();
    sources.insert(sources.end(), surface.begin(), surface.end());
  }
  std::atomic<std::size_t> all = 1;
  Asking told = asking;
  told.progress = [&](std::size_t done, std::size_t of) {
    all = of;
    if (asking.progress) asking.progress(done, of);
  };
  const auto found = std::make_shared<Weakly_visible>(search(occluders, weak_sources(occluders, sources), told));
  for (const Weak_volume& volume : volumes)
    add_seen_from_within(occluders.scene(), volume, asking.two_sided, *found, [&] {
      told.progress(all, all);  // which may end the question
      return has_run_out(out_of_time);
    });
  return weak_answer(model, sources, asking, found);
}

}  // namespace

Weak_visibility weakly_visible(const Model& model, const std::vector<std::vector<Exact_point>>& sources,
                               const Asking& asking) {
  return seen_from_solids(model, {}, sources, asking, &seen_by_lines);
}

Weak_visibility weakly_visible(const Model& model, Face_id source, const Asking& asking) {
  return weakly_visible(model, sources_of(model, source), asking);
}

Weak_visibility possibly_visible(const Model& model, const std::vector<std::vector<Exact_point>>& sources,
                                 const Asking& asking) {
  return seen_from_solids(model, {}, sources, asking, &seen_by_boxes);
}

Weak_visibility weakly_visible_from_solids(const Model& model, const std::vector<Polygon_soup>& solids,
                                           const std::vector<std::vector<Exact_point>>& sources, const Asking& asking) {
  return seen_from_solids(model, solids, sources, asking, &seen_by_lines);
}

Weak_visibility possibly_visible_from_solids(const Model& model, const std::vector<Polygon_soup>& solids,
                                             const std::vector<std::vector<Exact_point>>& sources,
                                             const Asking& asking) {
  return seen_from_solids(model, solids, sources, asking, &seen_by_boxes);
}

std::vector<std::vector<Exact_point>> sources_of(const Model& model, Face_id face) {
  std::vector<std::vector<Exact_point>> sources;
  for (const Piece& piece : model.scene().pieces())
    if (piece.face == face) sources.push_back(model.inside()->part(piece).corners);
  if (sources.empty())
    throw std::out_of_range("face " + std::to_string(face) + " is not there, or was left out: see left_out()");
  return sources;
}

// ---- Along a path

Seen_along see_along(const Model& model, const Exact_point& from, const Exact_point& to, const Asking& asking) {
  const std::shared_ptr<const Model::Inside> inside = model.inside();
  Along_options options;
  options.two_sided = asking.two_sided;
  options.threads = asking.threads;
  options.progress = progress_within_budget(asking);
  Visible_along found = visible_along(inside->occluders(options.progress), from, to, options);
  std::vector<Seen_along::Event> events;
  for (Along_event& event : found.events) {
    Seen_along::Event& told = events.emplace_back(Seen_along::Event{std::move(event.t), {}});
    for (Along_event::Change& change : event.changes)
      told.changes.push_back(
          {change.face, change.before, change.at, change.after, name(change.kind), std::move(change.edges)});
  }
  options.progress = {};
  options.with_proofs = true;
  auto certify = [inside, from, to, options](const Asking::Progress& progress) {
    return told_text(progress, [&](std::ostream& out, const Asking::Progress& steps) {
      Along_options told = options;
      told.progress = steps;
      const Visible_along proved = visible_along(inside->occluders(), from, to, told);
      write_certificate(out, along_certificate(inside->scene(), proved, from, to, told.two_sided));
    });
  };
  return {Answer(std::move(certify)), std::move(events), std::move(found.at_start), std::move(found.at_end),
          std::move(found.visible)};
}

}  // namespace sightline
