#pragma once
// Numbers in text: what digits say, exactly.

#include <sightline/io/format.h>
#include <sightline/io/text.h>
#include <sightline/kernel/coordinates.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace sightline {

/// mantissa x 10^exponent. Canonical: exponent <= 0; where it is below 0, mantissa is no multiple of 10.
struct Decimal {
  std::int64_t mantissa;
  int exponent;
  friend bool operator==(const Decimal&, const Decimal&) = default;
};

/// A finite number of a file. A Decimal wherever one can hold it, except that a binary file's float stays one and that
/// p/q and what was rounded may be the other kinds. Of the numbers parse_decimal gives, equal ones are == .
using Number = std::variant<Decimal, double, Rational>;

/// A decimal is an integer x 10^E, E the exponent less the number of digits after the point; zeros at the end are
/// dropped while E < 0, so that 1.0e-1100 is read, and 1.0e1101 is 10 x 10^1100. |E| at most this, or a file of twenty
/// bytes would fill the memory, and one number of many places would make every coordinate on its grid as long. Every
/// double is within it (the least is 5^1074 x 10^-1074).
inline constexpr std::int64_t largest_decimal_exponent = 1100;
/// So many digits before its point a decimal may have: every coordinate on its grid gets as long.
inline constexpr std::size_t most_digits_before_point = 2200;

void push(Coordinates& coordinates, const Number& number);

Rational value_of(const Number& number);

namespace detail {

inline constexpr auto powers_of_ten = [] {
  std::array<std::uint64_t, 20> powers{1};
  for (std::size_t k = 1; k < powers.size(); ++k) powers[k] = 10 * powers[k - 1];
  return powers;
}();

/// digits x 10^exponent where that needs more than 18 digits. Pre: digits only; |exponent| <= largest_decimal_exponent.
Number wide_decimal(bool negative, const std::string& digits, int exponent);

/// Why a token is no number, for a message.
std::string not_a_decimal(std::string_view token);

}  // namespace detail

/// The exact number that a decimal token is: [+-] digits, with a point somewhere if you like, and [eE][+-] digits.
/// Throws on anything else (nan, inf, hexadecimal) and where the exponent is beyond largest_decimal_exponent.
/// Exact: yes. Cost: a pass over the token; beyond 18 digits GMP's conversion.
Number parse_decimal(const Text_reader& text, std::string_view token);

/// The exact number that a token p or p/q is (integers; a sign before either). Throws on anything else.
/// Exact: yes. Cost: beyond 18 digits GMP's conversion and gcd.
Number parse_rational(const Text_reader& text, std::string_view token);

/// What a coordinate in text may look like.
enum class Number_syntax { decimal, rational };

/// A coordinate of a text file, exact or, as `options` wish, rounded to the nearest double, ties to even. Throws where
/// it is missing, no number, or too large to be rounded to a double.
Number read_coordinate(const Text_reader& text, std::string_view token, Number_syntax syntax,
                       const Read_options& options);

/// Passes over a number that is of no interest (a colour, a normal, which may well be nan). Throws where it is missing
/// or no number.
void skip_number(const Text_reader& text, std::string_view token);

}  // namespace sightline
