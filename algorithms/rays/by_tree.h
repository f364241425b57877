#pragma once
// Rays against an exact BSP tree: what a ray meets, node by node, in rationals.

#include <sightline/algorithms/bsp/query.h>
#include <sightline/algorithms/rays/ray.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <vector>

namespace sightline {

/// All hits of a ray, by t, then by face. Pre: a tree of all pieces of the scene. Errors: std::domain_error for a zero
/// direction. Cost: the nodes whose cells the ray's line enters, rational arithmetic. Exact: yes. Proof: P-95
std::vector<Face_hit> all_hits(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray,
                               Ray_start start = Ray_start::open);

/// Of these those of the least t; none where nothing is met. Cost: the nodes up to there, near ones first.
std::vector<Face_hit> first_hits(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray,
                                 Ray_start start = Ray_start::open);

}  // namespace sightline
