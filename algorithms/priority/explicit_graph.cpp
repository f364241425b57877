#include <sightline/algorithms/priority/explicit_graph.h>

#include <boost/graph/strong_components.hpp>

#include <algorithm>

namespace sightline {

Priority_components components(const Arc_graph& graph) {
  const std::size_t n = boost::num_vertices(graph);
  std::vector<std::uint32_t> component(n);
  if (n == 0) return {};
  const auto index = boost::get(boost::vertex_index, graph);
  const std::uint32_t count = boost::strong_components(
      graph, boost::make_iterator_property_map(component.begin(), index), boost::vertex_index_map(index));
  for (std::uint32_t& c : component) c = count - 1 - c;  // Boost numbers a component after those that it leads to
  return {std::move(component), count};
}

Arc_graph condensation(const Arc_graph& graph, const Priority_components& components) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> arcs;
  for (const auto& arc : boost::make_iterator_range(boost::edges(graph))) {
    const std::uint32_t a = components.h(boost::source(arc, graph)), b = components.h(boost::target(arc, graph));
    if (a != b) arcs.emplace_back(a, b);
  }
  std::sort(arcs.begin(), arcs.end());
  arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
  return Arc_graph(boost::edges_are_sorted, arcs.begin(), arcs.end(), static_cast<std::uint32_t>(components.size()));
}

bool Explicit_priority_graph::has_arc(std::uint32_t i, std::uint32_t j) const {
  const auto [begin, end] = boost::adjacent_vertices(i, graph_);
  return std::binary_search(begin, end, j);
}

template Explicit_priority_graph::Explicit_priority_graph(const Priority_relation<Exact_traits>&,
                                                          const std::function<void(std::size_t, std::size_t)>&);

}  // namespace sightline
