#pragma once
// Cones in doubles, which tell of most pairs that a polygon is nowhere nearer. To be read after polygons.h.

#include <sightline/algorithms/verify/parallel.h>
#include <sightline/algorithms/verify/polygons.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace sightline::order_check {

using namespace certificate_check;

/// A vector in doubles, scaled by a power of two so that its longest coordinate is in [1/2, 1); zero for zero.
using Rounded_vector = std::array<double, 3>;

Rounded_vector rounded(const Integer_vector& vector);

/// The sign of the product of two vectors; nothing where doubles cannot tell. Proof: P-20
std::optional<int> sign_in_doubles(const Rounded_vector& a, const Rounded_vector& b);

/// A cone in doubles; an edge-on one has no rays. Proof: P-20
struct Rounded_cone {
  std::vector<Rounded_vector> rays;
  Rounded_vector nearness{};
  double distance = 0;  ///< by the same scale as nearness; not a number where that is beyond the range of doubles
  int sense = 1;        ///< of the cone

  Rounded_cone() = default;
  explicit Rounded_cone(const Cone& cone);
};

/// The side of the plane of b on which ray `ray` of a meets the polygon of a: 1 beyond it as seen from the eye, -1
/// before it; nothing where doubles cannot tell. Proof: P-20
std::optional<int> side_to_plane(const Rounded_cone& a, std::size_t ray, const Rounded_cone& b);

/// The side of edge plane `edge` of a on which a ray is, 1 inside; nothing where doubles cannot tell. Proof: P-20
std::optional<int> side_of_edge(const Rounded_cone& a, std::size_t edge, const Rounded_vector& ray);

/// All of them.
std::vector<Rounded_cone> rounded(const std::vector<Cone>& cones, const Workers& workers);

/// Whether doubles tell that a is nowhere nearer than b: all of one of them is on its side of the other's plane.
bool nowhere_nearer(const Rounded_cone& a, const Rounded_cone& b);

}  // namespace sightline::order_check
