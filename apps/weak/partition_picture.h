#pragma once
// Pictures of partitions, and what rays at random make of a face.

#include "../support/common.h"

#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>

#include <functional>

namespace sightline::app {

/// A face: each of its convex pieces, divided, and the shares of all of it.
struct Divided_face {
  Face_id face;
  std::vector<Light_partition> pieces;
  std::array<Bounded, lights> shares;
};

/// What rays say of a face: squares of each piece's chart, lit where all rays from there reach a source.
struct Sampled_face {
  struct Square {
    std::size_t piece;           ///< of the divided face
    std::array<double, 2> x, y;  ///< of the chart
    Light light;
  };
  std::vector<Square> squares;
  std::size_t rays = 0;
  std::array<double, lights> shares{};  ///< of the squares' areas within the face; 0 where there are none
  bool ended = false;                   ///< time ran out before all squares were sampled
};

/// About so many rays, from points at random of the face to points at random of the sources, each asked exactly. The
/// same for the same seed. Where time runs out, of the squares before.
Sampled_face sampled_face(const Occluders& occluders, const Divided_face& divided,
                          const std::vector<Weak_source>& sources, std::size_t rays, std::uint64_t seed,
                          const std::function<bool()>& out_of_time);

/// As SVG: the face as one sees it from its front, its first chart's x to the right; with what rays make of it beside
/// it, if that is given.
std::string picture_of(const Scene& scene, const Divided_face& divided, const Sampled_face* beside);

}  // namespace sightline::app
