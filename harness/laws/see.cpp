#include <sightline/harness/laws/see.h>

#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/laws.h>

#include <CGAL/Gmpq.h>

namespace sightline {
namespace harness {
namespace see_subject {

Answer exactly(const Posed_scene& posed, bool verify) {
  const Scene scene(posed.soup);
  const Piece_boxes boxes(scene);
  const Exact_view view(scene, posed.eye);
  const auto surface = visible_surface(view, boxes, serial());
  Answer answer = labels_of(posed, scene, surface);
  if (!verify) return answer;
  const Verdict verdict = verify_visible(posed.soup, visible_certificate(view, surface, posed.eye));
  if (!verdict.accepted) answer.flaw = "the certificate is rejected: " + verdict.why;
  return answer;
}

}  // namespace see_subject
}  // namespace harness
}  // namespace sightline
namespace sightline {
namespace harness {

Subject see() {
  using namespace see_subject;
  Subject subject;
  subject.name = "see";
  subject.what = "visible surfaces from a point by two exact kernels, answers checked by verify";
  subject.answer = [](const Posed_scene& posed) { return exactly(posed, false); };
  subject.verified = [](const Posed_scene& posed) { return exactly(posed, true); };
  subject.checks = {{"gmpq", "the same faces by Gmpq", [](const Posed_scene& posed, const Answer& answer, Random&) {
                       return by_numbers<CGAL::Gmpq>(posed, answer, "gmpq");
                     }}};
  add_laws(subject, {"permute", "translate", "scale", "rotate", "mirror", "turn", "cut", "bystander"});
  return subject;
}

}  // namespace harness
}  // namespace sightline
