#include <sightline/own_leaves.h>

#include <sightline/kernel/number.h>

#include <array>
#include <stdexcept>

namespace sightline {

Space_tree space_tree(const Quake_level& level, const std::string& file) {
  Space_tree tree;
  tree.root = level.root;
  for (const Quake_level::Node& node : level.nodes) {
    const Quake_level::Plane& plane = level.planes[node.plane];
    if (plane.normal == std::array<float, 3>{})
      throw std::runtime_error(file + ": a node's plane has no normal; compile the level again");
    tree.nodes.push_back({{exact(double{plane.normal[0]}), exact(double{plane.normal[1]}),
                           exact(double{plane.normal[2]}), -exact(double{plane.distance})},
                          node.children});
  }
  if (tree.nodes.empty() && tree.root >= 0) tree.root = -1;
  return tree;
}

}  // namespace sightline
