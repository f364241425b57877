#pragma once
// Vertices of plane-defined polygons: an input point, or the meet of three planes, with a double beside it that knows its error.

#include <cstdint>
#include <limits>

namespace sightline {

/// A vertex of a fragment. Its exact position is the input point, where it has one, or else the meet of its three planes; the doubles
/// only speed up decisions. It is never rounded into coordinates that are cut again, so cutting does not make it wider. Proof: P-05
struct Vertex {
  double x, y, z;          ///< grid coordinates times 2^-shift, each within `error` of the truth
  double error;            ///< 0: x, y, z are exact integers; infinity: they say nothing
  std::uint32_t plane[3];  ///< ids of planes that meet here; for a meet, their normals in this order are positively oriented
  std::uint32_t point;     ///< an input point, or no_point

  static constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();
  bool is_input() const { return point != no_point; }
};
static_assert(sizeof(Vertex) == 48);

}  // namespace sightline
