#include <sightline/harness/laws/order.h>

#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/rounded_plane.h>
#include <sightline/algorithms/priority/scope.h>
#include <sightline/algorithms/priority/tree.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/laws.h>

#include <cstddef>

namespace sightline {
namespace harness {
namespace order_subject {

std::string Order::flaw(const Polygon_soup& soup, bool on_view) {
  certificate_.on_view = on_view;
  const Verdict verdict = verify_order(soup, certificate_);
  return verdict.accepted ? std::string() : "the certificate is rejected: " + verdict.why;
}

Outcome by_graph(const Posed_scene& posed, bool two_sided) {
  const Scene scene(posed.soup);
  const Exact_traits traits(scene);
  const Priority_tree<Exact_traits> tree = build_priority_tree(traits, {two_sided, false, {}});
  const Eye_order<Exact_traits> found = back_to_front(traits, tree, posed.eye);
  Order order(scene, posed.eye);
  for (const Convex_polygon<Exact_traits>& polygon : found.polygons) order.draw(traits, polygon);
  const std::string flaw = order.flaw(posed.soup, !two_sided);
  return flaw.empty() ? Outcome{} : Outcome::failed(flaw);
}

Outcome by_definition(const Posed_scene& posed, const Answer& answer) {
  using namespace generate;
  const Scene scene(posed.soup);
  Answer truth;
  truth.labels.assign(posed.soup.face_count(), Answer::none);
  for (const Piece& piece : scene.pieces()) {
    Points corners;
    for (const Piece_corner& corner : scene.corners(piece)) corners.push_back(scene.position(corner.point));
    Exact_point normal{0, 0, 0};
    for (std::size_t k = 0; k < corners.size(); ++k)
      normal = along(normal, 1, cross(corners[k], corners[(k + 1) % corners.size()]));
    const Exact_point d = minus(posed.eye, corners[0]);
    const int side = sgn(Rational(normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]));
    std::uint32_t& label = truth.labels[piece.face];
    label = (label == Answer::none ? 0u : label) | (side > 0 ? 1u : side < 0 ? 2u : 4u);
  }
  return compared(truth, answer, "the definition", "the tree");
}

}  // namespace order_subject
}  // namespace harness
}  // namespace sightline
namespace sightline {
namespace harness {

Subject order() {
  using namespace order_subject;
  Subject subject;
  subject.name = "order";
  subject.what = "back-to-front orders: BSP trees by two exact kernels, priority trees, orders checked by verify";
  const auto exactly = [](const Posed_scene& posed, bool verify) {
    const Scene scene(posed.soup);
    return by_tree(posed, scene, Exact_traits(scene), verify);
  };
  subject.answer = [exactly](const Posed_scene& posed) { return exactly(posed, false); };
  subject.verified = [exactly](const Posed_scene& posed) { return exactly(posed, true); };
  subject.checks = {
      {"definition", "the sides of faces, from their corners",
       [](const Posed_scene& posed, const Answer& answer, Random&) { return by_definition(posed, answer); }},
      {"graph", "an order by the priority graph is accepted",
       [](const Posed_scene& posed, const Answer&, Random&) { return by_graph(posed, false); }},
      {"graph two-sided", "an order of both sides by the priority graph is accepted",
       [](const Posed_scene& posed, const Answer&, Random&) { return by_graph(posed, true); }},
      {"gmpq", "the same tree by Cartesian<Gmpq>", [](const Posed_scene& posed, const Answer& answer, Random&) {
         return by_kernel<CGAL::Cartesian<CGAL::Gmpq>>(posed, answer, "gmpq");
       }}};
  add_laws(subject, {"permute", "translate", "scale", "rotate", "mirror", "turn", "cut", "bystander"});
  return subject;
}

}  // namespace harness
}  // namespace sightline
