#pragma once
// How a BSP tree tells a check of its order where the order may be cut. The check trusts none of it, and does not
// include this file.

#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/algorithms/bsp/tree.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/sign.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// Visits every fragment as traverse() does, back to front, and adds to `cuts`, for each in turn, where the planes of
/// the tree cut their sequence: of nodes with fragments by depth; of others, and of those in whose plane the eye is,
/// the planes. Pre: the planes are the scene's, or `scene` is null, and the latter are left out. Cost, Exact: as
/// traverse().
template <class Traits, class Visit>
Traversal_counters traverse_with_cuts(const Traits& traits, const Bsp_tree<Traits>& tree,
                                      const typename Traits::Eye& eye, const Scene* scene, Order_cuts& cuts,
                                      Visit visit) {
  std::vector<std::uint32_t> depths(tree.nodes.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i)  // preorder
    for (const std::int32_t child : {tree.nodes[i].front, tree.nodes[i].behind})
      if (child != Bsp_tree<Traits>::leaf) depths[static_cast<std::size_t>(child)] = depths[i] + 1;
  const auto add_plane = [&](std::size_t node, Sign side) {
    if (scene == nullptr) return;
    // What comes before it is on the other side than the eye, or behind it.
    const Plane plane = tree.nodes[node].plane;
    const auto place = static_cast<std::uint32_t>(cuts.depths.size());
    cuts.others.push_back(
        {place, depths[node], scene->file_coefficients(side == CGAL::NEGATIVE ? plane : plane.opposite())});
  };
  return traverse_nodes(
      traits, tree, eye, Direction::back_to_front, [](std::size_t) { return true; },
      [&](std::size_t node, Sign side) {
        const auto fragments = tree.on(tree.nodes[node]);
        const bool has_no_cut = fragments.empty() || side == CGAL::ZERO;
        if (has_no_cut) add_plane(node, side);
        for (const Fragment<Traits>& fragment : fragments) {
          cuts.depths.push_back(depths[node]);
          visit(fragment, side);
        }
        if (has_no_cut && !fragments.empty()) add_plane(node, side);
      });
}

}  // namespace sightline
