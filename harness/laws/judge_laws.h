#pragma once
// Whether `sightline judge` finds an answer wrong iff it is: checks of the subjects `boolean` and `trace`.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Answers to a set operation on two solids of the scene's faces, right or not: results of any operation, both solids
/// as they are, a result less a face. They differ from the exact one by a volume, or not; or they are open.
Check judged_solids_check();

/// Answers about rays, right or not: by the definition of what each meets.
Check judged_rays_check();

}  // namespace sightline::harness
