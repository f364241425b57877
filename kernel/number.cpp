#include <sightline/kernel/number.h>

#include <sightline/kernel/quoted.h>

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace sightline {

Rational exact_decimal(const Integer& mantissa, long exponent) {
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::labs(exponent)));
  if (exponent >= 0) return Rational(mantissa * power);
  Rational value(mantissa, power);
  value.canonicalize();
  return value;
}

double nearest_double(const Rational& value) {
  // p / 2^k with a numerator of 53 bits is a double.
  const mpz_srcptr top = value.get_num_mpz_t(), bottom = value.get_den_mpz_t();
  const std::size_t places = mpz_sizeinbase(bottom, 2) - 1;
  if (places < 1000 && mpz_sizeinbase(top, 2) <= 53 && mpz_scan1(bottom, 0) == places)
    return std::ldexp(mpz_get_d(top), -static_cast<int>(places));
  // As MPFR's manual has it for IEEE doubles: 53 bits, or as many as a subnormal has, rounded once.
  MPFR_DECL_INIT(rounded, 53);
  const mpfr_exp_t least = mpfr_get_emin();
  mpfr_set_emin(-1073);
  const int order = mpfr_set_q(rounded, value.get_mpq_t(), MPFR_RNDN);
  mpfr_subnormalize(rounded, order, MPFR_RNDN);
  mpfr_set_emin(least);
  return mpfr_get_d(rounded, MPFR_RNDN);
}

Rational times_power(Rational x, long exponent) {
  if (exponent >= 0) mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  else mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  return x;
}

double square_root(const Rational& square) {
  if (square == 0) return 0;
  // Near 1, so that nothing is lost of what is rounded.
  const long half = binary_exponent(square) / 2;
  constexpr long beyond = 5000;
  return std::ldexp(std::sqrt(nearest_double(times_power(square, -2 * half))),
                    static_cast<int>(std::clamp(half, -beyond, beyond)));
}

Rational rational_from_string(std::string_view text) {
  const auto all_digits = [](std::string_view s) {
    if (!s.empty() && (s.front() == '-' || s.front() == '+')) s.remove_prefix(1);
    return !s.empty() && s.find_first_not_of("0123456789") == std::string_view::npos;
  };
  const auto integer = [](std::string_view s) {
    if (s.front() == '+') s.remove_prefix(1);
    return Integer(std::string(s), 10);  // base 10 also after a leading zero
  };
  const std::size_t slash = text.find('/');
  const std::string_view top = text.substr(0, slash);
  const bool whole = slash == std::string_view::npos;
  const std::string_view bottom = whole ? std::string_view("1") : text.substr(slash + 1);
  if (!all_digits(top) || !all_digits(bottom)) throw std::invalid_argument("not a number p or p/q: " + quoted(text));
  if (whole) return integer(top);
  const Integer denominator = integer(bottom);
  if (sgn(denominator) == 0) throw std::invalid_argument("zero denominator in " + quoted(text));
  Rational value(integer(top), denominator);
  value.canonicalize();
  return value;
}

}  // namespace sightline
