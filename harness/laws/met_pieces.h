#pragma once
// A law of images by the definition alone: the faces that a ray meets, in rationals.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// What centres show, of glass too, and where a rule had to choose, are what all pieces say of each ray by itself.
Check definition_check();

}  // namespace sightline::harness
