#pragma once
// Targets that hang together in one plane: a check of the subject `weak`, of a share of scenes.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That a scene whose pieces are cut into fans of triangles sees the same, whether these are hidden together or one by
/// one, that each pair is asked about once, and that the certificate is accepted.
Check together_check();

}  // namespace sightline::harness
