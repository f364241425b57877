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

template <class Number>
static std::array<Number, 3> rounded_to(const Exact_point& p) {
  return {static_cast<Number>(nearest_double(p[0])), static_cast<Number>(nearest_double(p[1])),
          static_cast<Number>(nearest_double(p[2]))};
}

template <class Number>
Rounded_planes<Number>::Rounded_planes(const Face_graph& graph) {
  const Scene& scene = graph.scene();
  std::vector<std::array<Number, 3>> corners;
  planes_.reserve(graph.size());
  for (std::uint32_t node = 0; node < graph.size(); ++node) {
    corners.clear();
    for (const Piece_corner& corner : scene.corners(scene.pieces()[graph.piece(node)]))
      corners.push_back(rounded_to<Number>(scene.position(corner.point)));
    std::array<Number, 4> h{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto &p = corners[i], &q = corners[(i + 1) % corners.size()];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t x = (k + 1) % 3, y = (k + 2) % 3;
        h[k] += (p[x] - q[x]) * (p[y] + q[y]);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) h[3] -= h[k] * corners[0][k];
    planes_.push_back(h);
  }
}

template <class Number>
std::vector<bool> Rounded_planes<Number>::on_view(const Viewpoint& view) const {
  const std::array<Number, 3> at = rounded_to<Number>(view.at);
  std::vector<bool> on(planes_.size());
  for (std::size_t node = 0; node < on.size(); ++node) {
    const auto& h = planes_[node];
    on[node] = h[0] * at[0] + h[1] * at[1] + h[2] * at[2] + (view.at_infinity ? Number(0) : h[3]) > 0;
  }
  return on;
}

template class Rounded_planes<float>;
template class Rounded_planes<double>;

}  // namespace sightline
