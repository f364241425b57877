// Exact numbers: doubles, decimals, rationals, and many of them at once.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sightline/kernel/coordinates.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/uniform.h>
#include <sightline/kernel/vectors.h>

#include <mpfr.h>

#include <array>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <stdexcept>
#include <type_traits>

using namespace sightline;

namespace {

/// Any finite double, all exponents alike.
double any_double(std::uint64_t bits) {
  const double d = std::bit_cast<double>(bits);
  return std::isfinite(d) ? d : std::bit_cast<double>(bits & 0xbfffffffffffffffu);
}

/// The nearest double of a rational by comparing its two neighbours exactly.
bool is_nearest(double d, const Rational& value) {
  if (std::isinf(d)) {
    // Half a unit beyond the largest double, that is 2^1024 - 2^970, the even neighbour is infinity.
    Rational limit = exact(std::numeric_limits<double>::max());
    Rational half_unit = exact(0x1p970);
    return abs(value) >= limit + half_unit && (d > 0) == (sgn(value) > 0);
  }
  const Rational error = abs(exact(d) - value);
  for (const double other : {std::nextafter(d, HUGE_VAL), std::nextafter(d, -HUGE_VAL)}) {
    if (std::isinf(other)) {
      if (abs(value) >= exact(std::numeric_limits<double>::max()) + exact(0x1p970)) return false;
      continue;
    }
    const Rational other_error = abs(exact(other) - value);
    if (other_error < error) return false;
    if (other_error == error && (std::bit_cast<std::uint64_t>(d) & 1) != 0) return false;  // a tie goes to even
  }
  return true;
}

TEST(Exact_point, is_made_of_numbers_and_refuses_what_is_none) {
  const Exact_point p{1, 0.5f, Rational(1, 3)}, q{p[0] + p[1], 0x1p-1074, Integer(7)};
  EXPECT_EQ(p[1], Rational(1, 2));
  EXPECT_EQ(q[0], Rational(3, 2));
  EXPECT_EQ(q[1], times_power(Rational(1), -1074));
  const auto [x, y, z] = q;
  EXPECT_EQ(Exact_point(x, y, z), q);
  EXPECT_EQ(Exact_point(), (Exact_point{0, 0, 0}));
  EXPECT_LT(p, q);
  // What is computed of points is one; of a point and an array, an array.
  const Exact_point along{1, 0, 0}, up{0, 0, 1};
  static_assert(std::is_same_v<decltype(sightline::minus(p, q)), Exact_point>);
  static_assert(std::is_same_v<decltype(sightline::minus(p, std::array<Rational, 3>{})), std::array<Rational, 3>>);
  EXPECT_EQ(sightline::minus(p, q), (Exact_point{p[0] - q[0], p[1] - q[1], p[2] - q[2]}));
  EXPECT_EQ(sightline::cross(up, along), (Exact_point{0, 1, 0}));
  EXPECT_EQ(sightline::cross(p, q), sightline::cross(std::array<Rational, 3>(p), std::array<Rational, 3>(q)));
  // Only as exact(): three doubles that are not asked whether they are numbers make none.
  static_assert(!std::is_constructible_v<Exact_point, std::array<double, 3>>);
  for (const double none : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    EXPECT_THROW((Exact_point{none, 0, 0}), std::domain_error);
    EXPECT_THROW((Exact_point{0, static_cast<float>(none), 0}), std::domain_error);
    EXPECT_THROW((Exact_point{0, 0, none}), std::domain_error);
    EXPECT_THROW(exact({0, none, 0}), std::domain_error);
  }
}

TEST(Uniform, is_below_its_end_and_what_this_standard_library_draws) {
  std::mt19937_64 dice(5), other(5);
  const Uniform share(0, 1), wide(-3, 7);
  for (int k = 0; k < 20000; ++k) {
    const double x = k % 2 == 0 ? share(dice) : wide(dice);
    EXPECT_GE(x, k % 2 == 0 ? 0 : -3);
    EXPECT_LT(x, k % 2 == 0 ? 1 : 7);
#ifdef __GLIBCXX__
    std::uniform_real_distribution<double> theirs(k % 2 == 0 ? 0 : -3, k % 2 == 0 ? 1 : 7);
    ASSERT_EQ(x, theirs(other)) << k;
#endif
  }
}

}  // namespace

