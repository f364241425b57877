#include <sightline/harness/laws/order.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/kernels.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/algorithms/bsp/tree.h>
#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/rounded_plane.h>
#include <sightline/algorithms/priority/scope.h>
#include <sightline/algorithms/priority/tree.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/empty_scenes.h>
#include <sightline/harness/laws/front_door.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/harness/laws/manners.h>
#include <sightline/harness/laws/questions.h>
#include <sightline/harness/laws/solid_laws.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/partition_traits.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Cartesian.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace sightline::harness {

namespace order_subject {

using Tree = Bsp_tree<Exact_traits>;

inline Bsp_options serial() {
  Bsp_options options;
  options.threads = 1;
  return options;
}

/// Polygons farthest first, as a certificate.
class Order {
 public:
  explicit Order(const Scene& scene, const Exact_point& eye) : scene_(scene) {
    certificate_.eye = eye;
    add_pieces(certificate_, scene);
  }
  template <class Traits>
  void draw(const Traits& traits, const Convex_polygon<Traits>& polygon) {
    const Piece& piece = scene_.pieces()[polygon.piece];
    Order_fragment& fragment = certificate_.fragments.emplace_back();
    fragment.face = piece.face;
    fragment.piece = piece.number;
    for (const Corner<Traits>& corner : polygon) fragment.vertices.push_back(traits.position(*corner.vertex));
  }
  /// What the checker finds wrong, or nothing.
  std::string flaw(const Polygon_soup& soup, bool on_view = false);

