#pragma once
// Numbers in text against readers of the plainest kind: each word of the input is taken for a decimal and for p/q.

#include "support.h"

#include <sightline/io/exact_text.h>
#include <sightline/io/decimal.h>
#include <sightline/io/input.h>
#include <sightline/io/text.h>

#include <cmath>

namespace fuzz {

inline bool is_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// A number as the grammar has it.
struct Plain_decimal {
  bool negative = false;
  Integer digits;
  std::size_t places = 0;  // behind the point
  Integer exponent = 0;
};

/// [+-] digits, with a point somewhere, [eE][+-] digits; nothing where it is not that.
inline std::optional<Plain_decimal> plain_decimal(std::string text) {
  const auto sign = [](std::string& of) {
    const bool negative = of.starts_with('-');
    if (negative || of.starts_with('+')) of.erase(0, 1);
    return negative;
  };
  Plain_decimal result;
  if (const std::size_t e = text.find_first_of("eE"); e != std::string::npos) {
    std::string exponent = text.substr(e + 1);
    text.erase(e);
    const bool negative = sign(exponent);
    if (!is_digits(exponent)) return std::nullopt;
    result.exponent = Integer(exponent, 10);
    if (negative) result.exponent = -result.exponent;
  }
  result.negative = sign(text);
  if (const std::size_t point = text.find('.'); point != std::string::npos) {
    result.places = text.size() - point - 1;
    text.erase(point, 1);
  }
  if (!is_digits(text)) return std::nullopt;
  result.digits = Integer(text, 10);
  return result;
}

inline Rational value_of(const Plain_decimal& decimal) {
  const Integer exponent = decimal.exponent - static_cast<unsigned long>(decimal.places);
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, Integer(abs(exponent)).get_ui());
  Rational value = sgn(exponent) < 0 ? Rational(decimal.digits, power) : Rational(decimal.digits * power);
  value.canonicalize();
  return decimal.negative ? Rational(-value) : value;
}

/// p or p/q, integers with a sign each.
inline std::optional<Rational> plain_rational(std::string_view text) {
  const auto integer = [](std::string_view part) -> std::optional<Integer> {
    const bool negative = part.starts_with('-');
    if (negative || part.starts_with('+')) part.remove_prefix(1);
    if (!is_digits(part)) return std::nullopt;
    const Integer n(std::string(part), 10);
    return negative ? Integer(-n) : n;
  };
  const std::size_t slash = text.find('/');
  const std::optional<Integer> p = integer(text.substr(0, slash)),
                               q = slash == std::string_view::npos ? Integer(1) : integer(text.substr(slash + 1));
  if (!p || !q || sgn(*q) == 0) return std::nullopt;
  Rational value(*p, *q);
  value.canonicalize();
  return value;
}

/// Whether a double or float is the nearest, ties to even. By distances to its neighbours alone.
template <class Floating>
bool is_nearest(Floating d, const Rational& value) {
  using Limits = std::numeric_limits<Floating>;
  const Rational largest = exact(Limits::max()),
                 half_step = exact(std::ldexp(1.0, Limits::max_exponent - Limits::digits - 1));
  if (std::isinf(d)) return std::signbit(d) == (sgn(value) < 0) && abs(value) >= largest + half_step;
  const Rational distance = abs(value - exact(d));
  for (const int toward : {-1, 1}) {
    const Floating next = std::nextafter(d, toward * Limits::infinity());
    if (std::isinf(next)) {
      if (distance >= half_step && abs(value) > largest) return false;
      continue;
    }
    const Rational other = abs(value - exact(next));
    using Bits = std::conditional_t<sizeof(Floating) == sizeof(std::uint64_t), std::uint64_t, std::uint32_t>;
    const bool even = (std::bit_cast<Bits>(d) & 1) == 0;
    if (other < distance || (other == distance && !even)) return false;
  }
  return true;
}

