#include <sightline/harness/laws/weak.h>

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/events/event_search.h>
#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/budget.h>
#include <sightline/harness/laws/empty_scenes.h>
#include <sightline/harness/laws/front_door.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/harness/laws/manners.h>
#include <sightline/harness/laws/naive_weak.h>
#include <sightline/harness/laws/questions.h>
#include <sightline/harness/laws/round_faces.h>
#include <sightline/harness/laws/weak_answers.h>
#include <sightline/harness/laws/weak_crowd.h>
#include <sightline/harness/laws/weak_hurried.h>
#include <sightline/harness/laws/weak_open.h>
#include <sightline/harness/laws/weak_options.h>
#include <sightline/harness/laws/weak_partition.h>
#include <sightline/harness/laws/weak_shares.h>
#include <sightline/harness/laws/weak_surfaces.h>
#include <sightline/harness/laws/weak_together.h>
#include <sightline/harness/laws/weak_volume.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace weak_subject {

/// Searches end here: rarely, a tangled degenerate scene would take minutes.
inline constexpr std::size_t most_cells = 3000, most_thorough_cells = 200, most_events = 100000;
inline constexpr std::size_t whole = 1000000;  // edges: no shaft is divided

template <class Found>
Answer labels_of(const Polygon_soup& soup, const Scene& scene, const Found& found) {
  Answer answer;
  answer.labels.assign(soup.face_count(), Answer::none);
  answer.planar = scene.counters().non_planar + scene.counters().no_simple_projection == 0;
  label_weakly_seen(found, answer);
  return answer;
}

Answer by_lines(const Posed_scene& posed, bool verify) {
  const Scene scene(posed.soup);
  const Occluders occluders(scene);
  Weak_options options;
  options.threads = 1;
  options.search.cells = most_cells;
  const std::vector<Weak_source> sources{weak_source(occluders, posed.source)};
  Weakly_visible found = weakly_visible(occluders, sources, options);
  options.search.cells = most_thorough_cells;
  search_thoroughly(occluders, sources, options, found);
  Answer answer = labels_of(posed.soup, scene, found);
  if (!verify) return answer;
  const Verdict verdict = verify_weak(posed.soup, weak_certificate(scene, {posed.source}, false, found));
  if (!verdict.accepted) answer.flaw = "the certificate is rejected: " + verdict.why;
  return answer;
}

/// `undivided`: edges up to which a shaft is not divided.
Outcome by_events(const Posed_scene& posed, const Answer& answer, std::size_t undivided) {
  constexpr std::size_t most_pieces = 12;  // events are the third power of edges and more
  const Scene scene(posed.soup);
  if (scene.pieces().size() > most_pieces) return Outcome::not_applicable();
  const Occluders occluders(scene);
  Events_options options;
  options.threads = 1;
  options.events = most_events;
  options.rays = 0;  // else lines at random decide most of what is visible
  options.undivided = undivided;
  return compared(answer,
                  labels_of(posed.soup, scene,
                            weakly_visible_by_events(occluders, {weak_source(occluders, posed.source)}, options)),
                  "lines", "events");
}

Outcome as_constructed(const Posed_scene& posed, const Answer& answer) {
  if (posed.visible.empty() && posed.hidden.empty()) return Outcome::not_applicable();
  Answer truth = answer;
  for (const Face_id face : posed.visible)
    if (truth.labels[face] != Answer::none) truth.labels[face] = 1;
  for (const Face_id face : posed.hidden)
    if (truth.labels[face] != Answer::none) truth.labels[face] = 0;
  return compared(truth, answer, "the construction", "lines");
}