TEST(Number, bit_length_counts_the_bits_of_the_magnitude) {
  EXPECT_EQ(bit_length(Integer(0)), 0u);
  EXPECT_EQ(bit_length(Integer(1)), 1u);
  EXPECT_EQ(bit_length(Integer(-1)), 1u);
  EXPECT_EQ(bit_length(Integer(255)), 8u);
  EXPECT_EQ(bit_length(Integer(-256)), 9u);
}

TEST(Number, exact_refuses_what_is_no_number) {
  EXPECT_THROW(exact(std::numeric_limits<double>::infinity()), std::domain_error);
  EXPECT_THROW(exact(-std::numeric_limits<double>::infinity()), std::domain_error);
  EXPECT_THROW(exact(std::numeric_limits<double>::quiet_NaN()), std::domain_error);
}

RC_GTEST_PROP(Number, every_finite_double_survives_exact_and_back, (std::uint64_t bits)) {
  const double d = any_double(bits);
  RC_ASSERT(nearest_double(exact(d)) == d);
}

TEST(Number, the_ends_of_the_double_range_survive_exact_and_back) {
  for (const double d : {0.0, 4.9e-324, 2 * 4.9e-324, 0x1p-1022, std::nextafter(0x1p-1022, 0.0), 1e308,
                         std::numeric_limits<double>::max(), 0x1p53, 0x1p53 + 2, 0.1})
    for (const double s : {d, -d}) EXPECT_EQ(nearest_double(exact(s)), s) << s;
}

RC_GTEST_PROP(Number, square_root_of_a_square_is_where_it_was, (std::uint64_t bits)) {
  const double d = std::fabs(any_double(bits)), root = square_root(exact(d) * exact(d));
  RC_ASSERT(std::nextafter(d, 0.0) <= root);
  RC_ASSERT(root <= std::nextafter(d, HUGE_VAL));
}

TEST(Number, square_root_is_right_beyond_the_squares_that_doubles_hold) {
  const Rational two = 2;
  for (const long power : {-1000L, -1L, 0L, 1L, 1020L})
    EXPECT_NEAR(square_root(times_power(two, 2 * power)) / std::ldexp(std::sqrt(2.0), static_cast<int>(power)), 1,
                1e-15)
        << power;
  EXPECT_EQ(square_root(times_power(two, 4000)), HUGE_VAL);
  EXPECT_EQ(square_root(times_power(two, -4000)), 0);
  EXPECT_EQ(square_root(Rational(0)), 0);
}

RC_GTEST_PROP(Number, nearest_double_reads_decimals_as_strtod_does, (std::int64_t mantissa, std::int16_t power)) {
  const long exponent = power % 360;
  char text[64];
  std::snprintf(text, sizeof text, "%llde%ld", static_cast<long long>(mantissa), exponent);
  const double expected = std::strtod(text, nullptr),
               got = nearest_double(exact_decimal(Integer(static_cast<long>(mantissa)), exponent));
  RC_ASSERT(got == expected);
}

RC_GTEST_PROP(Number, nearest_double_rounds_halfway_cases_to_even_and_their_neighbours_to_the_nearer,
              (std::uint64_t bits, std::int8_t nudge)) {
  const double d = std::fabs(any_double(bits)), next = std::nextafter(d, HUGE_VAL);
  RC_PRE(std::isfinite(next));
  const Rational middle = (exact(d) + exact(next)) / 2;
  const double even = (std::bit_cast<std::uint64_t>(d) & 1) == 0 ? d : next;
  RC_ASSERT(nearest_double(middle) == even);
  RC_ASSERT(nearest_double(-middle) == -even);
  Rational tiny = (exact(next) - exact(d));
  mpq_div_2exp(tiny.get_mpq_t(), tiny.get_mpq_t(), 40u + static_cast<unsigned>(nudge & 63));
  RC_ASSERT(nearest_double(middle + tiny) == next);
  RC_ASSERT(nearest_double(middle - tiny) == d);
}

