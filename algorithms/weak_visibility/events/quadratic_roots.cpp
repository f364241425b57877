#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>

#include <algorithm>
#include <utility>

namespace sightline {

bool Quadratic::is_zero() const { return sgn(c[0]) == 0 && sgn(c[1]) == 0 && sgn(c[2]) == 0; }

int Quadratic::sign(const Rational& s) const {
  const Integer &n = s.get_num(), &d = s.get_den();
  return sgn(Integer((c[2] * n + c[1] * d) * n + c[0] * d * d));
}

int Quadratic::certain_sign() const {
  const int low = sgn(c[0]), middle = sgn(Integer(2 * c[0] + c[1])), high = sgn(Integer(c[0] + c[1] + c[2]));
  if (low >= 0 && middle >= 0 && high >= 0) return 1;
  return low <= 0 && middle <= 0 && high <= 0 ? -1 : 0;
}

Quadratic_root::Quadratic_root(Integer p, int e, Integer d, Integer q)
    : p_(std::move(p)), d_(std::move(d)), q_(std::move(q)), e_(e) {
  if (sgn(q_) < 0) {
    p_ = -p_;
    q_ = -q_;
    e_ = -e_;
  }
  const Integer most = Integer(1) << 61, key = bits(60);
  key_ = Integer(key > most ? most : key < -most ? Integer(-most) : key).get_si();
}

Integer Quadratic_root::bits(unsigned long count) const {
  Integer root = d_ << (2 * count), k;
  mpz_sqrt(root.get_mpz_t(), root.get_mpz_t());
  const Integer top = (p_ << count) + e_ * root;
  mpz_fdiv_q(k.get_mpz_t(), top.get_mpz_t(), q_.get_mpz_t());
  return k;
}

int Quadratic_root::sign_of(const Quadratic& f) const {
  // q^2 f = x + y sqrt(d)
  const Integer x = (f.c[0] * q_ + f.c[1] * p_) * q_ + f.c[2] * (p_ * p_ + e_ * e_ * d_);
  if (e_ == 0 || sgn(d_) == 0) return sgn(x);
  const Integer y = e_ * (f.c[1] * q_ + 2 * f.c[2] * p_);
  const int xs = sgn(x), ys = sgn(y);
  if (xs == 0 || ys == 0 || xs == ys) return xs == 0 ? ys : xs;
  const int larger = cmp(Integer(x * x), Integer(y * y * d_));
  return larger > 0 ? xs : larger < 0 ? ys : 0;
}

std::optional<Rational> Quadratic_root::rational() const {
  Integer top = p_;
  if (e_ != 0) {
    if (mpz_perfect_square_p(d_.get_mpz_t()) == 0) return std::nullopt;
    top += e_ * sqrt(d_);
  }
  Rational value(top, q_);
  value.canonicalize();
  return value;
}

Quadratic Quadratic_root::polynomial() const {
  Quadratic f{{Integer(p_ * p_ - e_ * e_ * d_), Integer(-2 * p_ * q_), Integer(q_ * q_)}};
  const Integer common = gcd(gcd(f.c[0], f.c[1]), f.c[2]);
  for (Integer& c : f.c) c /= common;
  return f;
}

std::array<Rational, 2> Quadratic_root::bounds() const {
  if (const std::optional<Rational> root = rational()) return {*root, *root};
  const Quadratic f = polynomial();
  for (unsigned long count = 60;; count *= 2) {
    const Integer k = bits(count);
    Rational low(Integer(k - 1), Integer(1) << count), high(Integer(k + 2), Integer(1) << count);
    low.canonicalize();
    high.canonicalize();
    if (f.sign(low) * f.sign(high) < 0) return {low, high};  // else both roots are between them
  }
}

void append_roots(const Quadratic& f, const Parameter_range& range, std::vector<Quadratic_root>& roots) {
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

Rational inner_rational(const Parameter_range& range, unsigned long attempt) {
  const unsigned long parts = 2 * attempt + 3, fine = 4 + 2 * bit_length(Integer(attempt + 2));
  for (unsigned long count = 60;; count *= 2) {
    const Integer low = range.low.bits(count) + 2, width = Integer(range.high.bits(count) - 1) - low;
    if (sgn(width) <= 0 || bit_length(width) <= fine) continue;
    // Fractions (attempt + 1) / parts differ by more than what is cut off here.
    const unsigned long cut = bit_length(width) - fine;
    Integer k = low + width * (attempt + 1) / parts;
    k >>= cut;
    k <<= cut;
    if (k < low) continue;
    Rational s(k, Integer(1) << count);
    s.canonicalize();
    return s;
  }
}

std::vector<Parameter_range> divided(const Parameter_range& range, std::span<const Quadratic> polynomials) {
  std::vector<Quadratic_root> ends;
  for (const Quadratic& f : polynomials) append_roots(f, range, ends);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Parameter_range> parts;
  const Quadratic_root* low = &range.low;
  for (const Quadratic_root& end : ends) {
    parts.push_back({*low, end});
    low = &end;
  }
  parts.push_back({*low, range.high});
  return parts;
}

}  // namespace sightline