/// The source about its centroid, three halves as large: visible faces only grow.
Outcome grown(const Posed_scene& posed, const Answer& answer) {
  using namespace generate;
  Posed_scene larger = posed;
  const Exact_point middle = centroid(posed.source);
  for (Exact_point& p : larger.source) p = along(p, ratio(1, 2), minus(p, middle));
  const Answer more = by_lines(larger, true);
  if (!more.flaw.empty()) return Outcome::failed("from a larger source: " + more.flaw);
  for (std::size_t f = 0; f < answer.labels.size(); ++f)
    if (answer.labels[f] == 1 && more.labels[f] == 0)
      return Outcome::failed(face_name(f) + " is visible from the source, but not from one that holds it");
  return answer.undecided + more.undecided > 0 ? Outcome::undecided() : Outcome{};
}

/// A face sees the source, put in as a face, if the source sees it.
Outcome reversed(const Posed_scene& posed, const Answer& answer, Random& random) {
  std::vector<Face_id> convex;
  for (Face_id f = 0; f < posed.soup.face_count(); ++f)
    if (answer.labels[f] != Answer::none && !convex_corners(posed.soup, f).empty()) convex.push_back(f);
  if (convex.empty()) return Outcome::not_applicable();
  const Face_id chosen = convex[random.below(convex.size())];
  Posed_scene back = posed;
  back.source = convex_corners(posed.soup, chosen);
  std::vector<Point_id> ids;
  for (const Exact_point& p : posed.source) ids.push_back(back.soup.add_point(p[0], p[1], p[2]));
  const Face_id source = back.soup.add_face(ids);
  const Answer other = by_lines(back, true);
  if (!other.flaw.empty()) return Outcome::failed("with source and target in each other's place: " + other.flaw);
  if (other.labels[source] == Answer::none)
    return other.undecided > 0 ? Outcome::undecided() : Outcome::not_applicable();  // or it is a duplicate
  if (other.labels[source] != answer.labels[chosen])
    return Outcome::failed("the source " + std::string(answer.labels[chosen] ? "sees " : "does not see ") +
                           face_name(chosen) + ", which " + (other.labels[source] ? "sees" : "does not see") +
                           " the source");
  return {};
}

}  // namespace weak_subject

Subject weak() {
  using namespace weak_subject;
  Subject subject;
  subject.name = "weak";
  subject.what = "weak visibility from a polygon by lines and by events, answers by lines checked by verify";
  subject.wants_source = true;
  subject.answer = [](const Posed_scene& posed) { return by_lines(posed, false); };
  subject.verified = [](const Posed_scene& posed) { return by_lines(posed, true); };
  subject.checks = {
      {"construction", "what the family knows",
       [](const Posed_scene& posed, const Answer& answer, Random&) { return as_constructed(posed, answer); }},
      {"events", "the same faces by events",
       [](const Posed_scene& posed, const Answer& answer, Random&) { return by_events(posed, answer, whole); }},
      {"grow", "a larger source sees no less",
       [](const Posed_scene& posed, const Answer& answer, Random&) { return grown(posed, answer); }},
      {"reverse", "source and target in each other's place", weak_subject::reversed},
      front_door_check(weakly_seen_by_front_door)};
  add_laws(subject,
           {"begin", "permute", "translate", "scale", "rotate", "stretch", "project", "mirror", "cut", "bystander"});
  subject.checks.push_back(
      {"shafts", "the same faces by events in parts of shafts",
       [](const Posed_scene& posed, const Answer& answer, Random&) { return by_events(posed, answer, 0); }});
  subject.checks.push_back(weak_budget_check());  // behind the others, which keep their random choices; so are these
  for (Check check : {conservative_check(), settle_check(), along_check(), volume_check(), partition_check(),
                      outline_check(), naive_weak_check(), two_sided_check(), rest_check(), open_check(),
                      hurried_check(), crowd_check(), round_faces_check(subject.verified, 44, 40)})
    subject.checks.push_back(std::move(check));
  subject.checks.push_back(manners_check(questions_of_weak()));
  subject.checks.push_back(empty_scenes_check(subject.verified));
  subject.checks.push_back(surfaces_check());
  subject.checks.push_back(shares_check());
  subject.checks.push_back(together_check());
  return subject;
}

}  // namespace sightline::harness