TEST(Number, nearest_double_of_halfway_subnormals_is_even) {
  Rational least = exact(4.9406564584124654e-324);
  EXPECT_EQ(nearest_double(least / 2), 0.0);
  EXPECT_EQ(nearest_double(least / 2 + least / 1000000007), 4.9406564584124654e-324);
  EXPECT_EQ(nearest_double(least / 3), 0.0);
  EXPECT_EQ(nearest_double(least * 3 / 2), 2 * 4.9406564584124654e-324);
  EXPECT_EQ(nearest_double(least * 5 / 2), 2 * 4.9406564584124654e-324);
  EXPECT_EQ(nearest_double(-least * 5 / 2), -2 * 4.9406564584124654e-324);
  EXPECT_EQ(nearest_double(least / 1000000), 0.0);
  // The border of the normal numbers.
  const Rational border = exact(0x1p-1022);
  EXPECT_EQ(nearest_double(border - least / 2), 0x1p-1022);
  EXPECT_EQ(nearest_double(border + least / 2), 0x1p-1022);
  EXPECT_EQ(nearest_double(border - least * 3 / 2), 0x1p-1022 - 2 * 4.9406564584124654e-324);
}

TEST(Number, nearest_double_overflows_to_infinity_from_half_a_unit_beyond_the_largest_double) {
  const double largest = std::numeric_limits<double>::max();
  const Rational half = exact(0x1p970);
  EXPECT_EQ(nearest_double(exact(largest) + half), HUGE_VAL);
  EXPECT_EQ(nearest_double(-exact(largest) - half), -HUGE_VAL);
  EXPECT_EQ(nearest_double(exact(largest) + half - Rational(1, 1000)), largest);
  EXPECT_EQ(nearest_double(exact_decimal(1, 400)), HUGE_VAL);
  EXPECT_EQ(nearest_double(exact_decimal(1, -400)), 0.0);
}

TEST(Number, nearest_double_rounds_alike_in_all_modes_and_leaves_mpfr_as_it_was) {
  EXPECT_NE(mpfr_buildopt_tls_p(), 0);  // or threads would share the range of exponents
  const mpfr_exp_t least = mpfr_get_emin();
  for (const Rational& x : {Rational(1, 3), Rational(-2, 3), Rational(exact(4.9406564584124654e-324) * 5 / 3)}) {
    const double nearest = nearest_double(x);
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      ASSERT_EQ(std::fesetround(mode), 0);
      const double again = nearest_double(x);
      ASSERT_EQ(std::fesetround(FE_TONEAREST), 0);
      EXPECT_EQ(again, nearest) << mode;
    }
  }
  EXPECT_EQ(mpfr_get_emin(), least);
}

RC_GTEST_PROP(Number, nearest_double_of_a_fraction_is_not_beaten_by_a_neighbour,
              (std::int64_t p, std::uint64_t q, std::int16_t power)) {
  Rational value(Integer(static_cast<long>(p)), Integer(static_cast<unsigned long>(q | 1)));
  value.canonicalize();
  const long shift = power % 1100;
  if (shift >= 0) mpq_mul_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<unsigned long>(shift));
  else mpq_div_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<unsigned long>(-shift));
  RC_ASSERT(is_nearest(nearest_double(value), value));
}

TEST(Number, decimals_are_exact) {
  EXPECT_EQ(exact_decimal(1, -1), Rational(1, 10));
  EXPECT_EQ(exact_decimal(-25, -2), Rational(-1, 4));
  EXPECT_EQ(exact_decimal(7, 3), Rational(7000));
  EXPECT_EQ(exact_decimal(0, -5), Rational(0));
}

