#pragma once
// All commands that can be fuzzed without a file.

#include <sightline/harness/laws/cutset.h>
#include <sightline/harness/laws/graph.h>
#include <sightline/harness/laws/levels.h>
#include <sightline/harness/laws/order.h>
#include <sightline/harness/laws/render.h>
#include <sightline/harness/laws/see.h>
#include <sightline/harness/laws/shadow.h>
#include <sightline/harness/laws/solids.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/harness/laws/trace.h>
#include <sightline/harness/laws/weak.h>

#include <vector>

namespace sightline::harness {

inline std::vector<Subject> subjects() {
  return {order(), graph(), cutset(), see(), weak(), render(), trace(), shadow(), boolean(), pvs()};
}

}  // namespace sightline::harness
