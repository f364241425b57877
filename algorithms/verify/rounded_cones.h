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

/// Of a product of two rounded vectors, and of a side by such products, but for distances: more than there may be.
/// Proof: P-20
inline const double rounding_error = 0x1p-45;

inline double rounded_dot(const Rounded_vector& a, const Rounded_vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// On which side of the plane of b rays meet the polygon of a: 1 beyond it as seen from the eye, -1 before it; nothing
/// where doubles cannot tell. Proof: P-20
class Rounded_height {
 public:
  Rounded_height(const Rounded_cone& a, const Rounded_cone& b)
      : bound_(rounding_error * (a.distance > b.distance ? a.distance : b.distance)) {
    for (std::size_t k = 0; k < 3; ++k) form_[k] = a.distance * b.nearness[k] - b.distance * a.nearness[k];
  }
  std::optional<int> side(const Rounded_vector& ray) const {
    const double height = rounded_dot(form_, ray);
    if (height > bound_) return 1;
    if (height < -bound_) return -1;
    return std::nullopt;
  }

 private:
  Rounded_vector form_;
  double bound_;
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