TEST(Number, rationals_are_written_reduced_and_read_back) {
  EXPECT_EQ(to_string(rational_from_string("6/4")), "3/2");
  EXPECT_EQ(to_string(rational_from_string("6/-4")), "-3/2");
  EXPECT_EQ(to_string(rational_from_string("+6/+3")), "2");
  EXPECT_EQ(to_string(rational_from_string("-0")), "0");
}

TEST(Number, leading_zeros_do_not_make_a_number_octal) {
  EXPECT_EQ(rational_from_string("010"), Rational(10));
  EXPECT_EQ(rational_from_string("-0017/08"), Rational(-17, 8));
  EXPECT_EQ(rational_from_string("+09"), Rational(9));
}

TEST(Number, what_is_not_a_number_is_refused) {
  for (const char* text : {"", "-", "+", "1/", "/2", "1/0", "1/00", "0x10", "1.5", "1e3", " 1", "1 ", "--1", "-+1",
                           "1/2/3", "nan", "inf", "1/ 2"})
    EXPECT_THROW(rational_from_string(text), std::invalid_argument) << text;
}

RC_GTEST_PROP(Number, every_rational_survives_its_text, (std::int64_t p, std::uint64_t q)) {
  Rational value(Integer(static_cast<long>(p)), Integer(static_cast<unsigned long>(q)) + 1);
  value.canonicalize();
  RC_ASSERT(rational_from_string(to_string(value)) == value);
}

// ---- Coordinates

RC_GTEST_PROP(Coordinates, doubles_decimals_and_rationals_come_back_exactly,
              (std::vector<std::pair<std::uint64_t, std::int16_t>> seeds)) {
  Coordinates column;
  std::vector<Rational> expected;
  for (const auto& [bits, power] : seeds) {
    switch (bits % 4) {
      case 0:
        column.push_double(any_double(bits * 0x9e3779b97f4a7c15u));
        expected.push_back(exact(any_double(bits * 0x9e3779b97f4a7c15u)));
        break;
      case 1:
        column.push_decimal(static_cast<std::int64_t>(bits), power % 400);
        expected.push_back(exact_decimal(Integer(static_cast<long>(bits)), power % 400));
        break;
      case 2: {
        Rational value(Integer(static_cast<long>(bits)) * (power % 2 ? 1 : Integer("123456789012345678901234567890")),
                       Integer(static_cast<long>(power) * 2 + 1));
        value.canonicalize();
        column.push(value);
        expected.push_back(value);
        break;
      }
      default:
        column.push_decimal(static_cast<std::int64_t>(bits % 1000) * 100, -(power & 7));
        expected.push_back(exact_decimal(Integer(static_cast<unsigned long>(bits % 1000)) * 100, -(power & 7)));
    }
  }
  RC_ASSERT(column.size() == expected.size());
  const Integer common = column.common_denominator();
  for (std::size_t i = 0; i < expected.size(); ++i) {
    RC_ASSERT(column[i] == expected[i]);
    RC_ASSERT(Rational(expected[i] * common).get_den() == 1);
  }
  // Each number is called once, scaled; small() gets nothing of 62 bits or more.
  std::vector<int> calls(expected.size(), 0);
  const Integer scale = common * 3;
  column.for_each_scaled(
      scale,
      [&](std::size_t i, std::int64_t n) {
        ++calls[i];
        RC_ASSERT(Rational(Integer(static_cast<long>(n))) == expected[i] * scale);
        RC_ASSERT(bit_length(Integer(static_cast<long>(n))) <= 61u);
      },
      [&](std::size_t i, const Integer& n) {
        ++calls[i];
        RC_ASSERT(Rational(n) == expected[i] * scale);
        RC_ASSERT(n == 0 || bit_length(n) >= 62u || bit_length(scale) > 62u);
      });
  for (const int n : calls) RC_ASSERT(n == 1);
}

