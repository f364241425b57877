#pragma once
// The priority graph apart: clusters that planes separate, and the codes of the pairs in the cycles that are left.

#include "graph.h"

#include <sightline/algorithms/priority/pair_code.h>
#include <sightline/algorithms/priority/tree.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <map>

namespace sightline::app {

/// The tree of clusters, the codes of the cycles that it leaves, and how many parts a BSP tree would have made.
struct Clusters {
  Priority_tree<Exact_traits> tree;
  double seconds = 0;
  std::uint64_t bsp_fragments = 0;
  std::map<Precedence, std::uint64_t> pairs;
  Json codes = Json::array();  // of the pairs that some ray pierces
};

Clusters clusters_of(const Scene& scene, const Exact_traits& traits, const Graph_arguments& arguments,
                     const Report& in_time);

Json to_json(const Clusters& clusters);
void print(const Clusters& clusters, const Graph_arguments& arguments);

}  // namespace sightline::app
