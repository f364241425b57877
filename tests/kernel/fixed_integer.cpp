// Integers of fixed width against GMP.

#include "grid.h"

#include <rapidcheck/gtest.h>

#include <sightline/kernel/fixed_integer.h>

#include <random>

using namespace sightline;
using kernel_test::power_of_two;

namespace {

/// The number in [-2^(bits-1), 2^(bits-1)) that is congruent to n modulo 2^bits.
Integer wrapped(const Integer& n, int bits) {
  Integer r;
  mpz_fdiv_r_2exp(r.get_mpz_t(), n.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
  return r >= power_of_two(bits - 1) ? Integer(r - power_of_two(bits)) : r;
}

template <int L>
Fixed_integer<L> fixed(const Integer& n) {
  Limb limbs[L];
  to_limbs(n, limbs, L);
  return Fixed_integer<L>(limbs, L);
}

/// The value, found by signs and subtractions of known powers alone: nothing of from_limbs() is believed here.
template <int L>
Integer number_in(Fixed_integer<L> n) {
  Integer result = 0;
  if (n.sign() < 0) {
    result = -power_of_two(64 * L - 1);
    n = n + fixed<L>(-power_of_two(64 * L - 1));  // modulo 2^(64 L) this adds 2^(64 L - 1)
  }
  for (int k = 64 * L - 2; k >= 0; --k) {
    const Fixed_integer<L> less = n - fixed<L>(power_of_two(k));
    if (less.sign() >= 0) {
      n = less;
      result += power_of_two(k);
    }
  }
  return result;
}

/// Integers of L limbs that like to be near powers of two.
template <int L>
Integer sample(std::mt19937_64& random) {
  Integer n = 0;
  for (int i = 0; i < L; ++i) {
    static constexpr Limb liked[] = {0, 1, ~Limb{0}, Limb{1} << 63, (Limb{1} << 63) - 1, Limb{1} << 32, 0xffffffff};
    const Limb limb = random() % 2 ? liked[random() % std::size(liked)] : random();
    n = (n << 64) + Integer(static_cast<unsigned long>(limb));
  }
  return wrapped(n, 64 * L);
}

template <int L>
void check_against_gmp() {
  std::mt19937_64 random(20240101 + L);
  for (int round = 0; round < 300; ++round) {
    const Integer a = sample<L>(random), b = sample<L>(random);
    const Fixed_integer<L> fa = fixed<L>(a), fb = fixed<L>(b);
    ASSERT_EQ(number_in(fa), a);
    ASSERT_EQ(fa.sign(), sgn(a));
    ASSERT_EQ(number_in(fa + fb), wrapped(a + b, 64 * L)) << a << " + " << b;
    ASSERT_EQ(number_in(fa - fb), wrapped(a - b, 64 * L)) << a << " - " << b;
    ASSERT_EQ(number_in(fa * fb), wrapped(a * b, 64 * L)) << a << " * " << b;
    ASSERT_EQ((fa - fb).sign(), sgn(wrapped(a - b, 64 * L)));
    ASSERT_EQ((fa - fa).sign(), 0);
  }
}

template <int L>
void check_sum_of_products_that_wraps_on_the_way() {
  // Intermediate values overflow, the end fits: a (b + c) - a b - a c + d == d.
  std::mt19937_64 random(7 + L);
  for (int round = 0; round < 200; ++round) {
    const Integer a = sample<L>(random), b = sample<L>(random), c = sample<L>(random), d = sample<L>(random);
    const auto fa = fixed<L>(a), fb = fixed<L>(b), fc = fixed<L>(c), fd = fixed<L>(d);
    ASSERT_EQ(number_in(fa * (fb + fc) - fa * fb - fa * fc + fd), d);
  }
}

template <int L>
void check_limb_conversions() {
  std::mt19937_64 random(99 + L);
  std::vector<Integer> numbers{0, 1, -1, 2, -2};
  for (int k = 1; k < 64 * L; ++k)
    for (const int off : {-1, 0, 1}) {
      numbers.push_back(power_of_two(k) + off);
      numbers.push_back(-power_of_two(k) + off);
    }
  for (int i = 0; i < 100; ++i) numbers.push_back(sample<L>(random));
  for (const Integer& n : numbers) {
    Limb limbs[L];
    std::fill(limbs, limbs + L, Limb{0xdeadbeef});
    if (wrapped(n, 64 * L) != n) {
      EXPECT_THROW(to_limbs(n, limbs, L), std::overflow_error) << n;
      continue;
    }
    to_limbs(n, limbs, L);
    ASSERT_EQ(from_limbs(limbs, L), n);
    for (int i = 0; i < L; ++i) {  // limb i is floor(n / 2^(64 i)) modulo 2^64
      Integer shifted;
      mpz_fdiv_q_2exp(shifted.get_mpz_t(), n.get_mpz_t(), static_cast<mp_bitcnt_t>(64 * i));
      mpz_fdiv_r_2exp(shifted.get_mpz_t(), shifted.get_mpz_t(), 64);
      ASSERT_EQ(Integer(static_cast<unsigned long>(limbs[i])), shifted) << n << " limb " << i;
    }
    // Sign extension to more limbs, and the low limbs of a number that fits them.
    ASSERT_EQ(number_in(Fixed_integer<L + 1>(limbs, L)), n);
    if (L > 1 && wrapped(n, 64) == n) {
      ASSERT_EQ(number_in(Fixed_integer<1>(limbs, L)), n);
    }
  }
}

template <int L>
void check_approximation() {
  std::mt19937_64 random(5 + L);
  for (int round = 0; round < 300; ++round) {
    Integer n = sample<L>(random);
    n >>= static_cast<mp_bitcnt_t>(random() % (64 * L));
    Limb limbs[L];
    to_limbs(n, limbs, L);
    for (const long shift : {0L, 1L, 60L, 64L * L, 900L}) {
      const double d = approximate(limbs, L, shift);
      Rational truth(n);
      mpq_div_2exp(truth.get_mpq_t(), truth.get_mpq_t(), static_cast<mp_bitcnt_t>(shift));
      Rational allowed = abs(truth);
      mpq_div_2exp(allowed.get_mpq_t(), allowed.get_mpq_t(), 52);
      const Rational error = abs(exact(d) - truth);
      if (bit_length(n) <= 53) {
        ASSERT_EQ(error, 0) << n << " shift " << shift;
      } else {
        ASSERT_LT(error, allowed) << n << " shift " << shift;
      }
    }
    // Underflow: off by at most the least subnormal number.
    const double d = approximate(limbs, L, 1074 + 20);
    Rational truth(n);
    mpq_div_2exp(truth.get_mpq_t(), truth.get_mpq_t(), 1074 + 20);
    Rational allowed = abs(truth);
    mpq_div_2exp(allowed.get_mpq_t(), allowed.get_mpq_t(), 52);
    ASSERT_LE(abs(exact(d) - truth), allowed + exact(4.9406564584124654e-324));
  }
}

}  // namespace

TEST(Fixed_integer, arithmetic_of_64_bits_is_that_of_gmp_modulo_its_width) { check_against_gmp<1>(); }
TEST(Fixed_integer, arithmetic_of_128_bits_is_that_of_gmp_modulo_its_width) { check_against_gmp<2>(); }
TEST(Fixed_integer, arithmetic_of_256_bits_is_that_of_gmp_modulo_its_width) { check_against_gmp<4>(); }
TEST(Fixed_integer, arithmetic_of_512_bits_is_that_of_gmp_modulo_its_width) { check_against_gmp<8>(); }

TEST(Fixed_integer, a_sum_of_products_that_fits_is_exact_whatever_wraps_on_the_way) {
  check_sum_of_products_that_wraps_on_the_way<1>();
  check_sum_of_products_that_wraps_on_the_way<2>();
  check_sum_of_products_that_wraps_on_the_way<4>();
  check_sum_of_products_that_wraps_on_the_way<8>();
}

TEST(Fixed_integer, limbs_hold_every_number_of_their_width_and_no_other) {
  check_limb_conversions<1>();
  check_limb_conversions<2>();
  check_limb_conversions<4>();
  check_limb_conversions<8>();
}

TEST(Fixed_integer, a_machine_integer_is_sign_extended) {
  for (const std::int64_t n : {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1},
                               std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    EXPECT_EQ(number_in(Fixed_integer<1>(n)), Integer(static_cast<long>(n)));
    EXPECT_EQ(number_in(Fixed_integer<4>(n)), Integer(static_cast<long>(n)));
  }
}

TEST(Fixed_integer, the_sign_sees_every_limb) {
  for (int k = 0; k < 511; ++k) {
    EXPECT_EQ(fixed<8>(power_of_two(k)).sign(), 1) << k;
    EXPECT_EQ(fixed<8>(-power_of_two(k)).sign(), -1) << k;
  }
  EXPECT_EQ(fixed<8>(0).sign(), 0);
}

TEST(Approximate, a_number_in_limbs_is_approximated_within_its_bound) {
  check_approximation<1>();
  check_approximation<2>();
  check_approximation<3>();
  check_approximation<5>();
  check_approximation<9>();
}