TEST(Coordinates, the_ends_of_the_double_range_come_back_exactly) {
  const double values[] = {0.0, -0.0,   4.9e-324, -4.9e-324, 0x1p-1022, 1e308,  -std::numeric_limits<double>::max(),
                           0.1, 0x1p53, 0x1p62,   0x1p63,    -0x1p63,   0x1p64, 1.5};
  Coordinates column;
  for (const double d : values) column.push_double(d);
  for (std::size_t i = 0; i < std::size(values); ++i) EXPECT_EQ(column[i], exact(values[i])) << values[i];
}

RC_GTEST_PROP(Coordinates, quotients_are_the_rationals_that_they_are,
              (std::vector<std::pair<std::int64_t, std::int64_t>> numbers)) {
  Coordinates quotients, rationals;
  const auto push = [&](std::int64_t numerator, std::int64_t denominator) {
    quotients.push_ratio(numerator, denominator);
    Rational value(Integer(static_cast<long>(numerator)), Integer(static_cast<long>(denominator)));
    value.canonicalize();
    rationals.push(value);
  };
  for (const auto& [a, b] : numbers) {
    push(a, (b & 0xffff) + 1);
    push(a % 1000, std::int64_t{1} << (b & 61));
    push(a % 100, 1000000);
    push(a, std::int64_t{1} << 62);
  }
  push(std::numeric_limits<std::int64_t>::min(), 6);
  push(0, 7);
  RC_ASSERT(quotients.size() == rationals.size());
  for (std::size_t i = 0; i < quotients.size(); ++i) RC_ASSERT(quotients[i] == rationals[i]);
  RC_ASSERT(quotients.denominators() == rationals.denominators());
}

TEST(Coordinates, no_numbers_have_the_common_denominator_one) { EXPECT_EQ(Coordinates().common_denominator(), 1); }

RC_GTEST_PROP(Coordinates, the_common_denominator_is_the_least_and_denominators_are_counted,
              (std::vector<std::pair<std::int32_t, std::uint8_t>> numbers)) {
  Coordinates column;
  Integer least = 1;
  for (const auto& [mantissa, power] : numbers) {
    if (power % 2) column.push_decimal(mantissa, -(power % 40));
    else column.push_double(std::ldexp(mantissa, -(power % 70)));
    least = lcm(least, column[column.size() - 1].get_den());
  }
  RC_ASSERT(column.common_denominator() == least);
  std::size_t counted = 0;
  for (const auto& [denominator, uses] : column.denominators()) {
    std::size_t expected = 0;
    for (std::size_t i = 0; i < column.size(); ++i) expected += column[i].get_den() == denominator;
    RC_ASSERT(uses == expected);
    counted += uses;
  }
  RC_ASSERT(counted == column.size());
}

TEST(Coordinates, trailing_zeros_of_a_decimal_cost_no_bits) {
  Coordinates column;
  column.push_decimal(1500, -3);
  column.push_decimal(0, -300);
  column.push_decimal(2000, -3);
  EXPECT_EQ(column.common_denominator(), 2);
  EXPECT_EQ(column[0], Rational(3, 2));
  column.push_decimal(75, -2);
  EXPECT_EQ(column.common_denominator(), 4);
  column.push_decimal(8, -1);
  EXPECT_EQ(column.common_denominator(), 20);
}

TEST(Coordinates, small_numbers_end_just_below_two_to_the_61) {
  Coordinates column;
  const std::int64_t limit = std::int64_t{1} << 61;
  column.push(Rational(Integer(static_cast<long>(limit - 1))));
  column.push(Rational(Integer(static_cast<long>(limit))));
  column.push(Rational(Integer(static_cast<long>(-limit))));
  column.push(Rational(Integer(static_cast<long>(1 - limit))));
  column.push(Rational(Integer(std::numeric_limits<long>::min())));
  std::string kinds(5, '?');
  column.for_each_scaled(
      1, [&](std::size_t i, std::int64_t) { kinds[i] = 's'; }, [&](std::size_t i, const Integer&) { kinds[i] = 'l'; });
  EXPECT_EQ(kinds, "sllsl");
}
