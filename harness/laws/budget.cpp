#include <sightline/harness/laws/budget.h>

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/laws/crowd.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/harness/laws/see_lines.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <vector>

namespace sightline::harness {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr double slack = 0.5;
#else
constexpr double slack = 0.05;
#endif

// ---- From a point

struct Ran_out {};

/// What an eye sees, or nothing where the budget ran out.
std::optional<Answer> seen(const Polygon_soup& soup, const Exact_point& eye, Budget* budget) {
  const Scene scene(soup);
  const Piece_boxes boxes(scene);
  if (budget != nullptr) budget->begin();
  const Exact_view view(scene, eye);
  Visible_options options;
  options.threads = 1;
  if (budget != nullptr)
    options.progress = [budget](std::size_t, std::size_t) {
      if (budget->over()) throw Ran_out();
    };
  try {
    Answer answer;
    answer.labels.assign(soup.face_count(), Answer::none);
    for (const Piece& piece : scene.pieces()) answer.labels[piece.face] = 0;
    label_seen(visible_surface(view, boxes, options), answer);
    return answer;
  } catch (const Ran_out&) {
    return std::nullopt;
  }
}

Outcome see_within(const Posed_scene& posed, const Answer& answer, Random& random) {
  constexpr std::size_t many = 3000;
  const bool crowded = random.chance(1, 16);
  const Polygon_soup soup = crowded ? crowd(posed.soup, many, 1) : posed.soup;
  Budget budget(random);
  const std::optional<Answer> found = seen(soup, posed.eye, &budget);
  if (const std::string late = budget.overdrawn(); !late.empty()) return Outcome::failed(late);
  if (!found) return {};
  if (budget.was_over()) return Outcome::failed("there is an answer although the budget ran out on the way");
  return compared(crowded ? *seen(soup, posed.eye, nullptr) : without_lines(answer), *found, "without a budget",
                  "with one");
}

// ---- From a polygon

/// What is left after a search, events where it left something, and more of both; whatever is decided is proved.
Outcome by_lines_within(const Polygon_soup& soup, const Posed_scene& posed, Budget& budget, Weak_faces& faces) {
  const Scene scene(soup);
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, posed.source)};
  Weak_options options;
  options.threads = 1;
  options.search.out_of_time = [&budget] { return budget.over(); };
  Events_options events;
  events.threads = 1;
  events.out_of_time = options.search.out_of_time;
  budget.begin();
  Weakly_visible found = weakly_visible(occluders, sources, options);
  search_thoroughly(occluders, sources, options, found);
  settle_by_events(occluders, sources, usual_event_edges, events, found);
  decide_the_rest(occluders, sources, options, usual_event_edges, events, found);
  if (const std::string late = budget.overdrawn(); !late.empty()) return Outcome::failed(late);
  const Verdict verdict = verify_weak(soup, weak_certificate(scene, {posed.source}, false, found));
  if (!verdict.accepted) return Outcome::failed("the certificate of what is decided is rejected: " + verdict.why);
  faces = std::move(found);
  return {};
}

Outcome by_events_within(const Polygon_soup& soup, const Posed_scene& posed, Budget& budget, Weak_faces& faces) {
  const Scene scene(soup);
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, posed.source)};
  Events_options options;
  options.threads = 1;
  options.rays = 0;  // else lines at random decide most of what is visible
  options.out_of_time = [&budget] { return budget.over(); };
  budget.begin();
  faces = weakly_visible_by_events(occluders, sources, options);
  const std::string late = budget.overdrawn();
  return late.empty() ? Outcome{} : Outcome::failed(late);
}

Outcome weak_within(const Posed_scene& posed, const Answer& answer, Random& random) {
  const bool by_events = random.chance(1, 2), crowded = random.chance(1, 3);
  const std::size_t many = by_events ? 60 : 200;
  const Polygon_soup soup = crowded ? crowd(posed.soup, many, Rational(1, 8)) : posed.soup;
  Budget budget(random);
  Weak_faces found;
  const Outcome kept = (by_events ? by_events_within : by_lines_within)(soup, posed, budget, found);
  if (kept.state == Outcome::State::failed) return kept;
  if (!by_events && !found.undecided.empty() && !budget.was_over())
    return Outcome::failed(face_name(found.undecided[0]) + " is undecided although there is time left");
  if (crowded) return {};
  Answer within;
  within.labels.assign(soup.face_count(), Answer::none);
  label_weakly_seen(found, within);
  const Outcome outcome = compared(answer, within, "without a budget", "with one");
  return outcome.state == Outcome::State::failed ? outcome : Outcome{};
}

}  // namespace

Budget::Budget(Random& random) : seconds_(0.001 * static_cast<double>(random.between(1, 20))) {
  // Half of them are over by the clock alone.
  asks_left_ = random.chance(1, 2) ? ~std::uint64_t{0} : random.below(std::uint64_t{1} << random.between(0, 12));
}

void Budget::begin() { begin_ = processor_seconds(); }

bool Budget::over() {
  if (over_) return true;
  const double spent = processor_seconds() - begin_;
  over_ = spent > seconds_ || asks_left_ == 0;
  if (over_) seconds_ = std::min(seconds_, spent);
  --asks_left_;
  return over_;
}

std::string Budget::overdrawn() const {
  const double spent = processor_seconds() - begin_, most = 1.1 * seconds_ + slack;
  if (spent <= most) return {};
  char text[100];
  std::snprintf(text, sizeof text, "it took %.0f ms of processor time with a budget of %.0f ms", 1000 * spent,
                1000 * seconds_);
  return text;
}

Check see_budget_check() {
  return {"budget", "the same within a budget, or no answer: in its processor time, a tenth more and 50 ms", see_within,
          8};
}

Check weak_budget_check() {
  return {"budget", "the same within a budget, or undecided: in its processor time, a tenth more and 50 ms",
          weak_within, 16};
}

}  // namespace sightline::harness
