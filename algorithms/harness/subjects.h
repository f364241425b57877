#pragma once
// All commands that can be fuzzed without a file.

#include <sightline/algorithms/harness/cutset.h>
#include <sightline/algorithms/harness/graph.h>
#include <sightline/algorithms/harness/order.h>
#include <sightline/algorithms/harness/see.h>
#include <sightline/algorithms/harness/weak.h>

namespace sightline::harness {

inline std::vector<Subject> subjects() { return {order(), graph(), cutset(), see(), weak()}; }

}  // namespace sightline::harness
