#pragma once
// The subject `cutset`: on-view faces along a path of viewpoints, by a cut-set that moves.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

Subject cutset();

}  // namespace sightline::harness
