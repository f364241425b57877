#pragma once
// What is wrong with operands, and areas, of boxes that lack faces: a check of the subject `boolean`.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Of boxes on a lattice, some without some of their faces, or with one that crosses itself: that exactly these faces
/// and the edges that only one face has are told, and that the area of all, at any scale, is within its bounds.
Check open_solids_check();

}  // namespace sightline::harness
