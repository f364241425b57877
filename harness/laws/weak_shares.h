#pragma once
// Shares of light: the same of images of a scene, and of a source in parts.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That images of a scene under maps that keep shares, and the same scene from its source in two parts, have the same
/// shares of a face lit, in penumbra and in umbra; of a share of the smallest scenes, a convex face each.
Check shares_check();

}  // namespace sightline::harness
