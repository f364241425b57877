#pragma once
// Solids of which it is known, face for face, what is made of them: a check of the subject `boolean`.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Of prisms on stars: apart from each other they keep their faces, whole; one that goes through a block leaves it with
/// walls, and a hole in two faces, which are a few polygons where holes are cut. Of tetrahedra, that a part of one
/// which is far away, and off their grid, changes nothing.
Check apart_solids_check();

}  // namespace sightline::harness
