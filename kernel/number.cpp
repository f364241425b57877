#include <sightline/kernel/number.h>

#include <sightline/kernel/quoted.h>

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
  const int sign = sgn(value);
  if (sign == 0) return 0.0;
  const Integer numerator = abs(value.get_num());
  const Integer& denominator = value.get_den();
  // Scale so that the integer quotient has at least 54 bits, or fewer where the result is subnormal.
  long shift = 55 - (static_cast<long>(bit_length(numerator)) - static_cast<long>(bit_length(denominator)));
  long precision_floor = 1074 + 1;  // one bit below the last subnormal bit
  if (shift > precision_floor) shift = precision_floor;
  Integer n = numerator, d = denominator, quotient, remainder;
  if (shift >= 0) n <<= static_cast<unsigned long>(shift);
  else d <<= static_cast<unsigned long>(-shift);
  mpz_tdiv_qr(quotient.get_mpz_t(), remainder.get_mpz_t(), n.get_mpz_t(), d.get_mpz_t());
  // Keep 53 bits (fewer for subnormals, where the lowest bit of the quotient is the rounding bit).
  const long bits = static_cast<long>(bit_length(quotient));
  long drop = bits - 53;
  if (const long least = 1 - (1075 - shift); shift == precision_floor && drop < least) drop = least;
  if (drop > 0) {
    Integer low, half;
    mpz_fdiv_r_2exp(low.get_mpz_t(), quotient.get_mpz_t(), static_cast<unsigned long>(drop));
    mpz_setbit(half.get_mpz_t(), static_cast<unsigned long>(drop - 1));
    quotient >>= static_cast<unsigned long>(drop);
    const int order = cmp(low, half);
    const bool sticky = sgn(remainder) != 0;
    if (order > 0 || (order == 0 && (sticky || mpz_odd_p(quotient.get_mpz_t())))) ++quotient;
  } else {
    drop = 0;
  }
  return sign * std::ldexp(quotient.get_d(), static_cast<int>(drop - shift));
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
  const std::string_view bottom = slash == std::string_view::npos ? std::string_view("1") : text.substr(slash + 1);
  if (!all_digits(top) || !all_digits(bottom)) throw std::invalid_argument("not a number p or p/q: " + quoted(text));
  const Integer denominator = integer(bottom);
  if (sgn(denominator) == 0) throw std::invalid_argument("zero denominator in " + quoted(text));
  Rational value(integer(top), denominator);
  value.canonicalize();
  return value;
}

}  // namespace sightline
