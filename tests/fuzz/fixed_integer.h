#pragma once
// Integers of a fixed width against GMP's.

#include "support.h"

#include <sightline/kernel/fixed_integer.h>

namespace fuzz {

/// n modulo 2^bits, in [-2^(bits - 1), 2^(bits - 1)).
inline Integer wrapped(Integer n, int bits) {
  Integer half;
  mpz_setbit(half.get_mpz_t(), static_cast<mp_bitcnt_t>(bits - 1));
  n += half;
  mpz_fdiv_r_2exp(n.get_mpz_t(), n.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
  return n - half;
}

/// What the limbs hold, by their digits.
inline Integer value_of_limbs(const Limb* limbs, int count) {
  Integer n = 0;
  for (int i = count - 1; i >= 0; --i) n = (n << 64) + Integer(static_cast<unsigned long>(limbs[i]));
  return wrapped(n, 64 * count);
}

template <int Limbs>
void check_width(std::string_view bytes) {
  constexpr int bits = 64 * Limbs;
  Bytes from(bytes);
  const Integer a = wrapped(from.integer(bits), bits), b = wrapped(from.integer(bits), bits);
  std::array<Limb, Limbs> of_a, of_b;
  to_limbs(a, of_a.data(), Limbs);
  to_limbs(b, of_b.data(), Limbs);
  require(value_of_limbs(of_a.data(), Limbs) == a && from_limbs(of_a.data(), Limbs) == a, "limbs hold the number");
  const Fixed_integer<Limbs> x(of_a.data(), Limbs), y(of_b.data(), Limbs);
  const auto same = [](const Fixed_integer<Limbs>& fixed, const Integer& n) {
    return value_of_limbs(fixed.limbs(), Limbs) == wrapped(n, bits);
  };
  require(same(x + y, a + b), "a sum is one");
  require(same(x - y, a - b), "a difference is one");
  require(same(x * y, a * b), "a product is one");
  require(same(-x, -a), "a negative is one");
  require(x.sign() == sgn(a), "a sign is one");
  require((x == y) == (a == b), "equality is one");
  if (wrapped(a - b, bits) == a - b) require((x < y) == (a < b), "an order is one");
  if (wrapped(b - a, bits) == b - a) require((x > y) == (a > b), "an order is one");
  const auto small = static_cast<std::int64_t>(from.word());
  require(same(Fixed_integer<Limbs>(small), Integer(static_cast<long>(small))),
          "a machine integer is extended by its sign");
  const Fixed_integer<Limbs + 3> wider(of_a.data(), Limbs);
  require(value_of_limbs(wider.limbs(), Limbs + 3) == a, "a narrower number is extended by its sign");

  const long shift = static_cast<long>(from.below(200));
  Rational truth(a);
  mpq_div_2exp(truth.get_mpq_t(), truth.get_mpq_t(), static_cast<mp_bitcnt_t>(shift));
  const Rational error = abs(exact(approximate(of_a.data(), Limbs, shift)) - truth);
  require(error * 4503599627370496 <= abs(truth), "an approximation is within a unit in the last place");
  if (bit_length(a) <= 53) require(error == 0, "an approximation of 53 bits is exact");
}

inline void fixed_integer(std::string_view bytes) {
  check_width<1>(bytes);
  check_width<2>(bytes);
  check_width<4>(bytes);
  check_width<8>(bytes);
  check_width<3>(bytes);
}

}  // namespace fuzz
