#pragma once
// The subject `graph`: the strongly connected components of the priority graph and their order.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Certificates are checked by verify_graph.
Subject graph();

}  // namespace sightline::harness
