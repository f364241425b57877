#pragma once
// Faces on a tiny lattice, where nearly everything touches something.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>

#include <cstddef>

namespace sightline::generate {

/// Five or six corners on a tiny lattice, all but the last in one plane. Mostly the loop crosses itself there, and then
/// it is simple along no axis: its surface is a cone, which is folded flat, with parts of either sense in that plane.
Points folded_loop(Random& random);

/// A few faces on a tiny lattice: coplanar, touching, interpenetrating, repeated, turned, concave, non-planar, folded
/// flat, without area.
Faces tangle(Random& random, std::size_t most_faces = 7);

/// Two to eight triangles and parallelograms on a small lattice, most of them placed by an earlier one: in its plane
/// (either sense), parallel to it, on one of its edges, on a corner, with a corner on its edge or inside, or through
/// it. Every face is planar and convex.
Faces touching_faces(Random& random);

}  // namespace sightline::generate
