#pragma once
// Viewpoints in regions, rays, pixels, pair codes and trees, held to brute force in rationals: checks of the subject
// `graph`. Each asks a share of the scenes, as they take longer than the rest.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Arcs from a region against eyes in it, and against all eyes that see one face over the other.
Check region_check();

/// Along a ray, which faces are pierced and in which order; the codes of each two of them; and whether faces cross that
/// have no code.
Check rays_check();

/// What the pixels of an image pierce, what is counted of it, and that the numbers of a tree are in order at each
/// pixel.
Check pixels_check();

/// A tree that cuts: its parts make up the faces, and along each ray the nearer one is drawn later.
Check splits_check();

}  // namespace sightline::harness
