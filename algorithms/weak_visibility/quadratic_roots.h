#pragma once
// Parameters of events: roots of quadratics with integer coefficients, compared exactly, and simple rationals between
// them.

#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace sightline {

/// c[0] + c[1] s + c[2] s^2, of degree at most two.
struct Quadratic {
  std::array<Integer, 3> c;
  bool is_zero() const { return sgn(c[0]) == 0 && sgn(c[1]) == 0 && sgn(c[2]) == 0; }
  int sign(const Rational& s) const {
    const Integer &n = s.get_num(), &d = s.get_den();
    return sgn(Integer((c[2] * n + c[1] * d) * n + c[0] * d * d));
  }
  /// The sign that it has on all of (0, 1) by its Bernstein coefficients; 0 where these do not tell. Pre: not zero.
  int certain_sign() const {
    const int low = sgn(c[0]), middle = sgn(Integer(2 * c[0] + c[1])), high = sgn(Integer(c[0] + c[1] + c[2]));
    if (low >= 0 && middle >= 0 && high >= 0) return 1;
    return low <= 0 && middle <= 0 && high <= 0 ? -1 : 0;
  }
};

/// The number (p + e sqrt(d)) / q of [0, 1], q > 0. Comparison: by 60 bits, then exactly by squaring. Exact: yes
class Quadratic_root {
 public:
  Quadratic_root(Integer p, int e, Integer d, Integer q) : p_(std::move(p)), d_(std::move(d)), q_(std::move(q)), e_(e) {
    if (sgn(q_) < 0) p_ = -p_, q_ = -q_, e_ = -e_;
    key_ = bits(60);
  }
  explicit Quadratic_root(long whole) : Quadratic_root(Integer(whole), 0, Integer(0), Integer(1)) {}

  /// k with value 2^bits in (k - 1, k + 2): the square root and the quotient are each rounded by less than one.
  Integer bits(unsigned long count) const {
    Integer root = d_ << (2 * count), k;
    mpz_sqrt(root.get_mpz_t(), root.get_mpz_t());
    const Integer top = (p_ << count) + e_ * root;
    mpz_fdiv_q(k.get_mpz_t(), top.get_mpz_t(), q_.get_mpz_t());
    return k;
  }
  double near() const { return std::ldexp(key_.get_d(), -60); }

  friend int compare(const Quadratic_root& a, const Quadratic_root& b) {
    if (Integer(a.key_ + 3) <= b.key_) return -1;
    if (Integer(b.key_ + 3) <= a.key_) return 1;
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
  Integer key_;
};

/// Open.
struct Parameter_range {
  Quadratic_root low, high;
};

/// Appends the roots strictly within a range. Degenerate: a double root is appended once; the zero polynomial has none.
/// Exact: yes
inline void append_roots(const Quadratic& f, const Parameter_range& range, std::vector<Quadratic_root>& roots) {
  if (f.is_zero() || f.certain_sign() != 0) return;
  const auto keep = [&](const Quadratic_root& root) {
    if (range.low < root && root < range.high) roots.push_back(root);
  };
  const Integer &c0 = f.c[0], &c1 = f.c[1], &c2 = f.c[2];
  if (sgn(c2) == 0) return keep({Integer(-c0), 0, Integer(0), c1});  // c1 is not zero, or the sign were certain
  const Integer d = c1 * c1 - 4 * c2 * c0;
  if (sgn(d) < 0) return;
  keep({Integer(-c1), -1, d, Integer(2 * c2)});
  if (sgn(d) > 0) keep({Integer(-c1), 1, d, Integer(2 * c2)});
}

/// A rational strictly within a range, of few bits; each attempt gives another one. Exact: yes
inline Rational inner_rational(const Parameter_range& range, unsigned long attempt = 0) {
  const unsigned long parts = 2 * attempt + 3, fine = 4 + 2 * bit_length(Integer(attempt + 2));
  for (unsigned long count = 60;; count *= 2) {
    const Integer low = range.low.bits(count) + 2, width = Integer(range.high.bits(count) - 1) - low;
    if (sgn(width) <= 0 || bit_length(width) <= fine) continue;
    // Fractions (attempt + 1) / parts differ by more than what is cut off here.
    const unsigned long cut = bit_length(width) - fine;
    Integer k = low + width * (attempt + 1) / parts;
    k >>= cut, k <<= cut;
    if (k < low) continue;
    Rational s(k, Integer(1) << count);
    s.canonicalize();
    return s;
  }
}

/// The parts into which roots of polynomials divide a range, in order. No polynomial but zero has a root within a part.
/// Exact: yes
inline std::vector<Parameter_range> divided(const Parameter_range& range, std::span<const Quadratic> polynomials) {
  std::vector<Quadratic_root> ends;
  for (const Quadratic& f : polynomials) append_roots(f, range, ends);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Parameter_range> parts;
  const Quadratic_root* low = &range.low;
  for (const Quadratic_root& end : ends) parts.push_back({*low, end}), low = &end;
  parts.push_back({*low, range.high});
  return parts;
}

/// What is left of a range where something does not hold that changes at roots of polynomials only: parts in order,
/// neighbours joined, with the root between them. `holds(s)` is asked once in each part. Degenerate: what holds just at
/// a root takes nothing away. Exact: if `holds` is
template <class Holds>
std::vector<Parameter_range> parts_without(const Parameter_range& range, std::span<const Quadratic> polynomials,
                                           Holds holds) {
  std::vector<Parameter_range> left;
  bool joined = false;  // to the part before
  for (const Parameter_range& part : divided(range, polynomials)) {
    const bool is_left = !holds(inner_rational(part));
    if (is_left && joined) left.back().high = part.high;
    else if (is_left) left.push_back(part);
    joined = is_left;
  }
  return left;
}

}  // namespace sightline
