#include <sightline/kernel/fixed_integer.h>

#include <sightline/kernel/number.h>

#include <cstddef>
#include <stdexcept>

namespace sightline {

void to_limbs(const Integer& n, Limb* limbs, int count) {
  const bool negative = sgn(n) < 0;
  const Integer magnitude = negative ? Integer(-n - 1) : n;  // the complement of a negative number
  if (bit_length(magnitude) >= static_cast<std::size_t>(64 * count))
    throw std::overflow_error("integer wider than its limbs");
  std::size_t written = 0;
  mpz_export(limbs, &written, -1, sizeof(Limb), 0, 0, magnitude.get_mpz_t());
  for (std::size_t i = written; i < static_cast<std::size_t>(count); ++i) limbs[i] = 0;
  if (negative)
    for (int i = 0; i < count; ++i) limbs[i] = ~limbs[i];
}

Integer from_limbs(const Limb* limbs, int count) {
  if (count == 1) return Integer(static_cast<long>(static_cast<std::int64_t>(limbs[0])));
  Integer n;
  mpz_import(n.get_mpz_t(), static_cast<std::size_t>(count), -1, sizeof(Limb), 0, 0, limbs);
  if (static_cast<std::int64_t>(limbs[count - 1]) < 0) {
    Integer modulus;
    mpz_setbit(modulus.get_mpz_t(), static_cast<mp_bitcnt_t>(64 * count));
    n -= modulus;
  }
  return n;
}

double approximate(const Limb* limbs, int count, long shift) {
  if (count == 1 && shift == 0) return static_cast<double>(static_cast<std::int64_t>(limbs[0]));
  if (count == 2 && shift == 0)
    return static_cast<double>(static_cast<__int128>((static_cast<unsigned __int128>(limbs[1]) << 64) | limbs[0]));
  return cut_off(from_limbs(limbs, count), shift);
}

}  // namespace sightline
