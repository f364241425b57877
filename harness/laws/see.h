#pragma once
// The subject `see`: the visible parts of faces and lines from an eye.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Certificates are checked by verify_visible.
Subject see();

}  // namespace sightline::harness
