#pragma once
// Scenes for the laws of line drawings.

#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/families.h>

namespace sightline::harness::line_scenes {

/// Pages through one line, some of which end on it, the eye in the plane of one of them more often than not, and strips
/// between the eye and the line; or, in a scene of many faces, a valley that hides the others but for what is on its
/// bottom.
generate::Posed_scene any_pages(generate::Random& random);

/// Polygons of lattice points, mostly concave, of which corners are in line with diagonals and with sides; and fins on
/// some of their sides.
generate::Posed_scene any_outlines(generate::Random& random);

}  // namespace sightline::harness::line_scenes
