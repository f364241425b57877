#pragma once
// Scenes whose coordinates have exponents from one end of doubles to the other, mixed.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>

namespace sightline::generate {

/// Two to six planar convex faces and a convex source. Coordinates are 0 or m 2^e with |m| <= 3 and e one of two to
/// five exponents of the scene's own, from -1070 to 1020, in some scenes one or two of them along each axis, and in
/// some others for the source: doubles, though their products are not, and many are equal. Faces are upright walls,
/// rectangles across an axis, and triangles anywhere.
struct Faces_and_source {
  Faces faces;
  Points source;
};
Faces_and_source exponents(Random& random);

}  // namespace sightline::generate
