#include <sightline/algorithms/cutset/decision_tree.h>

namespace sightline {

std::vector<Weighted_view> uniform_likelihood(std::span<const View_cell> cells, bool inside) {
  std::vector<Weighted_view> views;
  for (const View_cell& cell : cells)
    if (cell.on_view != 0 || inside) views.push_back({cell.on_view, cell.on_view != 0 && cell.open ? 1 : 0});
  return views;
}

Decision_tree least_tests(std::span<const Weighted_view> views, unsigned faces, std::size_t most_states,
                          const std::function<void()>& ask) {
  if (faces > 32) throw std::invalid_argument("decision trees for " + std::to_string(faces) + " faces: at most 32");
  Integer common = 1, total = 0;
  for (const Weighted_view& view : views) {
    if (sgn(view.weight) < 0) throw std::invalid_argument("a view of weight " + to_string(view.weight));
    const auto width = std::bit_width(view.on_view);
    if (static_cast<unsigned>(width) > faces)
      throw std::invalid_argument("a view of face " + std::to_string(width - 1) + ", of " + std::to_string(faces));
    common = lcm(common, view.weight.get_den());
  }
  std::map<std::uint32_t, Integer> weights;
  for (const Weighted_view& view : views) {
    const Integer weight = view.weight.get_num() * (common / view.weight.get_den());
    weights[view.on_view] += weight;
    total += weight;
  }
  if (sgn(total) == 0) throw std::invalid_argument("no view has a weight; give one of them a weight above zero");
  Decision_tree tree;
  if (bit_length(total) <= 57)  // a path has at most 32 tests, so all sums stay below 2^62
    decision_tree_detail::fill<std::int64_t>(tree, weights, total, most_states, ask,
                                             [](const Integer& weight) { return weight.get_si(); });
  else
    decision_tree_detail::fill<Integer>(tree, weights, total, most_states, ask,
                                        [](const Integer& weight) { return weight; });
  return tree;
}

}  // namespace sightline
