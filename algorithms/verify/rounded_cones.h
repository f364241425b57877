#pragma once
// Cones in doubles, which tell of most pairs that a polygon is nowhere nearer. To be read after polygons.h.

#include <sightline/algorithms/verify/polygons.h>

#include <array>
#include <optional>
#include <vector>

namespace sightline::order_check {

using namespace certificate_check;

/// A cone's rays, and the form by which they meet its polygon, each rounded and scaled by a power of two so that no
/// number is beyond [-1, 1]. An edge-on one has no rays. Proof: P-20
struct Rounded_cone {
  std::vector<std::array<double, 3>> rays;
  std::array<double, 4> nearness{};  ///< and the distance

  explicit Rounded_cone(const Cone& cone);
};

/// The side of the plane of b on which ray `ray` of a meets the polygon of a: 1 beyond it as seen from the eye, -1
/// before it; nothing where doubles cannot tell. Proof: P-20
std::optional<int> side_to_plane(const Rounded_cone& a, std::size_t ray, const Rounded_cone& b);

/// Whether doubles tell that a is nowhere nearer than b: all of one of them is on its side of the other's plane.
bool nowhere_nearer(const Rounded_cone& a, const Rounded_cone& b);

}  // namespace sightline::order_check
