#pragma once
// Exact numbers in bulk: sixteen bytes for a number that a file usually holds.

#include <sightline/kernel/number.h>

#include <bit>
#include <map>
#include <vector>

namespace sightline {

/// A growing column of exact rationals, each a 64-bit numerator over one of a few shared denominators;
/// numbers that do not fit are kept as GMP rationals beside it. Exact: yes.
class Coordinates {
 public:
  std::size_t size() const { return entries_.size(); }
  void reserve(std::size_t n) { entries_.reserve(n); }

  /// Appends mantissa x 10^exponent.
  void push_decimal(std::int64_t mantissa, int exponent) {
    if (mantissa == 0) exponent = 0;
    while (exponent < 0 && mantissa % 10 == 0) mantissa /= 10, ++exponent;  // 1.500 is 15/10: no wider than it need be
    if (exponent < 0) {
      entries_.push_back({mantissa, decimal_denominator(-exponent)});
      return;
    }
    push(exact_decimal(Integer(static_cast<long>(mantissa)), exponent));
  }

  /// Appends the double as the number it is. Pre: finite.
  void push_double(double value) {
    int exponent = 0;
    std::int64_t mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    exponent -= 53;
    if (mantissa == 0) {
      entries_.push_back({0, denominator_id(1)});
      return;
    }
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    mantissa >>= zeros, exponent += zeros;
    if (exponent < 0) entries_.push_back({mantissa, binary_denominator(-exponent)});
    else push(exact(value));
  }

  /// Appends any rational.
  void push(const Rational& value) {
    if (fits_int64(value.get_num())) {
      entries_.push_back({value.get_num().get_si(), denominator_id(value.get_den())});
    } else {
      entries_.push_back({static_cast<std::int64_t>(wide_.size()), wide});
      wide_.push_back(value);
    }
  }

  Rational operator[](std::size_t i) const {
    const Entry& entry = entries_[i];
    if (entry.denominator == wide) return wide_[static_cast<std::size_t>(entry.numerator)];
    Rational value(Integer(static_cast<long>(entry.numerator)), denominators_[static_cast<std::size_t>(entry.denominator)]);
    value.canonicalize();
    return value;
  }

  /// The least common denominator of all numbers (1 for none).
  Integer common_denominator() const {
    Integer common = 1;
    for (const Integer& d : denominators_) common = lcm(common, d);
    for (const Rational& value : wide_) common = lcm(common, value.get_den());
    return common;
  }

  /// Calls small(i, n) where number i x scale is an integer n that fits 62 bits, and large(i, n) otherwise.
  /// Pre: scale is a multiple of common_denominator().
  template <class Small, class Large>
  void for_each_scaled(const Integer& scale, Small small, Large large) const {
    std::vector<Integer> factor;
    for (const Integer& d : denominators_) factor.push_back(scale / d);
    constexpr std::int64_t limit = std::int64_t{1} << 61;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const Entry& entry = entries_[i];
      if (entry.denominator == wide) {
        const Rational& value = wide_[static_cast<std::size_t>(entry.numerator)];
        const Integer scaled = value.get_num() * (scale / value.get_den());
        large(i, scaled);
        continue;
      }
      const Integer& f = factor[static_cast<std::size_t>(entry.denominator)];
      std::int64_t product = 0;
      if (f.fits_slong_p() && !__builtin_mul_overflow(entry.numerator, f.get_si(), &product) && product < limit && product > -limit)
        small(i, product);
      else
        large(i, Integer(Integer(static_cast<long>(entry.numerator)) * f));
    }
  }

 private:
  struct Entry {
    std::int64_t numerator;    // or, where denominator == wide, an index into wide_
    std::int32_t denominator;  // index into denominators_
  };
  static constexpr std::int32_t wide = -1;

  std::int32_t denominator_id(const Integer& d) {
    const auto [place, fresh] = ids_.try_emplace(d, static_cast<std::int32_t>(denominators_.size()));
    if (fresh) denominators_.push_back(d);
    return place->second;
  }
  std::int32_t power_id(std::vector<std::int32_t>& cache, unsigned long base, int exponent) {
    if (static_cast<std::size_t>(exponent) >= cache.size()) cache.resize(static_cast<std::size_t>(exponent) + 1, wide);
    std::int32_t& id = cache[static_cast<std::size_t>(exponent)];
    if (id == wide) {
      Integer power;
      mpz_ui_pow_ui(power.get_mpz_t(), base, static_cast<unsigned long>(exponent));
      id = denominator_id(power);
    }
    return id;
  }
  std::int32_t decimal_denominator(int exponent) { return power_id(tens_, 10, exponent); }
  std::int32_t binary_denominator(int exponent) { return power_id(twos_, 2, exponent); }

  std::vector<Entry> entries_;
  std::vector<Rational> wide_;
  std::vector<Integer> denominators_;
  std::map<Integer, std::int32_t> ids_;
  std::vector<std::int32_t> tens_, twos_;
};

}  // namespace sightline
