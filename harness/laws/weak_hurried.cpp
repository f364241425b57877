#include <sightline/harness/laws/weak_hurried.h>

#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/kernel/scene/scene.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sightline::harness {

namespace hurried_weak {

/// Lines, then by dearer means, then events for what is left, then more of both.
Weak_faces by_lines(const Occluders& occluders, const std::vector<Weak_source>& sources, Random& random,
                    const std::function<bool()>& is_over) {
  Weak_options options;
  options.threads = 1;
  options.search.cells = 1 + random.below(2000);
  options.search.rays = random.chance(1, 2) ? 0 : 24;
  options.search.thorough = random.chance(1, 4);
  options.search.out_of_time = is_over;
  Events_options events;
  events.threads = 1;
  events.rays = random.chance(1, 2) ? 0 : 4;
  events.out_of_time = is_over;
  Weakly_visible found = weakly_visible(occluders, sources, options);
  if (random.chance(1, 2)) search_thoroughly(occluders, sources, options, found);
  if (random.chance(1, 2)) settle_by_events(occluders, sources, random.below(100), events, found);
  if (random.chance(1, 2)) decide_the_rest(occluders, sources, options, random.below(100), events, found);
  return found;
}

Weak_faces by_events(const Occluders& occluders, const std::vector<Weak_source>& sources, Random& random,
                     const std::function<bool()>& is_over) {
  Events_options options;
  options.threads = 1;
  options.rays = 0;
  options.undivided = random.chance(1, 2) ? 0 : random.below(200);
  options.surfaces = random.chance(1, 2);
  if (random.chance(1, 3)) options.events = random.below(2000);
  options.out_of_time = is_over;
  return weakly_visible_by_events(occluders, sources, options);
}

Outcome run(const Posed_scene& posed, const Answer& answer, Random& random) {
  constexpr std::size_t most_pieces = 16;
  if (!random.chance(1, 4)) return Outcome::not_applicable();
  const Scene scene(posed.soup);
  if (scene.pieces().size() > most_pieces) return Outcome::not_applicable();
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, posed.source)};
  std::uint64_t left = random.below(std::uint64_t{1} << random.between(0, 13));
  const auto is_over = [&left] { return left == 0 || --left == 0; };
  const bool is_by_events = random.chance(1, 2);
  const Weak_faces found = (is_by_events ? by_events : by_lines)(occluders, sources, random, is_over);
  Answer until;
  until.labels.assign(posed.soup.face_count(), Answer::none);
  label_weakly_seen(found, until);
  const Outcome outcome =
      compared(answer, until, "the search", is_by_events ? "events until some moment" : "lines until some moment");
  return outcome.state == Outcome::State::failed ? outcome : Outcome{};
}

}  // namespace hurried_weak

Check hurried_check() {
  return {"hurried", "whatever time runs out at, what is decided until then is right", hurried_weak::run};
}

}  // namespace sightline::harness
