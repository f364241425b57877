#include <sightline/algorithms/verify/moments.h>

#include <sightline/algorithms/verify/verdict.h>

namespace sightline::along_check {

using namespace certificate_check;

namespace {

Rational value(const std::array<Rational, 3>& f, const Rational& t) { return Rational(f[0] + t * (f[1] + t * f[2])); }

/// The sign of f at t, in integers.
int sign_at_fraction(const Polynomial& f, const Rational& t) {
  const Integer &n = t.get_num(), &d = t.get_den();
  Integer sum = f[0] * d;
  mpz_addmul(sum.get_mpz_t(), f[1].get_mpz_t(), n.get_mpz_t());
  if (sgn(f[2]) != 0) sum = sum * d + f[2] * n * n;
  return sgn(sum);
}

/// The sign of f where it is least or greatest. Pre: it is of degree two.
int sign_at_extreme(const Polynomial& f) { return sgn(f[2]) * sgn(Integer(4 * f[0] * f[2] - f[1] * f[1])); }

}  // namespace

Moments::Moments(const std::vector<Path_moment>& moments) : moments_(moments) {
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const auto& [f, low, high] = moments[k];
    const auto refuse = [&](const char* why) { reject(name("moment", k) + why); };
    if (!canonical(low) || !canonical(high) || !canonical(f)) refuse(" is not in canonical numbers");
    // Of a quadratic: signs at the ends that differ, so one root between them, and not two.
    if (low != high && (low > high || sgn(f[2]) == 0 || sgn(value(f, low)) * sgn(value(f, high)) >= 0))
      refuse(" is not between two fractions at which a quadratic has opposite signs");
    if (low == high && (sgn(f[0]) != 0 || sgn(f[1]) != 0 || sgn(f[2]) != 0))
      refuse(" is a fraction, and has a quadratic, too");
    if (k > 0 && moments[k - 1].high >= low) refuse(" is not told to be after the one before it");
  }
  const auto is = [](const Path_moment& moment, long t) { return moment.low == t && moment.high == t; };
  if (moments.size() < 2 || !is(moments.front(), 0) || !is(moments.back(), 1))
    reject("the moments do not go from 0 to 1");
}

int Moments::compare(std::size_t k, const Rational& t) const {
  const auto& [f, low, high] = moments_[k];
  if (low == high) return sgn(Rational(low - t));
  if (t <= low) return 1;
  if (t >= high) return -1;
  return sgn(value(f, t)) * sgn(value(f, low));  // the sign is still that of the lower end: it is after t
}

int Moments::sign_at(std::size_t k, const Polynomial& f) const {
  const auto& [g, low, high] = moments_[k];
  if (low == high) return sign_at_fraction(f, low);
  // What is left of f by the moment's quadratic is linear.
  const Rational constant = f[0] * g[2] - f[2] * g[0], linear = f[1] * g[2] - f[2] * g[1];
  const int sense = sgn(g[2]);
  if (sgn(linear) == 0) return sense * sgn(constant);
  return sense * sgn(linear) * compare(k, Rational(-constant / linear));
}

bool Moments::has_extreme(std::size_t i, std::size_t j, const Polynomial& f) const {
  if (i == j || sgn(f[2]) == 0) return false;
  Rational t(Integer(-f[1]), Integer(2 * f[2]));
  t.canonicalize();
  return compare(i, t) < 0 && compare(j, t) > 0;
}

bool Moments::never_negative(std::size_t i, std::size_t j, const Polynomial& f) const {
  if (is_zero(f)) return true;
  if (sign_at(i, f) < 0 || (i != j && sign_at(j, f) < 0)) return false;
  return sgn(f[2]) <= 0 || sign_at_extreme(f) >= 0 || !has_extreme(i, j, f);
}

bool Moments::positive(std::size_t i, std::size_t j, const Polynomial& f) const {
  if (i == j) return sign_at(i, f) > 0;
  if (is_zero(f) || !never_negative(i, j, f)) return false;
  return sgn(f[2]) <= 0 || sign_at_extreme(f) > 0 || !has_extreme(i, j, f);
}

std::optional<int> Moments::sign(std::size_t i, std::size_t j, const Polynomial& f) const {
  if (i == j) return sign_at(i, f);
  if (is_zero(f)) return 0;
  if (positive(i, j, f)) return 1;
  if (positive(i, j, negated(f))) return -1;
  return std::nullopt;
}

}  // namespace sightline::along_check
