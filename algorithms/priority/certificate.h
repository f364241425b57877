#pragma once
// Components of the priority graph as a certificate that a sceptic can check.

#include <sightline/algorithms/priority/components.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/algorithms/verify/graph.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>

namespace sightline {

/// What verify_graph() checks: pieces by component, highest priority first, and arcs that hold each component together.
/// Pre: components and trees are of one search of all faces' relation. Exact: yes
Graph_certificate graph_certificate(const Scene& scene, const Priority_relation<Exact_traits>& faces,
                                    const Priority_components& components, const Component_trees& trees);

}  // namespace sightline
