#pragma once
// Volumes that divide a level, and convex regions of its cells.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness::levels_subject {

/// Cells fill the volumes that they name, and boxes of a grid that are given as volumes see the same.
Outcome volumes(const Posed_scene& posed, Random& random);

/// Regions are convex, no face is inside, no two could be one, and one by itself sees what its cells see.
Outcome coarse(const Posed_scene& posed, Random& random);

}  // namespace sightline::harness::levels_subject