 private:
  const Scene& scene_;
  Order_certificate certificate_;
};

/// By a BSP tree. Labels: 1 where the eye is in front of the face, 2 behind, 4 in its plane.
template <class Traits>
Answer by_tree(const Posed_scene& posed, const Scene& scene, const Traits& traits, bool verify,
               Bsp_counters* counters = nullptr, const Bsp_options& options = serial()) {
  const Bsp_tree<Traits> tree = build_bsp(traits, options);
  if (counters != nullptr) *counters = tree.counters;
  Answer answer;
  answer.labels.assign(posed.soup.face_count(), Answer::none);
  answer.planar = scene.counters().non_planar + scene.counters().no_simple_projection == 0;
  Order order(scene, posed.eye);
  traverse(
      traits, tree, traits.eye(posed.eye), Direction::back_to_front,
      [&](const Fragment<Traits>& fragment, Sign node_side) {
        const Sign side = fragment.same_sense ? node_side : -node_side;
        std::uint32_t& label = answer.labels[scene.pieces()[fragment.polygon.piece].face];
        label = (label == Answer::none ? 0u : label) | (side == CGAL::POSITIVE ? 1u : side == CGAL::NEGATIVE ? 2u : 4u);
        if (verify) order.draw(traits, fragment.polygon);
      });
  if (verify) answer.flaw = order.flaw(posed.soup);
  return answer;
}

/// That another kernel, which is exact too, builds the same tree and sees the same sides.
template <class Kernel>
Outcome by_kernel(const Posed_scene& posed, const Answer& answer, const std::string& name) {
  const Scene scene(posed.soup);
  Bsp_counters here, there;
  by_tree(posed, scene, Exact_traits(scene), false, &here);
  const Answer other = by_tree(posed, scene, Point_traits<Kernel>(scene), false, &there);
  const auto differ = [&](const char* what, std::uint64_t a, std::uint64_t b) {
    return Outcome::failed(std::string(what) + ": exact " + std::to_string(a) + ", " + name + ' ' + std::to_string(b));
  };
  if (here.nodes != there.nodes) return differ("nodes", here.nodes, there.nodes);
  if (here.splits != there.splits) return differ("splits", here.splits, there.splits);
  if (here.fragments != there.fragments) return differ("fragments", here.fragments, there.fragments);
  return compared(answer, other, "exact", name);
}

/// In numbers that round, whose answers are wrong where scenes are degenerate: the tree has all fragments but those
/// that rounding left without an inside, each drawn once; and where halves are so small that no sign is rounded,
/// and nothing is cut, sides are as they are.
template <class Kernel>
Outcome by_rounding_kernel(const Posed_scene& posed, const Answer& answer, const std::string& name) {
  constexpr int most_bits = 6;  // signs take four times as many, floats have 24
  const Scene scene(posed.soup);
  Bsp_counters counters;
  std::size_t drawn = 0;
  Answer other;
  try {
    const Point_traits<Kernel> traits(scene);
    other = by_tree(posed, scene, traits, false, &counters);
    traverse(traits, build_bsp(traits, serial()), traits.eye(posed.eye), Direction::front_to_back,
             [&](const auto&, Sign) { ++drawn; });
  } catch (const std::domain_error&) {  // beyond the range of the numbers
    return Outcome::not_applicable();
  }
  if (counters.fragments + counters.degenerate != counters.pieces + counters.splits)
    return Outcome::failed("fragments in " + name + " are not pieces and splits, without those that are dropped");
  if (drawn != counters.fragments) return Outcome::failed("fragments in " + name + " are not drawn once each");
  const bool is_small = scene.bits() <= most_bits &&
                        std::all_of(posed.eye.begin(), posed.eye.end(),
                                    [](const Rational& x) { return x.get_den() == 1 && abs(x) < (1 << most_bits); });
  bool has_halves = true;  // at most: thirds are rounded
  for (Point_id p = 0; p < posed.soup.point_count(); ++p)
    for (const Rational& x : posed.soup.point(p)) has_halves &= x.get_den() <= 2;
  return is_small && has_halves && counters.splits == 0 ? compared(answer, other, "exact", name) : Outcome{};
}
Outcome in_rounding_kernels(const Posed_scene& posed, const Answer& answer, Random& random) {
  switch (random.below(3)) {
    case 0: return by_rounding_kernel<CGAL::Simple_cartesian<float>>(posed, answer, "floats");
    case 1: return by_rounding_kernel<CGAL::Simple_cartesian<double>>(posed, answer, "doubles");
    default: return by_rounding_kernel<CGAL::Epick>(posed, answer, "Epick");
  }
}

/// By another tree of the same faces, its planes chosen otherwise; progress is told of each fragment once.
Outcome by_another_tree(const Posed_scene& posed, const Answer& answer, Random& random) {
  Bsp_options options;
  options.candidates = static_cast<unsigned>(1 + random.below(8));
  options.sample = static_cast<unsigned>(1 + random.below(4));
  options.split_weight = static_cast<unsigned>(random.below(6));
  options.seed = random.below(1000);
  options.threads = 1;
  std::size_t told = 0;
  bool goes_on = true;
  options.progress = [&](std::size_t done, std::size_t) {
    goes_on &= done > told;
    told = done;
  };
  const Scene scene(posed.soup);
  Bsp_counters counters;
  const Answer other = by_tree(posed, scene, Exact_traits(scene), true, &counters, options);
  if (!other.flaw.empty()) return Outcome::failed("of another tree " + other.flaw);
  if (!goes_on || told != counters.fragments) return Outcome::failed("progress is not told of each fragment once");
  if (counters.fragments != counters.pieces + counters.splits)
    return Outcome::failed("fragments are not pieces and splits");
  return compared(answer, other, "the tree", "another tree");
}

std::string Order::flaw(const Polygon_soup& soup, bool on_view) {
  certificate_.on_view = on_view;
  const Verdict verdict = verify_order(soup, certificate_);
  return verdict.accepted ? std::string() : "the certificate is rejected: " + verdict.why;
}

/// The order by the priority graph: of what is on-view, or of both sides of everything.
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

/// Labels from corners alone: the eye against the plane of each face's pieces, by Newell's normal in rationals.
Outcome by_definition(const Posed_scene& posed, const Answer& answer) {
  using namespace generate;
  const Scene scene(posed.soup);
  Answer truth;
  truth.labels.assign(posed.soup.face_count(), Answer::none);
  for (const Piece& piece : scene.pieces()) {
    const Points corners = scene.corner_points(piece);
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
      {"gmpq", "the same tree by Cartesian<Gmpq>",
       [](const Posed_scene& posed, const Answer& answer, Random&) {
         return by_kernel<CGAL::Cartesian<CGAL::Gmpq>>(posed, answer, "gmpq");
       }},
      front_door_check(ordered_by_front_door)};
  add_laws(subject, {"begin", "permute", "translate", "scale", "rotate", "stretch", "project", "mirror", "turn", "cut",
                     "bystander"});
  // Last: others keep their random choices.
  for (const Check& check : {points_check(), first_hit_check(), parts_check(), face_graph_check()})
    subject.checks.push_back(check);
  subject.checks.push_back({"another_tree", "an order by a tree of planes chosen otherwise", by_another_tree});
  subject.checks.push_back(
      {"rounding", "trees in floats and doubles have all fragments, each once", in_rounding_kernels});
  subject.checks.push_back(manners_check(questions_of_order()));
  subject.checks.push_back(empty_scenes_check(subject.verified));
  return subject;
}

}  // namespace sightline::harness
