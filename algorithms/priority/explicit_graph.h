#pragma once
// The priority graph with all its arcs written out, as a Boost graph. Quadratic: the oracle of the implicit one, and
// what DOT is made of.

#include <sightline/algorithms/priority/components.h>
#include <sightline/algorithms/priority/relation.h>

#include <boost/graph/compressed_sparse_row_graph.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace sightline {

/// A Boost graph: vertex i is face i.
using Arc_graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                                     boost::no_property, std::uint32_t, std::uint64_t>;

/// The components of any graph of arcs in an order of priority. Cost: linear. Exact: yes.
Priority_components components(const Arc_graph& graph);

/// The arcs between components: G' of the paper, acyclic. Vertex c is component c; an arc a -> b has a < b, once. Cost:
/// O(arcs log arcs).
Arc_graph condensation(const Arc_graph& graph, const Priority_components& components);

/// The graph of a relation, explicit. `Relation` has size() and arcs(i, j, counters).
class Explicit_priority_graph {
 public:
  /// Cost: O(n^2) pairs, and memory for the arcs (4 bytes each). Exact: as the relation is.
  template <class Relation>
  explicit Explicit_priority_graph(const Relation& relation,
                                   const std::function<void(std::size_t done, std::size_t all)>& progress = {}) {
    // 1. By the face that they begin at, in order: those to earlier faces come with these, those to later ones after.
    const std::uint32_t n = relation.size();
    std::vector<std::vector<std::uint32_t>> to(n);
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = i + 1; j < n; ++j) {
        if (progress && (j - i) % 256 == 1) progress(i, n);
        const Arcs both = relation.arcs(i, j, counters_);
        if (both.forth) to[i].push_back(j);
        if (both.back) to[j].push_back(i);
      }
      count += to[i].size();
    }
    // 2. One after the other.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> arcs;
    arcs.reserve(count);
    for (std::uint32_t i = 0; i < n; ++i)
      for (const std::uint32_t j : std::exchange(to[i], {})) arcs.emplace_back(i, j);
    graph_ = Arc_graph(boost::edges_are_sorted, arcs.begin(), arcs.end(), n);
  }

  std::size_t size() const { return boost::num_vertices(graph_); }
  std::size_t arc_count() const { return boost::num_edges(graph_); }
  bool has_arc(std::uint32_t i, std::uint32_t j) const;
  const Arc_graph& boost_graph() const { return graph_; }
  const Relation_counters& counters() const { return counters_; }

  friend Priority_components components(const Explicit_priority_graph& g) { return components(g.graph_); }

 private:
  Arc_graph graph_;
  Relation_counters counters_;
};

static_assert(Priority_graph<Explicit_priority_graph>);

extern template Explicit_priority_graph::Explicit_priority_graph(
    const Priority_relation<Exact_traits>&, const std::function<void(std::size_t, std::size_t)>&);  // compiled once

}  // namespace sightline
