#include <sightline/harness/compare/cut_set_errors.h>

#include <array>

namespace sightline {

std::vector<bool> on_view_nodes(const Exact_traits& traits, const Face_graph& graph, const Viewpoint& view) {
  const Scene& scene = graph.scene();
  std::vector<bool> on(graph.size());
  Predicate_counts counts;
  const Located_point eye = traits.eye(view.at);
  for (std::uint32_t node = 0; node < graph.size(); ++node) {
    if (!view.at_infinity) {
      on[node] = traits.side(eye, graph.plane(node), counts) == CGAL::POSITIVE;
      continue;
    }
    const std::array<Rational, 4> h = scene.file_coefficients(graph.plane(node));
    on[node] = h[0] * view.at[0] + h[1] * view.at[1] + h[2] * view.at[2] > 0;
  }
  return on;
}

std::size_t cut_set_errors(const Face_graph& graph, const std::vector<bool>& truth, const std::vector<bool>& said,
                           const std::vector<std::uint32_t>& cut) {
  std::size_t wrong = 0;
  for (std::uint32_t node = 0; node < graph.size(); ++node) wrong += said[node] != truth[node];
  std::vector<bool> is_cut(graph.edges().size());
  for (const std::uint32_t e : cut) is_cut[e] = true;
  for (std::size_t e = 0; e < is_cut.size(); ++e)
    wrong += is_cut[e] != (truth[graph.edges()[e].first] != truth[graph.edges()[e].second]);
  return wrong;
}

}  // namespace sightline
