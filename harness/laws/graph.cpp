#include <sightline/harness/laws/graph.h>

#include <sightline/algorithms/priority/certificate.h>
#include <sightline/algorithms/priority/components.h>
#include <sightline/algorithms/priority/explicit_graph.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/graph.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/empty_scenes.h>
#include <sightline/harness/laws/front_door.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/harness/laws/manners.h>
#include <sightline/harness/laws/priority_laws.h>
#include <sightline/harness/laws/questions.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace graph_subject {

/// Labels: the component of a face's last piece. Faces of one piece are the rule.
Answer answer_of(const Polygon_soup& soup, const Scene& scene, const Priority_components& found) {
  Answer answer;
  answer.labels.assign(soup.face_count(), Answer::none);
  answer.is_partition = true;
  answer.planar = scene.counters().non_planar + scene.counters().no_simple_projection == 0;
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    answer.whole = answer.whole && scene.pieces()[i].number == 0;
    answer.labels[scene.pieces()[i].face] = found.h(i);
  }
  return answer;
}

Answer by_implicit(const Posed_scene& posed, bool verify) {
  const Scene scene(posed.soup);
  const Exact_traits traits(scene);
  const Priority_relation<Exact_traits> faces(traits);
  Implicit_priority_graph<Priority_relation<Exact_traits>> graph(faces);
  Component_trees trees;
  const Priority_components found = graph.find_components(&trees);
  Answer answer = answer_of(posed.soup, scene, found);
  if (!verify) return answer;
  const Verdict verdict = verify_graph(posed.soup, graph_certificate(scene, faces, found, trees));
  if (!verdict.accepted) answer.flaw = "the certificate is rejected: " + verdict.why;
  return answer;
}

/// All arcs, written out.
Outcome by_explicit(const Posed_scene& posed, const Answer& answer) {
  const Scene scene(posed.soup);
  const Exact_traits traits(scene);
  const Priority_relation<Exact_traits> faces(traits);
  const Explicit_priority_graph graph(faces);
  const Priority_components found = components(graph);
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (std::uint32_t j = 0; j < faces.size(); ++j)
      if (graph.has_arc(i, j) && found.h(i) > found.h(j))
        return Outcome::failed("explicit: an arc from piece " + std::to_string(i) + " to piece " + std::to_string(j) +
                               ", of higher priority");
  // Between components, each arc once.
  std::set<std::pair<std::uint32_t, std::uint32_t>> expected, between;
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (std::uint32_t j = 0; j < faces.size(); ++j)
      if (graph.has_arc(i, j) && found.h(i) != found.h(j)) expected.emplace(found.h(i), found.h(j));
  const Arc_graph whole = condensation(graph.boost_graph(), found);
  for (const auto& arc : boost::make_iterator_range(boost::edges(whole)))
    between.emplace(boost::source(arc, whole), boost::target(arc, whole));
  if (between != expected || boost::num_edges(whole) != expected.size())
    return Outcome::failed("explicit: the arcs between components are not those between their members");
  std::vector<std::size_t> sizes(found.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) ++sizes[found.h(i)];
  const std::size_t largest = sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end());
  const auto cyclic = std::count_if(sizes.begin(), sizes.end(), [](std::size_t size) { return size > 1; });
  if (found.largest() != largest || found.cyclic() != static_cast<std::size_t>(cyclic))
    return Outcome::failed("explicit: components are counted wrongly");
  return compared(answer, answer_of(posed.soup, scene, found), "implicit", "explicit");
}

}  // namespace graph_subject

Subject graph() {
  using namespace graph_subject;
  Subject subject;
  subject.name = "graph";
  subject.what = "components of the priority graph: implicit and explicit, answers checked by verify";
  subject.answer = [](const Posed_scene& posed) { return by_implicit(posed, false); };
  subject.verified = [](const Posed_scene& posed) { return by_implicit(posed, true); };
  subject.checks = {
      {"explicit", "the same components from all arcs",
       [](const Posed_scene& posed, const Answer& answer, Random&) { return by_explicit(posed, answer); }},
      front_door_check(grouped_by_front_door)};
  add_laws(subject, {"begin", "permute", "translate", "scale", "rotate", "stretch", "project", "mirror", "turn"});
  // Last: others keep their random choices.
  for (const Check& check : {region_check(), rays_check(), pixels_check(), splits_check()})
    subject.checks.push_back(check);
  subject.checks.push_back(manners_check(questions_of_graph()));
  subject.checks.push_back(empty_scenes_check(subject.verified));
  return subject;
}

}  // namespace sightline::harness
