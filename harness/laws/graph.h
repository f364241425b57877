#pragma once
// The subject `graph`: the strongly connected components of the priority graph and their order.

#include <sightline/algorithms/priority/components.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

namespace sightline::harness {

namespace graph_subject {

/// Labels: the component of a face's last piece. Faces of one piece are the rule.
Answer answer_of(const Polygon_soup& soup, const Scene& scene, const Priority_components& found);

Answer by_implicit(const Posed_scene& posed, bool verify);

/// All arcs, written out.
Outcome by_explicit(const Posed_scene& posed, const Answer& answer);

}  // namespace graph_subject

/// Certificates are checked by verify_graph.
Subject graph();

}  // namespace sightline::harness
