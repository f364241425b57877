#pragma once
// Integers of a fixed width for exact signs: no allocation, as many bits as the scene's budget asks for.

#include <sightline/kernel/number.h>

#include <array>
#include <cstdint>

namespace sightline {

using Limb = std::uint64_t;

/// A two's complement integer of 64 x Limbs bits. Arithmetic is modulo 2^(64 Limbs), so a sum of products is exact
/// whenever its final value fits, whatever its intermediate values do. Nothing checks the range at run time: the bit
/// budget (P-02) is the proof. Cost: at most Limbs^2/2 multiplications a product. Exact: yes, within the budget.
template <int Limbs>
class Fixed_integer {
  static_assert(Limbs >= 1);

 public:
  static constexpr int bits = 64 * Limbs;

  Fixed_integer() = default;
  /// Sign-extends a two's complement number of `count` limbs, least significant first. Pre: 1 <= count, and the value
  /// fits this width.
  Fixed_integer(const Limb* limbs, int count) {
    for (int i = 0; i < Limbs; ++i) limb_[i] = i < count ? limbs[i] : extension(limbs[count - 1]);
  }
  Fixed_integer(std::int64_t value) {
    const Limb low = static_cast<Limb>(value);
    limb_[0] = low;
    for (int i = 1; i < Limbs; ++i) limb_[i] = extension(low);
  }

  friend Fixed_integer operator+(const Fixed_integer& a, const Fixed_integer& b) {
    if constexpr (Limbs == 2) return of_whole(a.whole() + b.whole());
    Fixed_integer sum;
    Wide carry = 0;
    for (int i = 0; i < Limbs; ++i) {
      carry += Wide{a.limb_[i]} + b.limb_[i];
      sum.limb_[i] = static_cast<Limb>(carry);
      carry >>= 64;
    }
    return sum;
  }
  friend Fixed_integer operator-(const Fixed_integer& a, const Fixed_integer& b) {
    if constexpr (Limbs == 2) return of_whole(a.whole() - b.whole());
    Fixed_integer difference;
    Wide carry = 1;
    for (int i = 0; i < Limbs; ++i) {
      carry += Wide{a.limb_[i]} + static_cast<Limb>(~b.limb_[i]);
      difference.limb_[i] = static_cast<Limb>(carry);
      carry >>= 64;
    }
    return difference;
  }
  friend Fixed_integer operator*(const Fixed_integer& a, const Fixed_integer& b) {
    if constexpr (Limbs == 2) return of_whole(a.whole() * b.whole());
    if constexpr (Limbs > 4) {  // of a scene's width, much is often a sign
      int rows = Limbs;
      while (rows > 1 && a.limb_[rows - 1] == extension(a.limb_[Limbs - 1])) --rows;
      switch (rows) {
        case 1: return product<1>(a, b);
        case 2: return product<2>(a, b);
        case 3: return product<3>(a, b);
        case 4: return product<4>(a, b);
      }
    }
    return product<Limbs>(a, b);
  }

  Fixed_integer operator-() const { return Fixed_integer(0) - *this; }
  Fixed_integer& operator+=(const Fixed_integer& b) { return *this = *this + b; }
  friend bool operator==(const Fixed_integer&, const Fixed_integer&) = default;
  friend bool operator<(const Fixed_integer& a, const Fixed_integer& b) { return (a - b).sign() < 0; }
  friend bool operator>(const Fixed_integer& a, const Fixed_integer& b) { return b < a; }
  const Limb* limbs() const { return limb_.data(); }

  /// -1, 0 or +1.
  int sign() const {
    if (static_cast<std::int64_t>(limb_[Limbs - 1]) < 0) return -1;
    Limb any = 0;
    for (const Limb limb : limb_) any |= limb;
    return any != 0;
  }

 private:
  using Wide = unsigned __int128;
  // Pre: the limbs of a from `rows` on only extend its sign. They are one subtraction of b, all together.
  template <int rows>
  static Fixed_integer product(const Fixed_integer& a, const Fixed_integer& b) {
    Fixed_integer product{};
    for (int i = 0; i < rows; ++i) {
      Wide carry = 0;
      for (int j = 0; i + j < Limbs; ++j) {
        carry += Wide{a.limb_[i]} * b.limb_[j] + product.limb_[i + j];
        product.limb_[i + j] = static_cast<Limb>(carry);
        carry >>= 64;
      }
    }
    const Limb sign = extension(a.limb_[Limbs - 1]);
    Wide carry = 1;
    for (int j = 0; rows + j < Limbs; ++j) {
      carry += Wide{product.limb_[rows + j]} + static_cast<Limb>(~(b.limb_[j] & sign));
      product.limb_[rows + j] = static_cast<Limb>(carry);
      carry >>= 64;
    }
    return product;
  }
  // Of two limbs it is the compiler's own integer.
  Wide whole() const { return Wide{limb_[1]} << 64 | limb_[0]; }
  static Fixed_integer of_whole(Wide value) {
    Fixed_integer n;
    n.limb_ = {static_cast<Limb>(value), static_cast<Limb>(value >> 64)};
    return n;
  }
  static constexpr Limb extension(Limb top) { return static_cast<Limb>(static_cast<std::int64_t>(top) >> 63); }
  std::array<Limb, Limbs> limb_;
};

/// Writes n as a two's complement number of `count` limbs. Pre: it fits, or std::overflow_error.
void to_limbs(const Integer& n, Limb* limbs, int count);

/// The integer that `count` two's complement limbs hold.
Integer from_limbs(const Limb* limbs, int count);

/// n x 2^-shift as a double, within one unit in the last place (relative error < 2^-52; exact where n fits 53 bits and
/// no underflow occurs; an underflow loses at most 2^-1074).
double approximate(const Limb* limbs, int count, long shift);

}  // namespace sightline
