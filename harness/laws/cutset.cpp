#include <sightline/harness/laws/cutset.h>

#include <sightline/algorithms/cutset/on_view.h>
#include <sightline/algorithms/cutset/tracker.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/front_door.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/point_traits.h>
#include <sightline/sightline.h>

#include <CGAL/Cartesian.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace sightline::harness {

namespace cutset_subject {

/// From a point of the scene to the eye, by way of corners and of places beyond them, and a direction now and then.
std::vector<Viewpoint> path_to_the_eye(const Posed_scene& posed, Random& random);

/// On-view by definition, in rationals and from corners only.
bool is_on_view(const generate::Points& corners, const Viewpoint& view);

/// Follows a path, and compares each frame with the definition. Returns what is wrong, or nothing.
template <class Traits>
std::string flaw_along(const Scene& scene, const Traits& traits, const std::vector<Viewpoint>& path) {
  const Face_graph graph(scene);
  Cut_set_tracker<Traits> tracker(traits, graph);
  std::vector<generate::Points> nodes(graph.size());
  for (std::uint32_t i = 0; i < graph.size(); ++i) nodes[i] = scene.corner_points(scene.pieces()[graph.piece(i)]);
  for (std::size_t frame = 0; frame < path.size(); ++frame) {
    tracker.move_to(path[frame]);
    std::vector<bool> on(graph.size()), in_cut(graph.edges().size());
    for (std::uint32_t i = 0; i < graph.size(); ++i) on[i] = is_on_view(nodes[i], path[frame]);
    for (const std::uint32_t e : tracker.cut_edges()) in_cut[e] = true;
    const std::string where = "frame " + std::to_string(frame) + ": ";
    for (std::uint32_t i = 0; i < graph.size(); ++i)
      if (tracker.on_view(i) != on[i])
        return where + "the tracker says that " + face_name(scene.pieces()[graph.piece(i)].face) + " is " +
               (on[i] ? "off" : "on") + "-view, the definition that it is not";
    for (std::size_t e = 0; e < in_cut.size(); ++e)
      if (in_cut[e] != (on[graph.edges()[e].first] != on[graph.edges()[e].second]))
        return where + "edge " + std::to_string(e) + (in_cut[e] ? " is" : " is not") + " in the cut-set";
  }
  return {};
}

template <class Make_traits>
Outcome along_a_path(const Posed_scene& posed, Random& random, Make_traits make_traits) {
  const Scene scene(posed.soup);
  const std::string flaw = flaw_along(scene, make_traits(scene), path_to_the_eye(posed, random));
  return flaw.empty() ? Outcome{} : Outcome::failed(flaw);
}

std::vector<Viewpoint> path_to_the_eye(const Posed_scene& posed, Random& random) {
  using namespace generate;
  std::vector<Viewpoint> path;
  const std::size_t points = posed.soup.point_count();
  Exact_point here = posed.eye;
  for (std::size_t count = points == 0 ? 0 : 6; count > 0; --count) {
    const Exact_point p = posed.soup.point(static_cast<Point_id>(random.below(points))),
                      q = posed.soup.point(static_cast<Point_id>(random.below(points)));
    switch (random.below(4)) {
      case 0: here = p; break;
      case 1: here = along(p, integer(random, -2, 3), minus(q, p)); break;
      case 2: here = along(here, ratio(1, static_cast<long>(random.between(1, 1000))), minus(p, here)); break;
      default: here = along(centroid({p, q}), integer(random, -3, 3), minus(here, q));
    }
    path.push_back({here});
    const Exact_point direction = minus(p, q);
    if (random.chance(1, 8) && !is_zero(direction)) path.push_back({direction, true});
  }
  path.push_back({posed.eye});
  return path;
}

bool is_on_view(const generate::Points& corners, const Viewpoint& view) {
  using namespace generate;
  Exact_point normal{0, 0, 0};
  for (std::size_t k = 0; k < corners.size(); ++k)
    normal = along(normal, 1, cross(corners[k], corners[(k + 1) % corners.size()]));
  const Exact_point d = view.at_infinity ? view.at : minus(view.at, corners[0]);
  return sgn(Rational(normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2])) > 0;
}

/// Follows the points of a path by the front door's tracker, and compares each step with the definition. Returns what
/// is wrong, or nothing.
std::string flaw_of_tracker(const Posed_scene& posed, const std::vector<Viewpoint>& path) {
  const Model model(posed.soup);
  Tracker tracker = sightline::track(model);
  std::vector<Face_id> before;
  for (const Viewpoint& view : path) {
    if (view.at_infinity) continue;
    std::set<Face_id> faces;
    for (const Part& part : model.parts())
      if (is_on_view(part.corners, view)) faces.insert(part.face);
    const std::vector<Face_id> now(faces.begin(), faces.end());
    std::vector<Face_id> changed;
    std::set_symmetric_difference(before.begin(), before.end(), now.begin(), now.end(), std::back_inserter(changed));
    const std::vector<Face_id> told = tracker.move_to(view.at);
    if (tracker.on_view() != now) return "the front door's tracker lists other faces on-view than the definition";
    for (Face_id face = 0; face < model.face_count(); ++face)
      if (tracker.on_view(face) != faces.contains(face))
        return "the front door's tracker lists " + face_name(face) + " otherwise than it says";
    if (told != changed) return "the front door's tracker tells of other changes than there are";
    before = now;
  }
  return {};
}

Check front_door() {
  Check check = front_door_check(tracked_by_front_door);
  check.run = [run = check.run](const Posed_scene& posed, const Answer& answer, Random& random) {
    const std::string flaw = flaw_of_tracker(posed, path_to_the_eye(posed, random));
    return flaw.empty() ? run(posed, answer, random) : Outcome::failed(flaw);
  };
  return check;
}

/// From nowhere straight to the eye. Labels: 1 where a node of the face is on-view.
Answer answer(const Posed_scene& posed) {
  const Scene scene(posed.soup);
  const Exact_traits traits(scene);
  const Face_graph graph(scene);
  Cut_set_tracker<Exact_traits> tracker(traits, graph);
  tracker.move_to({posed.eye});
  Answer answer;
  answer.labels.assign(posed.soup.face_count(), Answer::none);
  answer.planar = scene.counters().non_planar + scene.counters().no_simple_projection == 0;
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    std::uint32_t& label = answer.labels[scene.pieces()[i].face];
    label = (label == Answer::none ? 0u : label) | (tracker.on_view(graph.node(i)) ? 1u : 0u);
  }
  return answer;
}

}  // namespace cutset_subject

Subject cutset() {
  using namespace cutset_subject;
  Subject subject;
  subject.name = "cutset";
  subject.what = "on-view faces and the cut-set along paths, against the definition";
  subject.answer = cutset_subject::answer;
  subject.checks = {{"path", "each frame of a path is as the definition says",
                     [](const Posed_scene& posed, const Answer&, Random& random) {
                       return along_a_path(posed, random, [](const Scene& scene) { return Exact_traits(scene); });
                     }},
                    {"gmpq", "the same by Cartesian<Gmpq>",
                     [](const Posed_scene& posed, const Answer&, Random& random) {
                       return along_a_path(posed, random, [](const Scene& scene) {
                         return Point_traits<CGAL::Cartesian<CGAL::Gmpq>>(scene);
                       });
                     }},
                    front_door()};
  add_laws(subject,
           {"begin", "permute", "translate", "scale", "rotate", "stretch", "project", "mirror", "cut", "bystander"});
  return subject;
}

}  // namespace sightline::harness
