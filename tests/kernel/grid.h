#pragma once
// Grids, planes through them, and an oracle for sides that knows nothing but Cramer's rule on rationals.

#include <gtest/gtest.h>

#include <sightline/kernel/predicates.h>

#include <array>
#include <random>
#include <vector>

namespace kernel_test {

using namespace sightline;
using Random = std::mt19937_64;
using Coefficients = std::array<Integer, 4>;
using Position = std::array<Rational, 3>;

inline Integer power_of_two(int k) {
  Integer n;
  mpz_setbit(n.get_mpz_t(), static_cast<mp_bitcnt_t>(k));
  return n;
}
/// Uniform in (-2^bits, 2^bits).
inline Integer uniform(Random& random, int bits) {
  Integer n = 0;
  for (int k = 0; k < bits; k += 32) n = (n << 32) + Integer(static_cast<unsigned long>(random() & 0xffffffff));
  mpz_fdiv_r_2exp(n.get_mpz_t(), n.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
  return random() % 2 ? n : Integer(-n);
}
/// Uniform in its bit length, so that small numbers come too.
inline Integer any_size(Random& random, int bits) {
  return uniform(random, 1 + static_cast<int>(random() % static_cast<std::uint64_t>(bits)));
}

inline Rational rational(const Integer& p, const Integer& q) {
  Rational r(p, q);
  r.canonicalize();
  return r;
}
inline Rational shifted(Rational value, long shift) {  // value x 2^-shift
  if (shift >= 0) mpq_div_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(shift));
  else mpq_mul_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-shift));
  return value;
}

inline Coefficients negated(Coefficients h) {
  for (Integer& x : h) x = -x;
  return h;
}
inline Rational evaluate(const Coefficients& h, const Position& x) {
  return h[0] * x[0] + h[1] * x[1] + h[2] * x[2] + h[3];
}

/// The plane through three points; its normal is zero where they are collinear.
inline Coefficients through(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b,
                            const std::array<Integer, 3>& c) {
  std::array<Integer, 3> u, v;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
  }
  Coefficients h{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0], 0};
  h[3] = -(h[0] * a[0] + h[1] * a[1] + h[2] * a[2]);
  return h;
}

/// Where three planes meet; nothing where they do not in one point. By elimination, in rationals.
inline std::optional<Position> meeting_point(const Coefficients& p, const Coefficients& q, const Coefficients& r) {
  std::array<std::array<Rational, 4>, 3> m;
  for (std::size_t k = 0; k < 4; ++k) {
    m[0][k] = p[k];
    m[1][k] = q[k];
    m[2][k] = r[k];
  }
  for (std::size_t column = 0; column < 3; ++column) {
    std::size_t pivot = column;
    while (pivot < 3 && m[pivot][column] == 0) ++pivot;
    if (pivot == 3) return std::nullopt;
    std::swap(m[pivot], m[column]);
    for (std::size_t row = 0; row < 3; ++row) {
      if (row == column || m[row][column] == 0) continue;
      const Rational factor = m[row][column] / m[column][column];
      for (std::size_t k = column; k < 4; ++k) m[row][k] -= factor * m[column][k];
    }
  }
  Position x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = -m[k][3] / m[k][k];
  return x;
}

inline Sign sign(const Rational& value) { return static_cast<Sign>(sgn(value)); }

/// A grid of the given width with planes on it, and the coefficients that each plane was made from.
struct Grid {
  Grid_points points;
  Plane_table planes;
  Point_planes incidences;
  std::vector<Coefficients> made;  // of handles[i], oriented
  std::vector<Plane> handles;

  explicit Grid(int bits, const Integer& divisor = 1) : points(bits, divisor), planes(points) {}

  std::uint32_t point(const std::array<Integer, 3>& p) { return points.intern(p); }
  Plane plane(const Coefficients& h) {
    made.push_back(h);
    handles.push_back(planes.intern(h[0], h[1], h[2], h[3]));
    return handles.back();
  }
  std::array<Integer, 3> at(std::uint32_t p) const {
    return {points.integer(p, 0), points.integer(p, 1), points.integer(p, 2)};
  }
  /// A grid coordinate in the scale of the doubles.
  Rational approximated(const Rational& x) const { return shifted(x / points.divisor(), points.shift()); }
  Predicates predicates() const { return {points, planes, incidences}; }
};

/// Which stage decided, as "combinatorial", "filtered", "fixed" or "gmp"; "several" where not exactly one did.
inline std::string deciding_stage(const Predicate_counts& counts) {
  if (counts.total() != 1) return "several";
  return counts.combinatorial ? "combinatorial" : counts.filtered ? "filtered" : counts.fixed ? "fixed" : "gmp";
}

}  // namespace kernel_test
