#pragma once
// The subject `pvs`: cells of a scene, the walls between them, and what each cell sees.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

Subject pvs();

}  // namespace sightline::harness
