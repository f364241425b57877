#include <sightline/harness/laws/see.h>

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/view_drafts.h>
#include <sightline/harness/generate/weak_neighbours.h>
#include <sightline/harness/laws/along.h>
#include <sightline/harness/laws/budget.h>
#include <sightline/harness/laws/empty_scenes.h>
#include <sightline/harness/laws/front_door.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/harness/laws/manners.h>
#include <sightline/harness/laws/questions.h>
#include <sightline/harness/laws/round_faces.h>
#include <sightline/harness/laws/see_lines.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <CGAL/Gmpq.h>

#include <string>
#include <utility>

namespace sightline::harness {

namespace see_subject {

inline Visible_options serial() {
  Visible_options options;
  options.threads = 1;
  return options;
}

template <class Surface>
Answer labels_of(const Posed_scene& posed, const Scene& scene, const Surface& surface) {
  Answer answer;
  answer.labels.assign(posed.soup.face_count(), Answer::none);
  answer.planar = scene.counters().non_planar + scene.counters().no_simple_projection == 0;
  for (const Piece& piece : scene.pieces()) answer.labels[piece.face] = 0;
  label_seen(surface, answer);
  return answer;
}

/// The same by another number type, which is exact too.
template <class FT>
Outcome by_numbers(const Posed_scene& posed, const Answer& answer, const std::string& name) {
  const Scene scene(posed.soup);
  const Piece_boxes boxes(scene);
  const Number_view<FT> view(scene, posed.eye);
  return compared(without_lines(answer), labels_of(posed, scene, visible_surface(view, boxes, serial())), "exact",
                  name);
}

Answer exactly(const Posed_scene& posed, bool verify) {
  const Scene scene(posed.soup);
  const Piece_boxes boxes(scene);
  const Exact_view view(scene, posed.eye);
  const auto surface = visible_surface(view, boxes, serial());
  Answer answer = labels_of(posed, scene, surface);
  label_crossings(posed, answer);
  if (!verify) return answer;
  const Verdict verdict = verify_visible(posed.soup, visible_certificate(view, surface, posed.eye));
  if (!verdict.accepted) answer.flaw = "the certificate is rejected: " + verdict.why;
  return answer;
}

/// What the front door says, which has no lines.
Check front_door() {
  Check check = front_door_check(seen_by_front_door);
  check.run = [run = check.run](const Posed_scene& posed, const Answer& answer, Random& random) {
    return run(posed, without_lines(answer), random);
  };
  return check;
}

}  // namespace see_subject

Subject see() {
  using namespace see_subject;
  Subject subject;
  subject.name = "see";
  subject.what = "visible surfaces and lines from a point, by two exact kernels, verify and brute force";
  subject.answer = [](const Posed_scene& posed) { return exactly(posed, false); };
  subject.verified = [](const Posed_scene& posed) { return exactly(posed, true); };
  subject.checks = {{"gmpq", "the same faces by Gmpq",
                     [](const Posed_scene& posed, const Answer& answer, Random&) {
                       return by_numbers<CGAL::Gmpq>(posed, answer, "gmpq");
                     }},
                    front_door(),
                    lines_check(),
                    field_check()};
  add_laws(subject, {"begin", "permute", "translate", "scale", "rotate", "stretch", "project", "mirror", "turn", "cut",
                     "bystander"});
  for (Check check : {see_budget_check(), moving_eye_check(),
                      round_faces_check(subject.verified, 120, 24)})  // last: others keep their random choices
    subject.checks.push_back(std::move(check));
  subject.checks.push_back(manners_check(questions_of_see()));
  subject.checks.push_back(empty_scenes_check(subject.verified));
  return subject;
}

}  // namespace sightline::harness
