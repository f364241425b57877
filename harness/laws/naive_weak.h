#pragma once
// Naive weak visibility where it is to be right: a check of the subject `weak`, in scenes of its own.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Rays at random, and the search in doubles, in rooms and piles of plates where what is seen is known, or proved.
Check naive_weak_check();

}  // namespace sightline::harness
