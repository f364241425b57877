#include <sightline/kernel/coordinates.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace sightline {

void Coordinates::push_decimal(std::int64_t mantissa, int exponent) {
  if (mantissa == 0) exponent = 0;
  if (exponent > 0) return push(exact_decimal(Integer(static_cast<long>(mantissa)), exponent));
  int twos = -exponent, fives = -exponent;
  for (; twos > 0 && mantissa % 2 == 0; --twos) mantissa /= 2;
  for (; fives > 0 && mantissa % 5 == 0; --fives) mantissa /= 5;
  entries_.push_back({mantissa, two_five_denominator(twos, fives)});
}

void Coordinates::push_double(double value) {
  int exponent = 0;
  std::int64_t mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  exponent -= 53;
  if (mantissa == 0) {
    entries_.push_back({0, two_five_denominator(0, 0)});
    return;
  }
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
  mantissa >>= zeros;
  exponent += zeros;
  if (exponent <= 0) entries_.push_back({mantissa, two_five_denominator(-exponent, 0)});
  else if (std::fabs(value) < 0x1p62)
    entries_.push_back({mantissa * (std::int64_t{1} << exponent), two_five_denominator(0, 0)});
  else push(exact(value));
}

void Coordinates::push_ratio(std::int64_t numerator, std::int64_t denominator) {
  const auto unsigned_of = [](std::int64_t n) { return static_cast<std::uint64_t>(n); };
  if (std::has_single_bit(unsigned_of(denominator))) {  // divisions take long
    const int fine = std::countr_zero(unsigned_of(denominator));
    const int zeros = numerator == 0 ? fine : std::min(fine, std::countr_zero(unsigned_of(numerator)));
    entries_.push_back({numerator >> zeros, two_five_denominator(fine - zeros, 0)});
    return;
  }
  const std::uint64_t magnitude = numerator < 0 ? 0 - unsigned_of(numerator) : unsigned_of(numerator);
  const auto common = static_cast<std::int64_t>(std::gcd(magnitude, unsigned_of(denominator)));
  numerator /= common;
  denominator /= common;
  const int twos = std::countr_zero(unsigned_of(denominator));
  std::int64_t rest = denominator >> twos;
  int fives = 0;
  for (; rest > 1 && rest % 5 == 0; ++fives) rest /= 5;
  entries_.push_back({numerator, rest == 1 ? two_five_denominator(twos, fives)
                                           : denominator_id(Integer(static_cast<long>(denominator)))});
}

void Coordinates::push(const Rational& value) {
  if (fits_int64(value.get_num())) {
    entries_.push_back({value.get_num().get_si(), denominator_id(value.get_den())});
  } else {
    entries_.push_back({static_cast<std::int64_t>(wide_.size()), wide});
    wide_.push_back(value);
  }
}

void Coordinates::append(const Coordinates& other) {
  std::vector<std::int32_t> ids;
  for (const Integer& d : other.denominators_) ids.push_back(denominator_id(d));
  for (const Entry& entry : other.entries_)
    if (entry.denominator == wide) push(other.wide_[static_cast<std::size_t>(entry.numerator)]);
    else entries_.push_back({entry.numerator, ids[static_cast<std::size_t>(entry.denominator)]});
}

Rational Coordinates::operator[](std::size_t i) const {
  const Entry& entry = entries_[i];
  if (entry.denominator == wide) return wide_[static_cast<std::size_t>(entry.numerator)];
  Rational value(Integer(static_cast<long>(entry.numerator)),
                 denominators_[static_cast<std::size_t>(entry.denominator)]);
  value.canonicalize();
  return value;
}

std::vector<std::pair<Integer, std::size_t>> Coordinates::denominators() const {
  std::vector<std::pair<Integer, std::size_t>> all;
  for (const Integer& d : denominators_) all.emplace_back(d, 0);
  for (const Entry& entry : entries_)
    if (entry.denominator != wide) ++all[static_cast<std::size_t>(entry.denominator)].second;
  return all;
}

Integer Coordinates::common_denominator() const {
  Integer common = 1;
  for (const Integer& d : denominators_) common = lcm(common, d);
  for (const Rational& value : wide_) common = lcm(common, value.get_den());
  return common;
}

std::int32_t Coordinates::two_five_denominator(int a, int b) {
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

}  // namespace sightline
