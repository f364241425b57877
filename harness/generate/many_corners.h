#pragma once
// Faces of many corners, concave ones among them, and planar faces with holes.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/twisted_holes.h>
#include <sightline/kernel/number.h>

#include <vector>

namespace sightline::generate {

/// A strictly convex polygon of 8 to 16 corners between two parabolas, or a parabola and three sides.
Points round_face(Random& random);

/// A simple polygon of 8 to 22 corners: convex, a comb, a saw, stairs, a star, a spiral, or one with straight corners.
Points many_cornered(Random& random);

/// One to three of them, copies in their planes or beside them, walls upon their edges, and others anywhere.
Faces many_corners(Random& random);

/// A face with one to three holes, by hand, that touch its contour and one another in corners, on edges or not. Beside
/// that by the gap: a hole is moved by so much in its plane, inwards or outwards.
Holed_face flat_holes(Random& random, const Rational& gap);

/// One or two faces with holes in them, and others through the holes, in them, upon them and beside them.
std::vector<Holed_face> windows(Random& random, const Rational& gap);

}  // namespace sightline::generate
