#pragma once
// The lines from one convex polygon to another: exact vertices with doubles beside them, and the sides of edge lines
// and planes on them.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// p / (w 2^exponent) within a relative 2^-52: a quotient of 63 or 64 bits, rounded. Pre: w > 0.
double near_quotient(const Integer& p, const Integer& w, long exponent);

/// Coordinates near [-1, 1] for doubles: the grid divided by a scale of the scene's own.
class Near_frame {
 public:
  explicit Near_frame(const Scene& scene) : divisor_(scene.points().divisor()) {
    exponent_ = std::max(0, std::ilogb(std::max(1.0, scene.points().range())) + 1);
    shift_ = scene.points().shift() + exponent_;
  }
  /// A coordinate p / w of the grid, within a relative 2^-52.
  double near(const Integer& p, const Integer& w) const {
    return divisor_ == 1 ? near_quotient(p, w, shift_) : near_quotient(p, Integer(w * divisor_), shift_);
  }
  double near(const Scene& scene, std::uint32_t point, int axis) const {
    return std::ldexp(scene.points().approximate(point, axis), -exponent_);
  }
  /// A form of degree three in coordinates of the grid, over w, as it would be in near ones.
  Rational near_cubic(const Integer& p, const Integer& w) const;
  /// What a plane's last coefficient is multiplied by less than the others.
  Rational unit() const {
    Rational one(divisor_);
    mpq_mul_2exp(one.get_mpq_t(), one.get_mpq_t(), static_cast<mp_bitcnt_t>(shift_));
    return one;
  }
  /// From these coordinates to those of boxes (Grid_points::approximate).
  double to_boxes() const { return std::ldexp(1.0, exponent_); }

 private:
  Integer divisor_;
  int exponent_;
  long shift_;
};

using Triple = std::array<double, 3>;

/// A point in homogeneous grid coordinates, the last one positive, reduced; and in doubles, each within a relative
/// 2^-52.
struct Near_point {
  std::array<Integer, 4> exact;
  Triple near;
};
using Near_polygon = std::vector<Near_point>;

Near_point near_point(const Near_frame& frame, std::array<Integer, 4> exact);

/// An oriented plane in grid coordinates.
struct Near_plane {
  std::array<Integer, 4> exact;
  std::array<double, 4> near;  ///< a positive multiple, each within a relative 2^-52
};

Near_plane near_plane(const Near_frame& frame, const std::array<Integer, 4>& exact);

/// The side of a point: doubles where they tell, integers where not. The bound: four products of factors each within
/// 2^-52, and their sum. Exact: yes.
int side(const Near_plane& h, const Near_point& p);

inline constexpr int both_sides = 2;
/// 1 or -1: a polygon is on that closed side of a plane, and not all in it; 0: it is in the plane; `both_sides`: it has
/// vertices on both sides. Exact: yes.
int side(const Near_plane& h, const Near_polygon& polygon);
inline bool is_across(const Near_plane& h, const Near_polygon& polygon) { return side(h, polygon) == both_sides; }

inline Integer value(const Near_plane& h, const Near_point& p) {
  return Integer(h.exact[0] * p.exact[0] + h.exact[1] * p.exact[1] + h.exact[2] * p.exact[2] + h.exact[3] * p.exact[3]);
}

/// The part of a convex polygon where the plane is >= 0: fewer than three vertices where that has no inside. Exact:
/// yes.
Near_polygon clip(const Near_frame& frame, const Near_polygon& polygon, const Near_plane& h, bool front);

// ---- Plücker coordinates
//
// side(p, q, e) = det[p, q, a, b] for homogeneous points and the edge from a to b. For p in front of a counterclockwise
// polygon and q behind it, the segment p q crosses its inside iff the side is positive for all of its edges. Proof:
// P-70

using Pluecker = std::array<double, 6>;
using Exact_pluecker = std::array<Integer, 6>;

/// Plücker coordinates of the line from q to p, moment first: their product with an edge's, term by term, is the side
/// of the pair (p, q).
Pluecker pluecker_of_pair(const Triple& p, const Triple& q);
/// Plücker coordinates of the line from a to b: (direction, moment).
Pluecker pluecker_of_edge(const Triple& a, const Triple& b);
inline double dot(const Pluecker& a, const Pluecker& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
}

/// The same in integers: of grid points, and of homogeneous ones.
Exact_pluecker pluecker_of_edge(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b);
Exact_pluecker pluecker_of_pair(const std::array<Integer, 4>& p, const std::array<Integer, 4>& q);
inline Integer dot(const Exact_pluecker& a, const Exact_pluecker& b) {
  Integer sum = a[0] * b[0];
  for (std::size_t k = 1; k < 6; ++k) mpz_addmul(sum.get_mpz_t(), a[k].get_mpz_t(), b[k].get_mpz_t());
  return sum;
}

inline double size(const Triple& p) { return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }

/// Bounds the error of dot(pluecker_of_pair(p, q), pluecker_of_edge(a, b)): at most 6 products of three coordinates for
/// each of four choices, each factor within 2^-52 of the truth, and eight roundings: (3 x 2 + 8) x 6 u < 2^7 u. `p`,
/// `q`, `a`, `b`: largest coordinates. Proof: P-70
inline double side_error(double p, double q, double a, double b) {
  return 0x1p-46 * ((p + q) * a * b + p * q * (a + b)) + 0x1p-1000;
}

}  // namespace sightline
