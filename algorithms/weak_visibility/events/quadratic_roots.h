#pragma once
// Parameters of events: roots of quadratics with integer coefficients, compared exactly, and simple rationals between
// them.

#include <sightline/kernel/number.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sightline {

/// c[0] + c[1] s + c[2] s^2, of degree at most two.
struct Quadratic {
  std::array<Integer, 3> c;
  bool is_zero() const;
  int sign(const Rational& s) const;
  /// The sign that it has on all of (0, 1) by its Bernstein coefficients; 0 where these do not tell. Pre: not zero.
  int certain_sign() const;
};

/// The number (p + e sqrt(d)) / q of [0, 1], q > 0. Comparison: by 60 bits, then exactly by squaring. Exact: yes
class Quadratic_root {
 public:
  Quadratic_root(Integer p, int e, Integer d, Integer q);
  explicit Quadratic_root(long whole) : Quadratic_root(Integer(whole), 0, Integer(0), Integer(1)) {}

  /// k with value 2^bits in (k - 1, k + 2): the square root and the quotient are each rounded by less than one.
  Integer bits(unsigned long count) const;
  double near() const { return std::ldexp(static_cast<double>(key_), -60); }
  /// 60 bits; those of two numbers tell which is less where they are apart.
  std::int64_t key() const { return key_; }
  static bool are_apart(std::int64_t a, std::int64_t b) { return a + 3 <= b || b + 3 <= a; }
  /// The sign of a polynomial here. Exact: yes
  int sign_of(const Quadratic& f) const;
  /// As a fraction where it is one. Exact: yes
  std::optional<Rational> rational() const;
  /// The quadratic with integer coefficients without a common factor that has this root; of rational ones a multiple of
  /// the square of the linear one. Exact: yes
  Quadratic polynomial() const;
  /// Fractions between which it is, and no other root of polynomial(); where it is a fraction, twice that. Exact: yes
  std::array<Rational, 2> bounds() const;

  friend int compare(const Quadratic_root& a, const Quadratic_root& b) {
    if (are_apart(a.key_, b.key_)) return a.key_ < b.key_ ? -1 : 1;
    // x + y sqrt(d) + z sqrt(f), by squaring what has the other sign.
    const Integer x = a.p_ * b.q_ - b.p_ * a.q_, y = a.e_ * b.q_, z = -b.e_ * a.q_;
    const Integer xx = x * x, yy = y * y * a.d_, zz = z * z * b.d_;
    const int ys = sgn(y) * sgn(a.d_), zs = sgn(z) * sgn(b.d_);
    const int roots = ys == zs ? ys : ys == 0 ? zs : zs == 0 ? ys : cmp(yy, zz) == 0 ? 0 : cmp(yy, zz) > 0 ? ys : zs;
    if (sgn(x) == 0 || roots == 0 || sgn(x) == roots) return sgn(x) == 0 ? roots : sgn(x);
    // x^2 - y^2 d - z^2 f against 2 y z sqrt(d f)
    const Integer u = xx - yy - zz, v = 4 * yy * zz;
    const int us = sgn(u), vs = ys * zs;
    const int larger = us != vs ? (us == 0 ? -vs : us) : us * cmp(Integer(u * u), v);  // of |x| over the roots
    return larger > 0 ? sgn(x) : larger < 0 ? -sgn(x) : 0;
  }
  bool operator<(const Quadratic_root& o) const { return compare(*this, o) < 0; }
  bool operator==(const Quadratic_root& o) const { return compare(*this, o) == 0; }

 private:
  Integer p_, d_, q_;
  int e_;
  std::int64_t key_;  // bits(60), or 2^61 where that is more, and -2^61 where it is less
};

template <class Key>
struct Open_range {
  Key low, high;
};
using Parameter_range = Open_range<Quadratic_root>;

/// Appends the roots strictly within a range. Degenerate: a double root is appended once; the zero polynomial has none.
/// Exact: yes
void append_roots(const Quadratic& f, const Parameter_range& range, std::vector<Quadratic_root>& roots);

/// A rational strictly within a range, of few bits; each attempt gives another one. Exact: yes
Rational inner_rational(const Parameter_range& range, unsigned long attempt = 0);

/// The parts into which roots of polynomials divide a range, in order. No polynomial but zero has a root within a part.
/// Exact: yes
std::vector<Parameter_range> divided(const Parameter_range& range, std::span<const Quadratic> polynomials);

}  // namespace sightline
