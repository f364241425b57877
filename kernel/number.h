#pragma once
// Exact numbers: what the file says, and how it is written down again.

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sightline {

using Integer = mpz_class;
using Rational = mpq_class;  ///< always canonical: reduced, positive denominator

/// The number of bits of |n|; 0 for 0.
inline std::size_t bit_length(const Integer& n) { return sgn(n) == 0 ? 0 : mpz_sizeinbase(n.get_mpz_t(), 2); }

/// Whether n fits a signed 64-bit integer.
inline bool fits_int64(const Integer& n) {
  static_assert(sizeof(long) == 8);
  return n.fits_slong_p();
}

/// The rational that a finite double is.
/// Pre: std::isfinite(d), or std::domain_error. Exact: yes (subnormals and 1e308 too).
inline Rational exact(double d) {
  if (!std::isfinite(d)) throw std::domain_error("not a finite number");
  return Rational(d);  // mpq_set_d converts without rounding
}

/// The rational mantissa x 10^exponent. Cost: O(|exponent|) bits.
Rational exact_decimal(const Integer& mantissa, long exponent);

/// The double nearest to a rational, ties to even, as a correct decimal reader would give it; +-infinity beyond the
/// range. (GMP's own get_d truncates.) Exact: yes.
double nearest_double(const Rational& value);

/// e with |x| between 2^(e - 1) and 2^(e + 1), neither of them. Pre: x is not zero.
inline long binary_exponent(const Rational& x) {
  return static_cast<long>(bit_length(x.get_num())) - static_cast<long>(bit_length(x.get_den()));
}

/// x 2^exponent. Exact: yes.
Rational times_power(Rational x, long exponent);

/// n / 2^shift, cut off towards zero to the bits of a double: where doubles hold it, within 2^-52 of itself.
inline double cut_off(const Integer& n, long shift = 0) {
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, n.get_mpz_t());  // 1/2 <= |mantissa| < 1, or n is 0
  return std::ldexp(mantissa, static_cast<int>(std::clamp(exponent - shift, -5000L, 5000L)));
}

/// Integers up to a positive factor, the longest between 1/2 and 1 in magnitude, each within 2^-52 of its own value and
/// of the sign of what it stands for, or 0. Degenerate: zeros of zeros.
template <std::size_t n>
std::array<double, n> in_proportion(const std::array<Integer, n>& values) {
  std::size_t bits = 0;
  for (const Integer& x : values) bits = std::max(bits, bit_length(x));
  std::array<double, n> rounded;
  for (std::size_t k = 0; k < n; ++k) rounded[k] = cut_off(values[k], static_cast<long>(bits));
  return rounded;
}

/// Rationals over their least common denominator: the k-th is whole[k] / denominator.
template <std::size_t n>
struct Over_common {
  std::array<Integer, n> whole;
  Integer denominator = 1;

  explicit Over_common(const std::array<Rational, n>& values) {
    for (const Rational& x : values)
      if (x.get_den() != denominator) denominator = lcm(denominator, x.get_den());
    for (std::size_t k = 0; k < n; ++k) whole[k] = values[k].get_num() * Integer(denominator / values[k].get_den());
  }
};

/// The root of a rational, wherever doubles hold the root, to two units in its last place; +infinity beyond. Pre: it is
/// not negative.
double square_root(const Rational& square);

/// "p" or "p/q", reduced.
inline std::string to_string(const Rational& value) { return value.get_str(); }
inline std::string to_string(const Integer& value) { return value.get_str(); }

/// Reads "p" or "p/q" (decimal integers, q > 0 after the sign is moved); throws std::invalid_argument otherwise.
Rational rational_from_string(std::string_view text);

}  // namespace sightline
