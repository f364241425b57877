#pragma once
// Solids as sources, held to brute force: a check of the subject `weak`.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Of boxes and tetrahedra among the scene's points, that may touch, overlap, be the same in part or be holes: that
/// Weak_volume has the surface of their union, sees from within what rationals say, and shows a face that a sightline
/// from its inside reaches; and that it takes no faces that do not close up. For a share of scenes.
Check volume_check();

}  // namespace sightline::harness
