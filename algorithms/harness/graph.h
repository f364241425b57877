#pragma once
// The subject `graph`: the strongly connected components of the priority graph and their order.

#include <sightline/algorithms/harness/laws.h>
#include <sightline/algorithms/priority/explicit_graph.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/verify/covering_of_scene.h>
#include <sightline/algorithms/verify/graph.h>
#include <sightline/kernel/exact_traits.h>

namespace sightline::harness {

namespace graph_subject {

/// Pieces by component, highest priority first, and arcs that hold each component together.
inline Graph_certificate certificate_of(const Scene& scene, const Priority_relation<Exact_traits>& faces, const Priority_components& found, const Component_trees& trees) {
  Graph_certificate certificate;
  std::vector<std::size_t> place(faces.size());
  for (std::size_t c = 0; c < found.size(); ++c) {
    certificate.sizes.push_back(found[c].size());
    for (const std::uint32_t i : found[c]) {
      place[i] = certificate.fragments.size();
      Order_fragment& fragment = certificate.fragments.emplace_back();
      fragment.face = scene.pieces()[i].face, fragment.piece = scene.pieces()[i].number;
      for (const Piece_corner& corner : scene.corners(scene.pieces()[i])) fragment.vertices.push_back(scene.position(corner.point));
    }
  }
  Predicate_counts counts;
  const auto add = [&](std::uint32_t from, std::uint32_t to) {
    if (from != to) certificate.arcs.push_back({place[from], place[to], faces.find_corner(from, CGAL::POSITIVE, to, counts), faces.find_corner(to, CGAL::NEGATIVE, from, counts)});
  };
  for (std::uint32_t i = 0; i < faces.size(); ++i) add(trees.from[i], i), add(i, trees.to[i]);
  add_pieces(certificate, scene);
  return certificate;
}

/// Labels: the component of a face's last piece. Faces of one piece are the rule.
inline Answer answer_of(const Polygon_soup& soup, const Scene& scene, const Priority_components& found) {
  Answer answer;
  answer.labels.assign(soup.face_count(), Answer::none);
  answer.is_partition = true;
  answer.planar = scene.non_planar().empty();
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    answer.whole = answer.whole && scene.pieces()[i].number == 0;
    answer.labels[scene.pieces()[i].face] = found.h(i);
  }
  return answer;
}

inline Answer by_implicit(const Posed_scene& posed, bool verify) {
  const Scene scene(posed.soup);
  const Exact_traits traits(scene);
  const Priority_relation<Exact_traits> faces(traits);
  Implicit_priority_graph<Priority_relation<Exact_traits>> graph(faces);
  Component_trees trees;
  const Priority_components found = graph.find_components(&trees);
  Answer answer = answer_of(posed.soup, scene, found);
  if (!verify) return answer;
  const Verdict verdict = verify_graph(posed.soup, certificate_of(scene, faces, found, trees));
  if (!verdict.accepted) answer.flaw = "the certificate is rejected: " + verdict.why;
  return answer;
}

/// All arcs, written out.
inline Outcome by_explicit(const Posed_scene& posed, const Answer& answer) {
  const Scene scene(posed.soup);
  const Exact_traits traits(scene);
  const Priority_relation<Exact_traits> faces(traits);
  const Explicit_priority_graph graph(faces);
  const Priority_components found = components(graph);
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (std::uint32_t j = 0; j < faces.size(); ++j)
      if (graph.has_arc(i, j) && found.h(i) > found.h(j)) return Outcome::failed("explicit: an arc from piece " + std::to_string(i) + " to piece " + std::to_string(j) + ", of higher priority");
  return compared(answer, answer_of(posed.soup, scene, found), "implicit", "explicit");
}

}  // namespace graph_subject

/// Certificates are checked by verify_graph.
inline Subject graph() {
  using namespace graph_subject;
  Subject subject;
  subject.name = "graph", subject.what = "components of the priority graph: implicit and explicit, answers checked by verify";
  subject.answer = [](const Posed_scene& posed) { return by_implicit(posed, false); };
  subject.verified = [](const Posed_scene& posed) { return by_implicit(posed, true); };
  subject.checks = {{"explicit", "the same components from all arcs", [](const Posed_scene& posed, const Answer& answer, Random&) { return by_explicit(posed, answer); }}};
  add_laws(subject, {"permute", "translate", "scale", "rotate", "mirror", "turn"});
  return subject;
}

}  // namespace sightline::harness
