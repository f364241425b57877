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

  /// Appends mantissa x 10^exponent, over the least denominator 2^a 5^b.
  void push_decimal(std::int64_t mantissa, int exponent) {
    if (mantissa == 0) exponent = 0;
    if (exponent > 0) return push(exact_decimal(Integer(static_cast<long>(mantissa)), exponent));
    int twos = -exponent, fives = -exponent;
    for (; twos > 0 && mantissa % 2 == 0; --twos) mantissa /= 2;
    for (; fives > 0 && mantissa % 5 == 0; --fives) mantissa /= 5;
    entries_.push_back({mantissa, two_five_denominator(twos, fives)});
  }

  /// Appends the double as the number it is. Pre: finite.
  void push_double(double value) {
    int exponent = 0;
    std::int64_t mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    exponent -= 53;
    if (mantissa == 0) {
      entries_.push_back({0, two_five_denominator(0, 0)});
      return;
    }
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    mantissa >>= zeros, exponent += zeros;
    if (exponent <= 0) entries_.push_back({mantissa, two_five_denominator(-exponent, 0)});
    else if (std::fabs(value) < 0x1p62)
      entries_.push_back({mantissa * (std::int64_t{1} << exponent), two_five_denominator(0, 0)});
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
    Rational value(Integer(static_cast<long>(entry.numerator)),
                   denominators_[static_cast<std::size_t>(entry.denominator)]);
    value.canonicalize();
    return value;
  }

  /// Every denominator, and how many numbers have it; wide numbers are not counted.
  std::vector<std::pair<Integer, std::size_t>> denominators() const {
    std::vector<std::pair<Integer, std::size_t>> all;
    for (const Integer& d : denominators_) all.emplace_back(d, 0);
    for (const Entry& entry : entries_)
      if (entry.denominator != wide) ++all[static_cast<std::size_t>(entry.denominator)].second;
    return all;
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
  std::int32_t two_five_denominator(int a, int b) {
    const std::size_t place = static_cast<std::size_t>(a) * 32 + static_cast<std::size_t>(b);
    const bool usual = b < 32 && a < 2048;
    if (usual && place >= two_five_.size()) two_five_.resize(place + 1, wide);
    if (usual && two_five_[place] != wide) return two_five_[place];
    Integer power;
    mpz_ui_pow_ui(power.get_mpz_t(), 5, static_cast<unsigned long>(b));
    power <<= static_cast<unsigned long>(a);
    const std::int32_t id = denominator_id(power);
    if (usual) two_five_[place] = id;
    return id;
  }

  std::vector<Entry> entries_;
  std::vector<Rational> wide_;
  std::vector<Integer> denominators_;
  std::map<Integer, std::int32_t> ids_;
  std::vector<std::int32_t> two_five_;  // ids of 2^a 5^b at 32 a + b
};

}  // namespace sightline
