#include <sightline/harness/laws/front_door.h>

#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/kernel/vectors.h>
#include <sightline/sightline.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sightline::harness {
namespace {

/// With a budget, of an hour: it is asked after wherever one is, and changes nothing.
Asking in_one_thread() { return {1, {}, 3600}; }

/// No face has a label but those that the model keeps, which have this one.
Answer blank(const Model& model, std::uint32_t label) {
  Answer answer;
  answer.labels.assign(model.face_count(), Answer::none);
  for (const Part& part : model.parts()) answer.labels[part.face] = label;
  return answer;
}

void check_certificate(const Model& model, const sightline::Answer& given, Answer& answer) {
  const Checked checked = sightline::verify(model, given.certificate(), in_one_thread());
  if (!checked.accepted) answer.flaw = "the front door's certificate is rejected: " + checked.why;
}

/// That the parts which are listed are what is seen: they are put into the certificate, in place of its own.
std::string flaw_of_parts(const Model& model, const Seen& found) {
  std::istringstream told(found.certificate());
  Visible_certificate claim = std::get<Visible_certificate>(read_certificate(told));
  std::map<std::pair<Face_id, std::uint32_t>, std::size_t> place_of;
  for (std::size_t k = 0; k < claim.fragments.size(); ++k)
    place_of[{claim.fragments[k].face, claim.fragments[k].piece}] = k;
  claim.parts.clear();
  for (const Seen::Visible_part& part : found.parts) {
    const auto place = place_of.find({part.face, part.piece});
    if (place == place_of.end()) return "the front door has a part of no piece of " + face_name(part.face);
    Exact_point ray{0, 0, 0};
    for (const Exact_point& p : part.corners)
      for (std::size_t k = 0; k < 3; ++k) ray[k] += p[k] - found.eye[k];
    claim.parts.push_back({place->second, part.corners, ray});
  }
  const Verdict verdict = verify_visible(model.soup(), claim, {1, {}});
  return verdict.accepted ? std::string() : "the front door's parts are not what is seen: " + verdict.why;
}

/// That a model's facts are what its parts show.
std::string flaw_of_facts(const Model& model, const Polygon_soup& soup) {
  const Facts& facts = model.facts();
  std::set<Face_id> faces;
  std::optional<std::array<Exact_point, 2>> box;
  for (const Part& part : model.parts()) {
    faces.insert(part.face);
    for (const Exact_point& p : part.corners) {
      if (!box) box = {p, p};
      for (std::size_t k = 0; k < 3; ++k) {
        (*box)[0][k] = std::min((*box)[0][k], p[k]);
        (*box)[1][k] = std::max((*box)[1][k], p[k]);
      }
    }
  }
  if (facts.box != box) return "the front door's box is not that of the faces";
  if (facts.points_read != soup.point_count() || facts.faces_read != soup.face_count() || facts.faces != faces.size() ||
      facts.parts != model.parts().size())
    return "the front door counts other points, faces or parts than there are";
  return {};
}

/// The eye's side of a convex part: 1 in front, -1 behind, 0 in its plane.
int side_of(const Exact_point& eye, const std::vector<Exact_point>& corners) {
  Exact_point normal{0, 0, 0};
  for (std::size_t k = 1; k + 1 < corners.size() && is_zero(normal); ++k)
    normal = cross(minus(corners[k], corners[0]), minus(corners[k + 1], corners[0]));
  return sgn(dot(normal, minus(eye, corners[0])));
}

}  // namespace

Answer ordered_by_front_door(const Posed_scene& posed) {
  const Model model(posed.soup);
  const Visibility_order found = sightline::order(model, posed.eye, in_one_thread());
  Answer answer = blank(model, 0);
  for (const Part& part : found.parts) {
    const int side = side_of(posed.eye, part.corners);
    answer.labels[part.face] |= side > 0 ? 1u : side < 0 ? 2u : 4u;
  }
  check_certificate(model, found, answer);
  if (answer.flaw.empty()) answer.flaw = flaw_of_facts(model, posed.soup);
  return answer;
}

Answer grouped_by_front_door(const Posed_scene& posed) {
  const Model model(posed.soup);
  const Priority found = sightline::priority_graph(model, in_one_thread());
  Answer answer = blank(model, Answer::none);
  std::vector<std::size_t> times(model.parts().size());
  std::size_t cyclic = 0;
  for (std::uint32_t c = 0; c < found.components.size(); ++c) {
    cyclic += found.components[c].size() > 1;
    for (const std::uint32_t part : found.components[c]) {
      ++times.at(part);
      // As the subject does it: a face has the component of its last part.
      const Face_id face = model.parts()[part].face;
      if (part + 1 == model.parts().size() || model.parts()[part + 1].face != face) answer.labels[face] = c;
    }
  }
  check_certificate(model, found, answer);
  if (found.cyclic != cyclic)
    answer.flaw = "the front door says that " + std::to_string(found.cyclic) + " components are cyclic, not " +
                  std::to_string(cyclic);
  if (std::any_of(times.begin(), times.end(), [](std::size_t n) { return n != 1; }))
    answer.flaw = "the front door has a part in no component, or in several";
  return answer;
}

Answer tracked_by_front_door(const Posed_scene& posed) {
  const Model model(posed.soup);
  Tracker tracker = sightline::track(model);
  tracker.move_to(posed.eye);
  Answer answer = blank(model, 0);
  for (const Face_id face : tracker.on_view()) answer.labels[face] = 1;
  return answer;
}

Answer seen_by_front_door(const Posed_scene& posed) {
  const Model model(posed.soup);
  const Seen found = sightline::see(model, posed.eye, in_one_thread());
  Answer answer = blank(model, 0);
  label_seen(found, answer);
  for (const Seen::Visible_part& part : found.parts)
    if ((answer.labels[part.face] & (part.from_front ? 1u : 2u)) == 0)
      answer.flaw = "the front door has a part of face " + std::to_string(part.face) + ", but does not list the face";
    else if (part.from_front != (side_of(posed.eye, part.corners) > 0))
      answer.flaw = "the front door has a part of face " + std::to_string(part.face) + " from its other side";
  check_certificate(model, found, answer);
  if (!answer.flaw.empty()) return answer;
  answer.flaw = flaw_of_parts(model, found);
  return answer;
}

Answer weakly_seen_by_front_door(const Posed_scene& posed) {
  const Model model(posed.soup);
  const Weak_visibility found = sightline::weakly_visible(model, {{posed.source}}, in_one_thread());
  Answer answer = blank(model, Answer::none);
  label_weakly_seen(found, answer);
  check_certificate(model, found, answer);
  return answer;
}

Check front_door_check(Answer (*by_front_door)(const Posed_scene&)) {
  return {"front_door", "the same from sightline/sightline.h, and the certificate checked where it gives one",
          [by_front_door](const Posed_scene& posed, const Answer& answer, Random&) {
            if (answer.undecided > 0) return Outcome::undecided();  // events, which it goes on to, may take long
            const Answer other = by_front_door(posed);
            if (!other.flaw.empty()) return Outcome::failed(other.flaw);
            Answer by_number = answer;  // where labels are components: in what order they come, too
            by_number.is_partition = false;
            return compared(by_number, other, "the subject", "the front door");
          }};
}

}  // namespace sightline::harness
