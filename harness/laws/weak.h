#pragma once
// The subject `weak`: faces weakly visible from the source polygon.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Certificates are checked by verify_weak.
Subject weak();

}  // namespace sightline::harness
