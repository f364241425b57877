#pragma once
// Exact numbers in bulk: sixteen bytes for a number that a file usually holds.

#include <sightline/kernel/number.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace sightline {

/// A growing column of exact rationals, each a 64-bit numerator over one of a few shared denominators;
/// numbers that do not fit are kept as GMP rationals beside it. Exact: yes.
class Coordinates {
 public:
  std::size_t size() const { return entries_.size(); }
  void reserve(std::size_t n) { entries_.reserve(n); }

  /// Appends mantissa x 10^exponent, over the least denominator 2^a 5^b.
  void push_decimal(std::int64_t mantissa, int exponent);

  /// Appends the double as the number it is. Pre: finite.
  void push_double(double value);

  /// Appends a quotient, which need not be reduced. Pre: denominator > 0.
  void push_ratio(std::int64_t numerator, std::int64_t denominator);

  /// Appends any rational.
  void push(const Rational& value);

  /// Appends all numbers of another column.
  void append(const Coordinates& other);

  Rational operator[](std::size_t i) const;

  /// Every denominator, and how many numbers have it; wide numbers are not counted.
  std::vector<std::pair<Integer, std::size_t>> denominators() const;

  /// The least common denominator of all numbers (1 for none).
  Integer common_denominator() const;

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
      if (f.fits_slong_p() && !__builtin_mul_overflow(entry.numerator, f.get_si(), &product) && product < limit &&
          product > -limit)
        small(i, product);
      else large(i, Integer(Integer(static_cast<long>(entry.numerator)) * f));
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
  /// The id of 2^a 5^b.
  std::int32_t two_five_denominator(int a, int b);

  std::vector<Entry> entries_;
  std::vector<Rational> wide_;
  std::vector<Integer> denominators_;
  std::map<Integer, std::int32_t> ids_;
  std::vector<std::int32_t> two_five_;  // ids of 2^a 5^b at 32 a + b
};

}  // namespace sightline
