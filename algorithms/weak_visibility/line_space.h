#pragma once
// The lines from one convex polygon to another: exact vertices with doubles beside them, and the sides of edge lines
// and planes on them.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sightline {

/// p / (w 2^exponent) within a relative 2^-52, and within 2^-1074 where it underflows; infinite beyond doubles: a
/// quotient of 63 or 64 bits, rounded. Pre: w > 0.
double near_quotient(const Integer& p, const Integer& w, long exponent);

/// Coordinates for doubles: the grid divided by a scale of the scene's own, a divisor and a power of two, so that those
/// of the scene's points are at most 1/2, and the bound of them at least 1/8. Those of a source are what they are.
class Near_frame {
 public:
  explicit Near_frame(const Scene& scene)
      : divisor_(scene.points().divisor()), has_exact_points_(scene.points().bits() <= 53) {
    exponent_ = scene.points().bits() - scene.points().shift() + 2 - static_cast<long>(bit_length(divisor_));
    shift_ = scene.points().shift() + exponent_;
  }
  /// A coordinate p / w of the grid, within a relative 2^-52 and 2^-1074.
  double near(const Integer& p, const Integer& w) const {
    return divisor_ == 1 ? near_quotient(p, w, shift_) : near_quotient(p, Integer(w * divisor_), shift_);
  }
  double near(const Scene& scene, std::uint32_t point, int axis) const {
    // Where it is made larger, so would be what the approximate coordinate lost to underflow.
    return exponent_ < 0 ? near(scene.points().integer(point, axis), 1)
                         : std::ldexp(scene.points().approximate(point, axis), -static_cast<int>(exponent_));
  }
  /// What such a coordinate leaves: the true one less `near`, within a relative 2^-52 and 2^-1074; 0 where it is
  /// infinite.
  double rest(const Integer& p, const Integer& w, double near) const;
  /// Whether the coordinates of all points of the scene leave nothing.
  bool has_exact_points() const { return has_exact_points_; }
  /// A form of degree three in coordinates of the grid, over w, as it would be in near ones.
  Rational near_cubic(const Integer& p, const Integer& w) const;
  /// The same times 2^exponent, in doubles: within a relative 2^-52, and within 2^-1074 where it underflows. Pre: w >
  /// 0.
  double near_cubic(const Integer& p, const Integer& w, long exponent) const;
  /// e with near_cubic(p, w) less than 2^e in size, and at least 2^(e - 2). Pre: p != 0, w > 0.
  long exponent_of_cubic(const Integer& p, const Integer& w) const;
  /// What a plane's last coefficient is multiplied by less than the others.
  Rational unit() const { return times_power(Rational(divisor_), shift_); }
  /// From these coordinates to those of boxes (Grid_points::approximate). It may underflow, even to 0.
  double to_boxes() const { return std::ldexp(1.0, static_cast<int>(exponent_)); }

 private:
  Integer over(const Integer& w) const { return divisor_ == 1 ? w : Integer(w * divisor_ * divisor_ * divisor_); }

  Integer divisor_;
  long exponent_, shift_;
  bool has_exact_points_;
};

/// A point in homogeneous grid coordinates, the last one positive, reduced; and in doubles, each within a relative
/// 2^-52 and 2^-1074, infinite beyond doubles.
struct Near_point {
  std::array<Integer, 4> exact;
  Triple near;
  Triple rest = {};  ///< what that leaves: the two together are within a relative 2^-104
};
using Near_polygon = std::vector<Near_point>;

Near_point near_point(const Near_frame& frame, std::array<Integer, 4> exact);

/// The way from p to q, each given with what it leaves: within 2^-51 of itself, 2^-99 of p and q, and 2^-1072. Proof:
/// P-70
inline Triple way_between(const Triple& p, const Triple& rest_of_p, const Triple& q, const Triple& rest_of_q) {
  Triple way;
  for (std::size_t k = 0; k < 3; ++k) way[k] = (q[k] - p[k]) + (rest_of_q[k] - rest_of_p[k]);
  return way;
}

/// The mean of a polygon's corners by weights that sum up to 1, in doubles.
Triple weighted_mean(const Near_polygon& polygon, const std::vector<double>& weights);

/// An oriented plane in grid coordinates.
struct Near_plane {
  std::array<Integer, 4> exact;
  std::array<double, 4> near;  ///< a positive multiple, the largest of the normal 1, each within 2^-52 and 2^-1074
};

Near_plane near_plane(const Near_frame& frame, const std::array<Integer, 4>& exact);

/// A plane's value at a point, in doubles: what may be believed of it is likely_side()'s.
inline double likely_value(const std::array<double, 4>& h, const Triple& p) {
  return h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3];
}
/// The side of a point that is known within a relative 2^-52 and 2^-1074, where doubles tell it; else 0. Proof: P-70
int likely_side(const Near_plane& h, const Triple& p);
/// The side of a point: doubles where they tell, integers where not. The bound: four products of factors each within
/// 2^-52, and their sum; and what underflows, the more the farther the point is. Exact: yes. Proof: P-70
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

/// Of polygons that have more pairs of corners no proof is looked for: `verify` refuses to check it, and what is kept
/// of each pair adds up.
inline constexpr std::size_t most_pairs = 10'000'000;

/// Of all pairs of corners, those with one corner of the source next to each other.
std::vector<Pluecker> pairs_of(const Near_polygon& source, const Near_polygon& target);

/// The same in integers: of grid points, and of homogeneous ones.
Exact_pluecker pluecker_of_edge(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b);
Exact_pluecker pluecker_of_pair(const std::array<Integer, 4>& p, const std::array<Integer, 4>& q);
inline Integer dot(const Exact_pluecker& a, const Exact_pluecker& b) {
  Integer sum = a[0] * b[0];
  for (std::size_t k = 1; k < 6; ++k) mpz_addmul(sum.get_mpz_t(), a[k].get_mpz_t(), b[k].get_mpz_t());
  return sum;
}

inline double size(const Triple& p) { return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }

/// The largest coordinates of two points, their sum and their product.
struct Ends {
  double sum, product;
};
inline Ends ends(double a, double b) { return {a + b, a * b}; }

/// Bounds the error of dot(pluecker_of_pair(p, q), pluecker_of_edge(a, b)): at most 6 products of three coordinates for
/// each of four choices, each factor within 2^-52 of the truth, and nine roundings: (3 x 2 + 9) x 6 u < 2^7 u; and what
/// underflows. Infinite where a coordinate is 2^64 or more. Proof: P-70
inline double side_error(const Ends& pq, const Ends& ab) {
  if (!(pq.sum + ab.sum < 0x1p64)) return std::numeric_limits<double>::infinity();
  return 0x1p-46 * (pq.sum * ab.product + pq.product * ab.sum) + 0x1p-900;
}

/// The side of a pair (p, q) of the line from a to b is the determinant of three ways: from p to q, from a to b, from p
/// to a. Bounds its error where these are at most so long and come from points with coordinates of at most `reach`.
/// Where that is 2^62 or more: infinite. Proof: P-70
inline double side_error(double pair, double edge, double between, double reach) {
  if (!(reach < 0x1p62)) return std::numeric_limits<double>::infinity();
  const double lost = 0x1p-46 * reach;
  return 0x1p-45 * ((pair + lost) * (edge + lost) * (between + lost)) + 0x1p-900;
}

}  // namespace sightline
