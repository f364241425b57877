#pragma once
// Weak visibility until some moment: a check of the subject `weak`, of a share of scenes.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That whatever time runs out at, by lines or by events, thorough or not, what is decided until then is right.
Check hurried_check();

}  // namespace sightline::harness
