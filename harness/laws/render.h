#pragma once
// The subject `render`: images of what is visible, by the methods that claim to be right.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Labels: whether a face is shown, off ties, in one of six views around the eye.
Subject render();

}  // namespace sightline::harness
