#include "leaves.h"

#include <sightline/io/file.h>

#include <algorithm>

namespace sightline::app {

std::string compiled_level(const Common& common, const std::string& wanted) {
  if (common.scene != "-")
    if (std::string bytes = read_bytes(common.scene); looks_like_quake_level(bytes)) return bytes;
  throw Usage_error(wanted + " is of a level that is compiled, version 29; SCENE is none");
}

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

std::vector<std::vector<bool>> rows_of_level(const Level_cells& level, const Cell_pvs& pvs, const Quake_level& file) {
  std::vector<std::vector<bool>> rows = visible_leaves(level, pvs, std::max<std::size_t>(1, file.leaves.size()));
  rows.erase(rows.begin());  // leaf 0, which is solid, has none
  rows.resize(file.visible_leaves);
  for (std::vector<bool>& row : rows) {
    row.erase(row.begin());
    row.resize(file.visible_leaves);
  }
  return rows;
}

}  // namespace sightline::app
