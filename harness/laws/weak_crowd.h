#pragma once
// Weak visibility among more than a thousand faces: a check of the subject `weak`.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Of a scene with a crowd of small triangles between the source and its faces: that what is hidden without them is
/// hidden, and that the certificate is accepted. For a share of scenes.
Check crowd_check();

}  // namespace sightline::harness
