#pragma once
// Points, planes and lines in homogeneous coordinates: in integers, and in doubles with a bound of their error.
//
// A line has Plücker coordinates (direction, moment), as pluecker_of_edge() gives them. side(a, b) = det[p, q, r, s]
// for the points p, q that a is joined from, and r, s of b.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

namespace sightline {

namespace homogeneous_detail {  // what both kinds of numbers are joined by

template <class N>
std::array<N, 6> joined(const std::array<N, 4>& a, const std::array<N, 4>& b) {
  return {a[3] * b[0] - b[3] * a[0], a[3] * b[1] - b[3] * a[1], a[3] * b[2] - b[3] * a[2],
          a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class N>
std::array<N, 4> plane_of(const std::array<N, 4>& x, const std::array<N, 6>& e) {
  return {e[1] * x[2] - e[2] * x[1] + x[3] * e[3], e[2] * x[0] - e[0] * x[2] + x[3] * e[4],
          e[0] * x[1] - e[1] * x[0] + x[3] * e[5], -(x[0] * e[3] + x[1] * e[4] + x[2] * e[5])};
}

template <class N>
std::array<N, 6> met(const std::array<N, 4>& g, const std::array<N, 4>& h) {
  return {g[1] * h[2] - g[2] * h[1], g[2] * h[0] - g[0] * h[2], g[0] * h[1] - g[1] * h[0],
          g[3] * h[0] - h[3] * g[0], g[3] * h[1] - h[3] * g[1], g[3] * h[2] - h[3] * g[2]};
}

}  // namespace homogeneous_detail

// ---- In integers

using Homogeneous = std::array<Integer, 4>;

Exact_pluecker join(const Homogeneous& a, const Homogeneous& b);
/// The plane through a point and a line; zero where the point is on the line. Linear in the point.
Homogeneous join(const Homogeneous& x, const Exact_pluecker& e);
/// The point in which a line meets a plane; zero where it lies in it.
Homogeneous meet(const Homogeneous& h, const Exact_pluecker& e);
/// The line in which two planes meet. Bilinear.
Exact_pluecker meet(const Homogeneous& g, const Homogeneous& h);
Integer dot(const Homogeneous& a, const Homogeneous& b);
Integer side(const Exact_pluecker& a, const Exact_pluecker& b);
template <std::size_t n>
bool all_zero(const std::array<Integer, n>& a) {
  return std::all_of(a.begin(), a.end(), [](const Integer& x) { return sgn(x) == 0; });
}
/// Divided by the common factor, the last entry other than zero positive. Returns the sign that it had. Pre: not zero.
template <std::size_t n>
int make_canonical(std::array<Integer, n>& a) {
  Integer common = 0;
  int sign = 0;
  for (const Integer& x : a) {
    common = gcd(common, x);
    if (sgn(x) != 0) sign = sgn(x);
  }
  for (Integer& x : a) x = x / common * sign;
  return sign;
}
struct Less_entries {
  template <std::size_t n>
  bool operator()(const std::array<Integer, n>& a, const std::array<Integer, n>& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                        [](const Integer& x, const Integer& y) { return cmp(x, y) < 0; });
  }
};

// ---- In doubles

/// A positive multiple of such a vector, in coordinates of a Near_frame: entries are within `error` of it, and at most
/// `size`. Where anything is beyond doubles an entry or the error is infinite or not a number, and no sign is certain.
template <std::size_t n>
struct Near {
  std::array<double, n> at;
  double size, error;
};

Near<4> near(const Near_point& p);
Near<4> near(const Near_plane& h);
/// Pre: x[3] > 0
Near<4> near(const Near_frame& frame, const Homogeneous& x);
/// Pre: not at infinity
Near<6> near(const Near_frame& frame, const Exact_pluecker& e);

namespace homogeneous_detail {

/// Bounds the error of sums of so many products of entries: by those of the entries, and by rounding; what underflows
/// is less than the last term. Infinite, or not a number, where a part of such a sum may overflow. Proof: P-73
template <std::size_t n, std::size_t m>
double error_of_products(int count, const Near<n>& a, const Near<m>& b) {
  const double most = 2.0 * count * (a.size * b.size);  // twice a sum of them: it overflows before one does
  return 1.001 * count * (a.size * b.error + a.error * (b.size + b.error) + 0x1p-53 * most) + 0x1p-960;
}

template <std::size_t n>
Near<n> bounded(const std::array<double, n>& at, double error) {
  double size = 0;
  for (const double x : at) size = std::max(size, std::fabs(x));
  return {at, size, error};
}

inline double near_side(const std::array<double, 6>& a, const std::array<double, 6>& b) {
  return -(a[0] * b[3] + a[1] * b[4] + a[2] * b[5] + a[3] * b[0] + a[4] * b[1] + a[5] * b[2]);
}

inline int certain_sign(double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; }

}  // namespace homogeneous_detail

inline Near<6> join(const Near<4>& a, const Near<4>& b) {
  return homogeneous_detail::bounded(homogeneous_detail::joined(a.at, b.at),
                                     homogeneous_detail::error_of_products(2, a, b));
}

inline Near<4> join(const Near<4>& x, const Near<6>& e) {
  return homogeneous_detail::bounded(homogeneous_detail::plane_of(x.at, e.at),
                                     homogeneous_detail::error_of_products(3, x, e));
}

inline Near<6> meet(const Near<4>& g, const Near<4>& h) {
  return homogeneous_detail::bounded(homogeneous_detail::met(g.at, h.at),
                                     homogeneous_detail::error_of_products(2, g, h));
}

template <std::size_t n>
Near<n> operator+(const Near<n>& a, const Near<n>& b) {
  std::array<double, n> sum;
  for (std::size_t k = 0; k < n; ++k) sum[k] = a.at[k] + b.at[k];
  return homogeneous_detail::bounded(sum, 1.001 * (a.error + b.error + 0x1p-52 * (a.size + b.size)) + 0x1p-960);
}

/// Half of it.
template <std::size_t n>
Near<n> half(Near<n> a) {
  for (double& x : a.at) x /= 2;
  return {a.at, a.size / 2, a.error / 2 + 0x1p-960};
}

/// The sign of dot(a, b); 0 where doubles do not tell. Exact: yes
inline int certain_dot(const Near<4>& a, const Near<4>& b) {
  return homogeneous_detail::certain_sign(a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2] + a.at[3] * b.at[3],
                                          homogeneous_detail::error_of_products(4, a, b));
}

/// The sign of side(a, b); 0 where doubles do not tell. Exact: yes
inline int certain_side(const Near<6>& a, const Near<6>& b) {
  return homogeneous_detail::certain_sign(homogeneous_detail::near_side(a.at, b.at),
                                          homogeneous_detail::error_of_products(6, a, b));
}

// ---- Both

/// A point or a plane, in integers with doubles beside them.
struct Filtered {
  Homogeneous exact;
  Near<4> near;
};

/// The sign of dot(a, b): doubles where they tell. Exact: yes
inline int sign_of_dot(const Filtered& a, const Filtered& b) {
  const int sure = certain_dot(a.near, b.near);
  return sure != 0 ? sure : sgn(dot(a.exact, b.exact));
}

/// The side of a plane on which all points surely are; 0 where doubles do not tell, or they are on both. Exact: yes
inline int certain_side(const Near<4>& plane, std::span<const Filtered> points) {
  int common = 0;
  for (const Filtered& point : points) {
    const int sure = certain_dot(plane, point.near);
    if (sure == 0 || sure == -common) return 0;
    common = sure;
  }
  return common;
}
/// The same of lines and a line.
inline int certain_side(std::span<const Near<6>> lines, const Near<6>& line) {
  int common = 0;
  for (const Near<6>& own : lines) {
    const int sure = certain_side(own, line);
    if (sure == 0 || sure == -common) return 0;
    common = sure;
  }
  return common;
}

/// The line through two points: in doubles, and in integers once these are asked for. Refers to the points.
class Joined_line {
 public:
  Joined_line(const Filtered& a, const Filtered& b) : a_(&a), b_(&b), near_(join(a.near, b.near)) {}
  const Near<6>& near() const { return near_; }
  const Exact_pluecker& exact() const {
    if (!exact_) exact_ = join(a_->exact, b_->exact);
    return *exact_;
  }

 private:
  const Filtered *a_, *b_;
  Near<6> near_;
  mutable std::optional<Exact_pluecker> exact_;
};

}  // namespace sightline
