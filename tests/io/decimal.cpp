// Numbers in text: what parse_decimal, parse_rational and the rounding to doubles make of them.

#include "soup_text.h"

#include <sightline/io/decimal.h>
#include <sightline/io/exact_text.h>
#include <sightline/io/text.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace sightline::test {
namespace {

Number decimal(std::string_view token) {
  const Input input{"scene", token};
  const Text_reader text(input, Text_reader::Comments::none);
  return parse_decimal(text, token);
}
Number rational(std::string_view token) {
  const Input input{"scene", token};
  const Text_reader text(input, Text_reader::Comments::none);
  return parse_rational(text, token);
}
std::string message_of(Number (*parse)(std::string_view), std::string_view token) {
  try {
    return "read as " + to_string(value_of(parse(token)));
  } catch (const Input_error& error) {
    return error.what();
  }
}

TEST(Decimal, is_the_exact_number_it_says) {
  const std::vector<std::pair<const char*, const char*>> cases{{"0", "0"},
                                                               {"-0", "0"},
                                                               {"0.000", "0"},
                                                               {"-0.0e7", "0"},
                                                               {"7", "7"},
                                                               {"+7", "7"},
                                                               {"-7", "-7"},
                                                               {"007", "7"},
                                                               {"0.1", "1/10"},
                                                               {".5", "1/2"},
                                                               {"5.", "5"},
                                                               {"-.25", "-1/4"},
                                                               {"1.500", "3/2"},
                                                               {"100", "100"},
                                                               {"1e2", "100"},
                                                               {"1E+2", "100"},
                                                               {"1e-2", "1/100"},
                                                               {"1.25e1", "25/2"},
                                                               {"100e-2", "1"},
                                                               {"100.e-1", "10"},
                                                               {"1.20e1", "12"},
                                                               {"12.5e-0", "25/2"},
                                                               {"0.00e999999", "0"},
                                                               {"-1.55991e-008", "-155991/10000000000000"},
                                                               {"123456789012345678", "123456789012345678"}};
  for (const auto& [token, value] : cases) EXPECT_EQ(to_string(value_of(decimal(token))), value) << token;
}

TEST(Decimal, of_more_than_18_digits_is_exact_too) {
  EXPECT_EQ(to_string(value_of(decimal("1234567890123456789012345678901234567890"))),
            "1234567890123456789012345678901234567890");
  EXPECT_EQ(to_string(value_of(decimal("9223372036854775807"))), "9223372036854775807");
  EXPECT_EQ(to_string(value_of(decimal("-9223372036854775809"))), "-9223372036854775809");
  EXPECT_EQ(to_string(value_of(decimal("0.12345678901234567890123"))),
            "12345678901234567890123/100000000000000000000000");
  EXPECT_EQ(to_string(value_of(decimal("1" + std::string(2000, '0')))), "1" + std::string(2000, '0'));
  EXPECT_EQ(to_string(value_of(decimal("1." + std::string(5000, '0')))), "1");
  EXPECT_EQ(to_string(value_of(decimal("0." + std::string(5000, '0') + "25e5000"))), "1/4");
}

TEST(Decimal, is_canonical_so_that_equal_numbers_are_equal) {
  for (const char* token :
       {"1.5", "1.50", "15e-1", "0.15e1", "+01.5000000000000000000000000", "150000000000000000000e-20"})
    EXPECT_EQ(decimal(token), Number(Decimal{15, -1})) << token;
  for (const char* token : {"1000", "1e3", "1000.0", "0.1e4", "1000000e-3", "1000.00000000000000000000000"})
    EXPECT_EQ(decimal(token), Number(Decimal{1000, 0})) << token;
  for (const char* token : {"0", "-0", "0.0", "0e-5000", "-.0e5"})
    EXPECT_EQ(decimal(token), Number(Decimal{0, 0})) << token;
  EXPECT_EQ(decimal("1e30"), decimal("1000000000000000000000000000000"));
  EXPECT_EQ(decimal("1e18"), Number(Decimal{1000000000000000000, 0}));
  EXPECT_EQ(decimal("1000000000000000000"), Number(Decimal{1000000000000000000, 0}));  // 19 digits
}

TEST(Decimal, exponents_up_to_1100_are_read_and_no_further) {
  EXPECT_EQ(value_of(decimal("1e1100")), exact_decimal(1, 1100));
  EXPECT_EQ(value_of(decimal("-1e-1100")), exact_decimal(-1, -1100));
  EXPECT_EQ(value_of(decimal("1.0e-1100")), exact_decimal(1, -1100));
  EXPECT_EQ(value_of(decimal("0.1e1101")), exact_decimal(1, 1100));
  EXPECT_EQ(value_of(decimal("10e-1101")), exact_decimal(1, -1100));
  EXPECT_EQ(value_of(decimal("1.0e1101")), exact_decimal(1, 1101));
  for (const char* token : {"1e1101", "1e-1101", "1.1e1102", "1e99999999999999999999999", "-1e-99999999999999999999999",
                            "1e4294967296", "1e18446744073709551616"})
    EXPECT_NE(message_of(decimal, token).find(": exponent out of range in"), std::string::npos)
        << message_of(decimal, token);
}

TEST(Decimal, of_more_than_1100_places_or_2200_digits_before_its_point_is_refused_as_that) {
  const std::string most(2200, '1');
  EXPECT_EQ(value_of(decimal(most)), Rational(most));
  EXPECT_EQ(value_of(decimal("-000" + most + ".000")), -Rational(most));
  EXPECT_EQ(value_of(decimal(most.substr(0, 1100) + "e1100")), Rational(most.substr(0, 1100)) * exact_decimal(1, 1100));
  const std::string ones(10'000, '1');
  for (const std::string& token : {"1" + most, ones, most.substr(0, 1101) + "e1100", "0" + most + "1.5"})
    EXPECT_NE(message_of(decimal, token).find("has more than 2200 digits before its point; scale the scene"),
              std::string::npos)
        << message_of(decimal, token);
  EXPECT_EQ(value_of(decimal("1." + std::string(1100, '1'))),
            Rational("1" + std::string(1100, '1')) * exact_decimal(1, -1100));
  EXPECT_EQ(value_of(decimal("1." + std::string(10'000, '0'))), 1);
  for (const std::string& token : {"0." + ones, "0." + std::string(1100, '0') + "1", std::string("0.1e-1100")})
    EXPECT_NE(message_of(decimal, token)
                  .find("has more than 1100 places; round it, or read the scene with coordinates "
                        "rounded to double (--coordinates double)"),
              std::string::npos)
        << message_of(decimal, token);
}

TEST(Decimal, refuses_what_is_no_decimal) {
  for (const char* token : {"",    "-",  "+",  ".", "-.", "e5",   ".e5",   "1e",    "1e+", "1e-",     "1.2.3",
                            "--1", "1-", "1 ", "x", "1x", "1e5x", "1e5.0", "1_000", "1d5", "\xC3\xA9"})
    EXPECT_NE(message_of(decimal, token).find("is not a number; write a decimal"), std::string::npos)
        << message_of(decimal, token);
  for (const char* token :
       {"nan", "NaN", "-nan", "-nan(ind)", "inf", "-Inf", "INFINITY", "1.#INF", "-1.#IND", "1.#QNAN"})
    EXPECT_NE(message_of(decimal, token).find("is not a finite number"), std::string::npos)
        << message_of(decimal, token);
  for (const char* token : {"0x10", "-0X1p3"})
    EXPECT_NE(message_of(decimal, token).find("hexadecimal"), std::string::npos) << message_of(decimal, token);
  EXPECT_NE(message_of(decimal, "1,5").find("decimal point, not a comma"), std::string::npos);
  EXPECT_NE(message_of(decimal, "1/2").find(".qoff"), std::string::npos);
}

TEST(Rational_token, is_reduced_and_canonical) {
  EXPECT_EQ(rational("-7"), Number(Decimal{-7, 0}));
  EXPECT_EQ(rational("14/2"), Number(Decimal{7, 0}));
  EXPECT_EQ(rational("0/5"), Number(Decimal{0, 0}));
  EXPECT_EQ(rational("-0/5"), Number(Decimal{0, 0}));
  EXPECT_EQ(rational("6/4"), Number(Rational(3, 2)));
  EXPECT_EQ(rational("+6/-4"), Number(Rational(-3, 2)));
  EXPECT_EQ(rational("-6/-4"), Number(Rational(3, 2)));
  EXPECT_EQ(to_string(value_of(rational("-123456789012345678901234567890/30"))), "-4115226300411522630041152263");
  EXPECT_EQ(to_string(value_of(rational("1/123456789012345678901234567890"))), "1/123456789012345678901234567890");
  EXPECT_EQ(rational("10000000000000000000000/10000000000000000000000"), Number(Decimal{1, 0}));
}

TEST(Rational_token, refuses_what_is_no_rational) {
  for (const char* token : {"", "/", "1/", "/2", "1/2/3", "1.5", "1e3", "1/2.5", "x", "1/x", "nan", "--1", "1/--2",
                            "1/2 ", "12345678901234567890x"})
    EXPECT_NE(message_of(rational, token).find("is not a number p or p/q"), std::string::npos)
        << message_of(rational, token);
  for (const char* token : {"1/0", "0/0", "-1/-0", "1/+000", "123456789012345678901234567890/0"})
    EXPECT_NE(message_of(rational, token).find("has the denominator 0"), std::string::npos)
        << message_of(rational, token);
}

double rounded(std::string_view token, Number_syntax syntax = Number_syntax::decimal) {
  const Input input{"scene", token};
  const Text_reader text(input, Text_reader::Comments::none);
  Read_options to_double;
  to_double.round_to_double = true;
  return std::get<double>(read_coordinate(text, token, syntax, to_double));
}

// The C library reads decimals with correct rounding: an independent oracle.
void expect_rounded_as_strtod(const std::string& token) {
  const double expected = std::strtod(token.c_str(), nullptr);
  EXPECT_EQ(rounded(token), expected) << token;
  EXPECT_EQ(nearest_double(value_of(decimal(token))), expected) << token;
}

TEST(Rounding_to_double, ties_go_to_even) {
  for (const auto& [token, expected] : std::vector<std::pair<std::string, double>>{
           {"9007199254740993", 9007199254740992.0},        // 2^53 + 1: a tie, down to even
           {"9007199254740995", 9007199254740996.0},        // 2^53 + 3: a tie, up to even
           {"-9007199254740993", -9007199254740992.0},      //
           {"9007199254740993.1", 9007199254740994.0},      // just above a tie
           {"+9007199254740992.9", 9007199254740992.0},     // just below
           {"9223372036854775807", 9223372036854775808.0},  // carries into the next power of two
           {".1", 0.1},
           {"1e-19", 1e-19},
           {"+1.", 1.0},
           {"1e-400", 0.0}}) {
    EXPECT_EQ(rounded(token), expected) << token;
    EXPECT_EQ(nearest_double(value_of(decimal(token))), expected) << token;
  }
  EXPECT_EQ(rounded("+9007199254740993/3", Number_syntax::rational), 3002399751580331.0);
  for (const char* token : {"0", "-0", "-0.0e5", "-1e-400"}) EXPECT_FALSE(std::signbit(rounded(token))) << token;
}

TEST(Rounding_to_double, agrees_with_the_c_library) {
  std::mt19937_64 random(20240229);
  for (int i = 0; i < 20000; ++i) {
    const auto mantissa = static_cast<std::int64_t>(random() >> (random() % 63 + 1));
    const int exponent = -static_cast<int>(random() % 26);
    const std::string token = (random() % 2 ? "-" : "") + std::to_string(mantissa) + "e" + std::to_string(exponent);
    expect_rounded_as_strtod(token);
  }
  for (int i = 0; i < 20000; ++i)  // many digits
    expect_rounded_as_strtod(std::to_string(random() >> 1) + "e-" + std::to_string(17 + random() % 3));
  for (int i = 0; i < 2000; ++i) {  // halfway between two doubles, and a little off
    const double low =
        std::ldexp(static_cast<double>((random() >> 11) | (std::uint64_t{1} << 52)), -static_cast<int>(random() % 53));
    const Rational middle = (exact(low) + exact(std::nextafter(low, HUGE_VAL))) / 2;
    const std::string token = *decimal_text(middle);
    expect_rounded_as_strtod(token);
    if (token.find('.') != std::string::npos) expect_rounded_as_strtod(token + "0000000000000000000001");
  }
  for (const char* token : {"4.9406564584124654e-324", "2.4703282292062327e-324", "2.4703282292062328e-324",
                            "2.2250738585072011e-308", "1.7976931348623157e308", "1e-400"})
    expect_rounded_as_strtod(token);
}

TEST(Rounding_to_double, is_what_the_reader_does_where_asked) {
  const Read_options to_double{true};
  EXPECT_EQ(read_text("v 0.1 0.5 3\n", Format::obj), "1/10 1/2 3 |");
  EXPECT_EQ(read_text("v 0.1 0.5 3\n", Format::obj, to_double), "3602879701896397/36028797018963968 1/2 3 |");
  EXPECT_EQ(read_text("OFF\n1 0 0\n1/3 1/2 -0/1\n", Format::qoff, to_double),
            "6004799503160661/18014398509481984 1/2 0 |");
  expect_error_at(2, 5, "\"1e309\" is beyond the range of a double", "#\nv 0 1e309 0\n", Format::obj, to_double);
  EXPECT_EQ(read_text("v 1e-400 0 0\n", Format::obj, to_double), "0 0 0 |");
  // Decimals and denominators that are too long to be exact.
  EXPECT_EQ(read_text("v 0.5" + std::string(10'000, '0') + "1 1e-1200 -.25\n", Format::obj, to_double), "1/2 0 -1/4 |");
  EXPECT_EQ(
      read_text("v -0." + std::string(2000, '0') + "7 0.01e-99999999999999999999 0e-2000\n", Format::obj, to_double),
      "0 0 0 |");
  expect_error_at(1, 3, "beyond", "v " + std::string(400, '9') + " 0 0\n", Format::obj, to_double);
  EXPECT_EQ(read_text("OFF\n1 0 0\n1" + std::string(3000, '0') + "/2" + std::string(3000, '0') + " 1/1" +
                          std::string(3000, '0') + " 0\n",
                      Format::qoff, to_double),
            "1/2 0 0 |");
  for (const char* token : {"+-1", "0x1", "nan", "inf", "1e", ""})
    EXPECT_THROW(read_text("v " + std::string(token) + " 0 0\n", Format::obj, to_double), Input_error) << token;
}

TEST(Ignored_number, may_be_anything_that_stands_for_a_number) {
  const auto accepts = [](std::string_view token) {
    const Input input{"scene", token};
    const Text_reader text(input, Text_reader::Comments::none);
    try {
      skip_number(text, token);
      return true;
    } catch (const Input_error&) {
      return false;
    }
  };
  for (const char* token : {"1", "-1.5", "1e-3000", "+.5E9", "nan", "-NaN", "-nan(ind)", "inf", "-1.#IND"})
    EXPECT_TRUE(accepts(token)) << token;
  for (const char* token : {"", "-", "e", "x", "1x", "none", "0x1"}) EXPECT_FALSE(accepts(token)) << token;
}

}  // namespace
}  // namespace sightline::test
