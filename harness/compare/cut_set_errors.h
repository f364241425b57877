#pragma once
// How wrong a cut-set is, against a test of every face.

#include <sightline/algorithms/cutset/on_view.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// Whether each node of a face graph is on-view, by its plane alone. Pre: traits and graph are of one scene. Cost: a
/// test a node. Exact: yes
std::vector<bool> on_view_nodes(const Exact_traits& traits, const Face_graph& graph, const Viewpoint& view);

/// Nodes and edges of which an answer says something else than on_view_nodes(): `cut` are the edges that it calls cut.
/// Exact: yes
std::size_t cut_set_errors(const Face_graph& graph, const std::vector<bool>& truth, const std::vector<bool>& said,
                           const std::vector<std::uint32_t>& cut);

/// The same of a tracker.
template <class Tracker>
std::size_t cut_set_errors(const Face_graph& graph, const std::vector<bool>& truth, const Tracker& tracker) {
  std::vector<bool> said(graph.size());
  for (std::uint32_t node = 0; node < graph.size(); ++node) said[node] = tracker.on_view(node);
  return cut_set_errors(graph, truth, said, tracker.cut_edges());
}

/// The planes of a face graph's nodes in plain numbers, as programs have them: Newell's normal of corners rounded to
/// the nearest, through the first one. Cost: linear. Exact: no
template <class Number>
class Rounded_planes {
 public:
  explicit Rounded_planes(const Face_graph& graph);

  /// Whether each node is on-view, by the sign of a height in these numbers, which is believed. Cost: four products a
  /// node. Exact: no
  std::vector<bool> on_view(const Viewpoint& view) const;

 private:
  std::vector<std::array<Number, 4>> planes_;
};

extern template class Rounded_planes<float>;
extern template class Rounded_planes<double>;

}  // namespace sightline
