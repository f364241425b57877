#pragma once
// The edges of a scene: where faces end.

#include <sightline/kernel/scene/scene.h>

#include <cstdint>
#include <vector>

namespace sightline {

/// An edge of the scene: its points, and the pieces that it bounds. Where pieces of one face meet is none.
struct Scene_edge {
  std::uint32_t p, q;  ///< p < q
  std::vector<std::uint32_t> pieces;
};

/// The edges of a scene, by their points. Of a piece's side only what bounds its face counts, as where a corner of the
/// face lies on a diagonal; edges of several faces are one where their ends are the same. Cost: O(n log n). Exact: yes.
std::vector<Scene_edge> scene_edges(const Scene& scene);

}  // namespace sightline
