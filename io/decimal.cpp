#include <sightline/io/decimal.h>

#include <sightline/kernel/quoted.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <system_error>

namespace sightline {

void push(Coordinates& coordinates, const Number& number) {
  if (const auto* decimal = std::get_if<Decimal>(&number))
    coordinates.push_decimal(decimal->mantissa, decimal->exponent);
  else if (const auto* floating = std::get_if<double>(&number)) coordinates.push_double(*floating);
  else coordinates.push(std::get<Rational>(number));
}

Rational value_of(const Number& number) {
  if (const auto* decimal = std::get_if<Decimal>(&number))
    return exact_decimal(Integer(static_cast<long>(decimal->mantissa)), decimal->exponent);
  if (const auto* floating = std::get_if<double>(&number)) return exact(*floating);
  return std::get<Rational>(number);
}

namespace detail {

Number wide_decimal(bool negative, const std::string& digits, int exponent) {
  Integer mantissa(digits, 10);
  if (negative) mantissa = -mantissa;
  if (exponent < 0) {
    if (fits_int64(mantissa)) return Decimal{mantissa.get_si(), exponent};
    return exact_decimal(mantissa, exponent);
  }
  const Rational value = exact_decimal(mantissa, exponent);
  if (fits_int64(value.get_num())) return Decimal{value.get_num().get_si(), 0};
  return value;
}

std::string not_a_decimal(std::string_view token) {
  std::string lower(token.substr(0, 8));
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  if (const std::size_t sign = lower.find_first_not_of("+-"); sign != std::string::npos) lower.erase(0, sign);
  if (lower.starts_with("nan") || lower.starts_with("inf") || lower.starts_with("1.#"))
    return quoted(token) + " is not a finite number; give the point finite coordinates or remove it";
  if (lower.starts_with("0x")) return quoted(token) + " is a hexadecimal number; write it as a decimal such as 1.25";
  if (token.find(',') != std::string_view::npos)
    return quoted(token) + " is not a number; write a decimal point, not a comma";
  if (token.find('/') != std::string_view::npos)
    return quoted(token) + " is not a decimal; coordinates p/q belong into a .qoff file";
  return quoted(token) + " is not a number; write a decimal such as 1.25 or -3e-4";
}

}  // namespace detail

Number parse_decimal(const Text_reader& text, std::string_view token) {
  const char* p = token.data();
  const char* const end = p + token.size();
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;

  // The digits: up to 18 in `mantissa`, which they fit.
  const char* const digits_begin = p;
  std::uint64_t mantissa = 0;
  int significant = 0;
  std::int64_t digits = 0, after_point = 0;
  bool point = false;
  for (; p != end; ++p) {
    if (*p == '.' && !point) {
      point = true;
      continue;
    }
    if (!is_digit(*p)) break;
    ++digits;
    if (point) ++after_point;
    if (significant != 0 || *p != '0') ++significant;
    if (significant <= 18) mantissa = 10 * mantissa + static_cast<std::uint64_t>(*p - '0');
    else significant = 19;
  }
  const char* const digits_end = p;
  if (digits == 0) text.fail(token, detail::not_a_decimal(token));

  // The exponent, held at 10^17 where it is larger: no file is long enough for its digits to bring that back.
  std::int64_t exponent = 0;
  if (p != end && (*p == 'e' || *p == 'E')) {
    const bool negative_exponent = ++p != end && *p == '-';
    if (p != end && (*p == '-' || *p == '+')) ++p;
    if (p == end) text.fail(token, detail::not_a_decimal(token));
    for (; p != end && is_digit(*p); ++p)
      if (exponent < 100'000'000'000'000'000) exponent = 10 * exponent + (*p - '0');
    if (negative_exponent) exponent = -exponent;
  }
  if (p != end) text.fail(token, detail::not_a_decimal(token));
  if (significant == 0) return Decimal{0, 0};

  // Zeros at the end of the digits after the point say nothing; and none of the digits' does where the exponent takes
  // it back.
  const char* last = digits_end;
  std::int64_t zeros = 0;
  exponent -= after_point;
  while (last != digits_begin && (last[-1] == '0' || last[-1] == '.') && exponent < 0) {
    if (*--last == '.') continue;
    ++zeros;
    ++exponent;
  }
  const auto is_within = [](std::int64_t e) { return -largest_decimal_exponent <= e && e <= largest_decimal_exponent; };
  if (!is_within(exponent)) {
    if (is_within(exponent + after_point - zeros))  // as it is written: the digits take it beyond
      text.fail(token, quoted(token) + " has more than " + std::to_string(largest_decimal_exponent) +
                           " places; round it, or read the scene with coordinates rounded to double "
                           "(--coordinates double)");
    text.fail(token, "exponent out of range in " + quoted(token) +
                         "; scale the scene so that exponents stay within +-" +
                         std::to_string(largest_decimal_exponent));
  }

  const int scale = static_cast<int>(exponent);
  if (significant <= 18 && scale <= 0) {
    const auto narrow = static_cast<std::int64_t>(mantissa / detail::powers_of_ten[static_cast<std::size_t>(zeros)]);
    return Decimal{negative ? -narrow : narrow, scale};
  }
  std::string significant_digits;
  std::copy_if(digits_begin, last, std::back_inserter(significant_digits), is_digit);
  significant_digits.erase(0, significant_digits.find_first_not_of('0'));
  if (static_cast<std::int64_t>(significant_digits.size()) + exponent >
      static_cast<std::int64_t>(most_digits_before_point))
    text.fail(token, quoted(token) + " has more than " + std::to_string(most_digits_before_point) +
                         " digits before its point; scale the scene so that it has less");
  return detail::wide_decimal(negative, significant_digits, scale);
}

Number parse_rational(const Text_reader& text, std::string_view token) {
  const std::size_t slash = token.find('/');
  if (token.size() <= 18) {
    const std::optional<std::int64_t> p = parse_integer(token.substr(0, slash));
    if (slash == std::string_view::npos && p) return Decimal{*p, 0};
    const std::optional<std::int64_t> q =
        slash == std::string_view::npos ? std::nullopt : parse_integer(token.substr(slash + 1));
    if (p && q && *q != 0) {
      const std::int64_t divisor = std::gcd(*p, *q) * (*q < 0 ? -1 : 1);
      if (*q == divisor) return Decimal{*p / divisor, 0};
      Rational value;
      value.get_num() = static_cast<long>(*p / divisor);
      value.get_den() = static_cast<long>(*q / divisor);
      return value;
    }
  }
  try {
    Rational value = rational_from_string(token);
    if (value.get_den() == 1 && fits_int64(value.get_num())) return Decimal{value.get_num().get_si(), 0};
    return value;
  } catch (const std::invalid_argument&) {
    const bool zero = slash != std::string_view::npos &&
                      token.find_first_not_of("+-0", slash + 1) == std::string_view::npos && token.back() == '0';
    text.fail(
        token,
        zero ? quoted(token) + " has the denominator 0; write p/q with q not 0"
             : quoted(token) +
                   " is not a number p or p/q; write integers such as -7 or 22/7 (decimals belong into a .off file)");
  }
}

/// Whether a decimal that no double is near is so for being small: by the place of its first digit that is not 0.
static bool is_tiny(std::string_view token) {
  const std::size_t e = std::min(token.find_first_of("eE"), token.size()), point = std::min(token.find('.'), e),
                    first = token.find_first_of("123456789");
  const auto place = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  const std::string_view written = token.substr(std::min(e + 1, token.size()));
  const std::int64_t exponent = parse_integer(written).value_or(0);  // which it holds at 10^18
  return place + exponent < 0;
}

/// The double nearest to a decimal, ties to even, however many digits it has; nothing for what is no decimal, and
/// beyond the largest double.
static std::optional<double> rounded_decimal(std::string_view token) {
  // What from_chars takes and a decimal may not be: +-1, inf, nan.
  const bool plus = token.front() == '+';
  if (plus) token.remove_prefix(1);
  if (token.find_first_not_of("0123456789.eE+-") != std::string_view::npos || (plus && token.starts_with('-')))
    return std::nullopt;
  double rounded = 0;
  const auto [last, error] = std::from_chars(token.data(), token.data() + token.size(), rounded);
  if (last != token.data() + token.size() || !std::isfinite(rounded)) return std::nullopt;
  if (error == std::errc::result_out_of_range && is_tiny(token)) return 0;
  return error == std::errc() ? std::optional(rounded) : std::nullopt;
}

Number read_coordinate(const Text_reader& text, std::string_view token, Number_syntax syntax,
                       const Read_options& options) {
  if (token.empty()) text.fail(token, "a coordinate is missing; a point has three");
  const bool is_decimal = syntax == Number_syntax::decimal;
  std::optional<double> nearest;
  if (options.round_to_double && is_decimal) nearest = rounded_decimal(token);
  if (!nearest) {
    Number number = is_decimal ? parse_decimal(text, token) : parse_rational(text, token);
    if (!options.round_to_double) return number;
    nearest = nearest_double(value_of(number));
  }
  const double rounded = *nearest;
  if (!std::isfinite(rounded))
    text.fail(token, quoted(token) + " is beyond the range of a double; scale the scene, or read exact coordinates");
  return rounded == 0 ? 0.0 : rounded;  // -0 is 0
}

void skip_number(const Text_reader& text, std::string_view token) {
  if (token.empty()) text.fail(token, "a number is missing; complete the line");
  if (token.find_first_of("0123456789") != std::string_view::npos &&
      token.find_first_not_of("0123456789+-.eE") == std::string_view::npos)
    return;
  std::string_view name = token;
  if (name.front() == '-' || name.front() == '+') name.remove_prefix(1);
  for (const std::string_view known : {"nan", "NaN", "NAN", "inf", "Inf", "INF", "1.#"})
    if (name.starts_with(known)) return;
  text.fail(token, quoted(token) + " is not a number; write a decimal such as 1.25");
}

}  // namespace sightline
