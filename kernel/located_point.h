#pragma once
// Points that are not of a scene, on its grid.

#include <sightline/kernel/number.h>

namespace sightline {

/// A point that is not of the scene (an eye, a query), in homogeneous grid coordinates.
struct Located_point {
  Integer x, y, z, w;  ///< w > 0
  double ax, ay, az;   ///< approximations of x/w, ... times 2^-shift
  double error;        ///< their absolute error; infinity where doubles say nothing
};

}  // namespace sightline
