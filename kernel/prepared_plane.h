#pragma once
// A plane as predicates take it where it is asked often.

#include <sightline/kernel/plane.h>

namespace sightline {

/// A plane made ready for many sides: its oriented doubles and the bound below which they decide nothing.
struct Prepared_plane {
  Plane plane;
  bool exact;         ///< integers all through: at exact vertices the double value is the true one
  double a, b, c, d;  ///< oriented
  double norm;        ///< >= |a| + |b| + |c| of the true plane
  double bound;       ///< rounding error of the double value at any vertex, not counting the vertex's own error
};

}  // namespace sightline
