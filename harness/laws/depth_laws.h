#pragma once
// Depth buffers where they are to be right: a check of the subject `render`, in scenes of its own.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Depth buffers and what they blend, against rays in doubles, at pixels that are well inside of faces, or well beside
/// them, and of faces well behind one another; that what is out of bounds is refused, and what floats do not hold is
/// counted.
Check depth_check();

}  // namespace sightline::harness
