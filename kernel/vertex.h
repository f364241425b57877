#pragma once
// Vertices of plane-defined polygons: an input point, or the meet of three planes, with a double beside it that knows
// its error.

#include <sightline/kernel/plane.h>

#include <cstdint>
#include <limits>

namespace sightline {

/// A point in doubles, each coordinate within `error` of the truth; infinity: they say nothing.
struct Approximate_point {
  double x, y, z, error;
};

/// A vertex of a fragment. Its exact position is the input point, where it has one, or else the meet of its three
/// planes; the doubles only speed up decisions. It is never rounded into coordinates that are cut again, so cutting
/// does not make it wider. Proof: P-05
struct Vertex {
  double x, y, z;  ///< approximate coordinates (see Grid_points), each within `error` of the truth
  double error;    ///< 0: x, y, z are exact integers; infinity: they say nothing
  std::uint32_t
      plane[3];  ///< ids of planes that meet here; for a meet, their normals in this order are positively oriented
  /// An input point; or no_point; or with_plane(id), a fourth plane that is known to pass through the meet.
  std::uint32_t point;

  static constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t no_plane = no_point;
  static constexpr std::uint32_t with_plane(std::uint32_t id) { return ~(id + 1); }  // no_point for no_plane
  bool is_input() const { return point < Plane::max_axis_point; }
  /// The fourth plane, or no_plane. Pre: not an input point.
  std::uint32_t fourth_plane() const { return ~point - 1; }
};
static_assert(sizeof(Vertex) == 48);

}  // namespace sightline
