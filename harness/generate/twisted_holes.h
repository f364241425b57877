#pragma once
// Faces with holes that lie in no plane: where a projection along an axis is simple, it cuts them; else nothing does.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>

namespace sightline::generate {

struct Holed_face {
  Points outer;
  Faces holes;
};

/// A face of the lattice with one or two holes, most of them not planar, anyhow to the axes. Where the gap is zero, its
/// contour goes around nothing and the hole is in its plane; or the hole is upright on it; or a hole's corner is on the
/// contour as one looks down on it. A positive gap and a negative one are the two sides of it. Or everything is
/// anywhere.
Holed_face twisted_holes(Random& random, const Rational& gap);

}  // namespace sightline::generate
