#pragma once
// What building a BSP tree goes by.

#include <sightline/kernel/plane.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sightline {

struct Bsp_options {
  unsigned candidates = 5;    ///< face planes tried for each node
  unsigned sample = 48;       ///< polygons that a candidate is scored on, at most
  unsigned split_weight = 3;  ///< a split costs as much as an imbalance of this many polygons
  std::uint64_t seed = 1;     ///< of the random choice of candidates
  std::vector<Plane> first =
      {};  ///< planes of the topmost nodes on every way from the root, in this order: a near plane, say
  /// A node to begin with, and the places of its children: below 0, none.
  struct Given {
    Plane plane;
    std::int32_t front = -1, behind = -1;
  };
  std::vector<Given> given = {};  ///< a tree from place 0 on, all of it, behind the first planes: as a level has one
  int threads = 0;                ///< 0: as many as there are processors; the tree is the same for any number
  std::function<void(std::size_t done, std::size_t all)> progress =
      {};  ///< fragments settled, and of how many so far; called from any thread
};

}  // namespace sightline
