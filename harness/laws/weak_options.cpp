#include <sightline/harness/laws/weak_options.h>

#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/kernel/scene/scene.h>

#include <atomic>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace {

Answer labelled(const Polygon_soup& soup, const Weak_faces& found) {
  Answer answer;
  answer.labels.assign(soup.face_count(), Answer::none);
  label_weakly_seen(found, answer);
  return answer;
}

/// What is told of progress: once for each of all, and never more.
class Told {
 public:
  auto teller() {
    return [this](std::size_t done, std::size_t all) {
      ++times_;
      all_ = all;
      if (done == 0 || done > all) wrong_ = true;
    };
  }
  bool is_whole() const { return !wrong_ && times_ == all_; }

 private:
  std::atomic<std::size_t> times_{0}, all_{0};
  std::atomic<bool> wrong_{false};
};

Outcome from_both_sides(const Posed_scene& posed, const Answer& answer, Random& random) {
  constexpr std::size_t most_pieces = 8, most_cells = 3000, most_events = 20000;
  if (!random.chance(1, 4)) return Outcome::not_applicable();
  const Scene scene(posed.soup);
  if (scene.pieces().size() > most_pieces) return Outcome::not_applicable();
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, posed.source)};

  // 1. Lines, with proofs.
  Weak_options options;
  options.search.two_sided = true;
  options.search.cells = most_cells;
  options.threads = static_cast<int>(1 + random.below(3));
  Told told;
  options.progress = told.teller();
  const Weakly_visible found = weakly_visible(occluders, sources, options);
  if (!told.is_whole()) return Outcome::failed("lines do not tell of each face once");
  const Verdict verdict = verify_weak(posed.soup, weak_certificate(scene, {posed.source}, true, found));
  if (!verdict.accepted) return Outcome::failed("the two-sided certificate is rejected: " + verdict.why);
  const Answer lines = labelled(posed.soup, found);
  for (std::size_t f = 0; f < answer.labels.size(); ++f)
    if (answer.labels[f] == 1 && lines.labels[f] == 0)
      return Outcome::failed(face_name(f) + " is visible, but from neither side");

  // 2. Events, with surfaces at times.
  Events_options events;
  events.two_sided = true;
  events.surfaces = random.chance(1, 2);
  events.events = most_events;
  events.rays = random.chance(1, 2) ? 0 : 4;
  events.undivided = random.chance(1, 2) ? 0 : 1000;
  events.threads = options.threads;
  Told told_by_events;
  events.progress = told_by_events.teller();
  std::atomic<std::size_t> asks{0};
  events.out_of_time = [&] {
    ++asks;
    return false;
  };
  const Weakly_visible_by_events by_events = weakly_visible_by_events(occluders, sources, events);
  if (!told_by_events.is_whole()) return Outcome::failed("events do not tell of each face once");
  const Event_counters& counters = by_events.counters;
  for (const auto& surface : by_events.surfaces)
    if (surface.rulings.size() < 2) return Outcome::failed("a surface of events has no two rulings");
  if (asks < counters.horizon + counters.edge_vertex + counters.triple)
    return Outcome::failed("events do not ask before each of them whether there is time");
  return compared(lines, labelled(posed.soup, by_events), "lines from both sides", "events from both sides");
}

bool are_in_order(const std::vector<Weakly_visible::Pair>& pairs) {
  for (std::size_t k = 1; k < pairs.size(); ++k)
    if (std::pair(pairs[k - 1].piece, pairs[k - 1].source) >= std::pair(pairs[k].piece, pairs[k].source)) return false;
  return true;
}

Outcome of_the_rest(const Posed_scene& posed, const Answer& answer, Random& random) {
  constexpr std::size_t most_pieces = 6, most_steps = 20000;
  if (!random.chance(1, 4)) return Outcome::not_applicable();
  const Scene scene(posed.soup);
  if (scene.pieces().size() > most_pieces) return Outcome::not_applicable();
  const Occluders occluders(scene);
  // Two sources that are one see the same, and have their pairs one after the other.
  const std::vector<generate::Points> polygons(random.chance(1, 2) ? 1 : 2, posed.source);
  const std::vector<Weak_source> sources(polygons.size(), weak_source(occluders, posed.source));
  Weak_options options;
  options.threads = 1;
  options.search.rays = 0;
  options.search.cells = 1 + random.below(8);
  Weakly_visible found = weakly_visible(occluders, sources, options);
  if (found.open.empty()) return Outcome::not_applicable();
  std::size_t steps = 0;
  options.search.out_of_time = [&] { return ++steps > most_steps; };
  Events_options events;
  events.threads = 1;
  events.rays = 0;
  events.out_of_time = options.search.out_of_time;
  decide_the_rest(occluders, sources, options, random.below(24), events, found);
  if (!found.undecided.empty() && steps <= most_steps)
    return Outcome::failed(face_name(found.undecided[0]) + " is left undecided though there was time");
  for (const auto* pairs : {&found.pairs, &found.open})
    if (!are_in_order(*pairs)) return Outcome::failed("pairs do not come by pieces and sources");
  const Verdict verdict = verify_weak(posed.soup, weak_certificate(scene, polygons, false, found));
  if (!verdict.accepted) return Outcome::failed("the certificate is rejected: " + verdict.why);
  return compared(answer, labelled(posed.soup, found), "the search", "going on until all is decided");
}

}  // namespace

Check two_sided_check() {
  return {"two_sided", "lines and events agree from both sides, whatever is told, by any number of threads",
          from_both_sides};
}

Check rest_check() {
  return {"rest", "the same by going on from a search of hardly any cells until all is decided", of_the_rest};
}

}  // namespace sightline::harness
