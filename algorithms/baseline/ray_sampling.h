#pragma once
// Weak visibility as it is usually estimated: random rays, and what they hit first.

#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sightline {

struct Ray_sampling_options {
  std::size_t rays = 100000;  ///< from each source
  std::uint64_t seed = 1;
  bool two_sided = false;
  std::function<void(std::size_t done, std::size_t all)> progress = {};  ///< rays; called now and then
};

/// The faces that at least one of the rays hits first, from their front (or from behind too). Rays start at points
/// spread evenly over each source and go to all sides in front of it, more of them upright (as light from a matt lamp).
/// Post: sorted; the same seed gives the same rays. Degenerate: what is small, far or behind a narrow opening is
/// missed; rays through cracks that are none are believed. Cost: rays times log n, as a rule. Exact: no: in doubles,
/// and nothing is proved.
std::vector<Face_id> visible_by_sampling(const Occluders& occluders, const std::vector<Weak_source>& sources,
                                         const Ray_sampling_options& options = {});

}  // namespace sightline
