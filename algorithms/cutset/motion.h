#pragma once
// A moving object is a viewpoint that moves the other way: rational rotations and translations, exactly.

#include <sightline/algorithms/cutset/viewpoint.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>

namespace sightline {

/// The rigid motion p -> R p + t, with R the rotation of the quaternion w + x i + y j + z k, which may have any length
/// but zero: rational quaternions give rational rotations, with no root.
struct Rigid_motion {
  std::array<Rational, 4> quaternion;  ///< w, x, y, z; 1, 0, 0, 0 turns nothing
  Exact_point translation;

  /// Where a viewpoint is for an object that was moved: R^T (p - t); a direction is turned only. Exact: yes. Errors:
  /// std::invalid_argument for the quaternion 0.
  Viewpoint seen_from(const Viewpoint& view) const;
};

}  // namespace sightline