/// Calls a parser on a word; nothing where it refuses it.
template <class Parse>
std::optional<Number> number_in(std::string_view word, Parse parse) {
  const Input input{"word", word};
  try {
    return parse(Text_reader(input, Text_reader::Comments::none), word);
  } catch (const Input_error& error) {
    require(error.line == 1 && error.column == 1, "an error is where the number is");
    return std::nullopt;
  }
}

/// What a number that was read owes.
inline void check_number(const Number& number, const Rational& truth) {
  require(sightline::value_of(number) == truth, "the number is what the text says");
  const auto* decimal = std::get_if<Decimal>(&number);
  if (decimal)
    require(decimal->exponent <= 0 && (decimal->exponent == 0 || decimal->mantissa % 10 != 0),
            "a Decimal is canonical");
  require(is_nearest(nearest_double(truth), truth), "the nearest double is the nearest");
  Coordinates coordinates;
  for (int copies = 0; copies < 2; ++copies) push(coordinates, number);
  coordinates.push(Rational(1, 3));
  require(coordinates[0] == truth && coordinates[1] == truth, "coordinates hold the number");
  const Integer common = coordinates.common_denominator();
  const auto check = [&](std::size_t i, const Integer& scaled) {
    require(scaled == (i < 2 ? truth : Rational(1, 3)) * common, "scaled coordinates are integers");
  };
  coordinates.for_each_scaled(
      common, [&](std::size_t i, std::int64_t n) { check(i, Integer(static_cast<long>(n))); }, check);
}

/// What a coordinate that is to be rounded owes.
inline void check_rounding(std::string_view word, Number_syntax syntax, const Rational& truth) {
  Read_options options;
  options.round_to_double = true;
  const std::optional<Number> rounded = number_in(
      word, [&](const Text_reader& of, std::string_view token) { return read_coordinate(of, token, syntax, options); });
  if (rounded) require(is_nearest(std::get<double>(*rounded), truth), "what is rounded is nearest");
  else require(is_nearest(std::numeric_limits<double>::infinity(), abs(truth)), "doubles are read");
}

inline void decimal(std::string_view bytes) {
  const Input input{"words", bytes};
  Text_reader text(input, Text_reader::Comments::none);
  std::optional<std::pair<Number, Rational>> before;
  for (std::string_view word = text.next_token_of_any_line(); !word.empty(); word = text.next_token_of_any_line()) {
    const std::optional<Plain_decimal> plain = plain_decimal(std::string(word));
    const std::optional<Number> number =
        number_in(word, [](const Text_reader& of, std::string_view token) { return parse_decimal(of, token); });
    if (number) {
      require(plain.has_value(), "what is read is a decimal");
      const Rational truth = plain->digits == 0 ? Rational(0) : value_of(*plain);
      check_number(*number, truth);
      check_rounding(word, Number_syntax::decimal, truth);
      if (before) require((before->first == *number) == (before->second == truth), "numbers are == iff they are equal");
      before = {*number, truth};
      const std::optional<std::string> again = decimal_text(truth);
      if (again)
        require(number_in(*again, [](const Text_reader& of,
                                     std::string_view token) { return parse_decimal(of, token); }) == number,
                "decimal_text gives the number back");
      else
        require(abs(plain->exponent) + static_cast<unsigned long>(plain->places) > largest_decimal_exponent,
                "decimals have a text");
    } else if (plain) {
      require(plain->digits != 0 &&
                  abs(plain->exponent) + static_cast<unsigned long>(plain->places) > largest_decimal_exponent,
              "decimals within the range are read");
    }
    const std::optional<Rational> ratio = plain_rational(word);
    const std::optional<Number> as_ratio =
        number_in(word, [](const Text_reader& of, std::string_view token) { return parse_rational(of, token); });
    require(ratio.has_value() == as_ratio.has_value(), "p/q is read, and nothing else");
    if (ratio) {
      check_number(*as_ratio, *ratio);
      check_rounding(word, Number_syntax::rational, *ratio);
    }
  }
}

}  // namespace fuzz
