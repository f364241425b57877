#pragma once
// What an eye sees on its way, held to what it sees where it is: a check of the subject `see`.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That along paths that begin at the scene's eye the same faces are seen as from points of them: at the ends, at
/// events, between each event and the next, and anywhere; and that the way back sees the same.
Check moving_eye_check();

}  // namespace sightline::harness
