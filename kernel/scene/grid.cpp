#include <sightline/kernel/scene/grid.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <type_traits>
#include <unordered_map>

namespace sightline {

namespace {

std::int64_t greatest_divisor(std::int64_t a, std::int64_t b) { return std::gcd(a, b); }
Integer greatest_divisor(const Integer& a, const Integer& b) { return gcd(a, b); }
Integer integer(std::int64_t n) { return Integer(static_cast<long>(n)); }
Integer integer(const Integer& n) { return n; }

template <class Number>
Number magnitude(const Number& n) {
  return n < 0 ? Number(-n) : n;
}

/// The common denominator of most coordinates, where the rest of them is what makes the grid fine; else that of all.
Integer usual_denominator(const Coordinates& coordinates, const Integer& of_all) {
  auto by_use = coordinates.denominators();
  std::stable_sort(by_use.begin(), by_use.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  Integer usual = 1;
  std::size_t covered = 0;
  for (const auto& [denominator, uses] : by_use) {
    const Integer next = lcm(usual, denominator);
    if (bit_length(next) > 20) continue;  // leaves doubles room for coordinates and their products
    usual = next;
    covered += uses;
  }
  return 2 * covered > coordinates.size() ? usual : of_all;
}

/// Scaled coordinates: what they reach from and to on each axis, and the unit that divides all their differences there.
template <class Number>
struct Extent {
  std::array<Number, 3> low{}, high{}, first{};
  Number unit{}, largest{};
};

template <class Number, class Read>
Extent<Number> extent_of(std::size_t count, Read read) {
  Extent<Number> e;
  for (std::size_t i = 0; i < count; ++i) {
    const Number n = read(i);
    const std::size_t k = i % 3;
    if (i < 3) e.low[k] = e.high[k] = e.first[k] = n;
    if (n < e.low[k]) e.low[k] = n;
    if (e.high[k] < n) e.high[k] = n;
    if (e.largest < magnitude(n)) e.largest = magnitude(n);
    if (e.unit != 1) e.unit = greatest_divisor(e.unit, Number(n - e.first[k]));
  }
  if (e.unit == 0) e.unit = 1;
  return e;
}

/// The centre of an axis, moved to the grid that the first point is on, or to a multiple of the divisor.
template <class Number>
Number centre_of(const Extent<Number>& e, std::size_t k, const Integer& divisor) {
  const Number centre = e.low[k] + (e.high[k] - e.low[k]) / 2;
  if constexpr (std::is_same_v<Number, Integer>)
    if (divisor > 1) return divisor * (centre / divisor);
  return e.first[k] + e.unit * ((centre - e.first[k]) / e.unit);
}

}  // namespace

Scene_grid::Scene_grid(const Coordinates& coordinates, std::vector<std::uint32_t>& ids)
    : scale_(coordinates.common_denominator()) {
  // `divisor`: scaled coordinates that are its multiples are to be exact in doubles, where the grid is too wide for
  // that otherwise.
  const std::size_t count = coordinates.size();
  const auto place = [&]<class Number>(const Number&, Integer divisor, auto read) {
    // 1. The unit, and the centre of each axis.
    const Extent<Number> e = extent_of<Number>(count, read);
    unit_ = integer(e.unit);
    bits_read_ = static_cast<int>(bit_length(integer(e.largest)));
    if (e.unit != 1) divisor = 1;
    std::array<Number, 3> offset;
    const auto centred = [&](const Integer& to_multiples_of) {
      Number reach = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        offset[k] = centre_of(e, k, to_multiples_of);
        offset_[k] = integer(offset[k]);
        for (std::size_t side = 0; side < 2; ++side) {
          const Number end = ((side == 0 ? e.low[k] : e.high[k]) - offset[k]) / e.unit;
          box_[side][k] = integer(end);
          reach = std::max(reach, magnitude(end));
        }
      }
      return static_cast<int>(bit_length(integer(reach)));
    };

    // 2. How wide the grid is. Doubles of what is read stay below 2^512, so that no product or sum of theirs overflows:
    // Plane_group has no other guard against what is no number.
    int bits = centred(1);
    if (bits <= 53 || bits - static_cast<int>(bit_length(divisor)) >= 512) divisor = 1;
    if (divisor != 1) bits = centred(divisor);
    points_ = Grid_points(bits, divisor);

    // 3. The points, equal ones once.
    points_.reserve(count / 3);
    ids.resize(count / 3);
    for (std::size_t p = 0; p < ids.size(); ++p) {
      std::array<Number, 3> grid;
      for (std::size_t k = 0; k < 3; ++k) grid[k] = (read(3 * p + k) - offset[k]) / e.unit;
      ids[p] = points_.intern(grid);
    }
  };

  std::vector<std::int64_t> narrow(count);
  std::unordered_map<std::size_t, Integer> wide;
  coordinates.for_each_scaled(
      scale_, [&](std::size_t i, std::int64_t n) { narrow[i] = n; },
      [&](std::size_t i, const Integer& n) { wide.emplace(i, n); });
  if (wide.empty()) place(std::int64_t{}, 1, [&](std::size_t i) { return narrow[i]; });
  else
    place(Integer(), scale_ / usual_denominator(coordinates, scale_), [&](std::size_t i) -> Integer {
      const auto at = wide.find(i);
      return at == wide.end() ? integer(narrow[i]) : at->second;
    });
}

std::array<Rational, 4> Scene_grid::file_coefficients(const std::array<Integer, 4>& h) const {
  Integer offset = h[3] * unit_;
  for (std::size_t k = 0; k < 3; ++k) offset -= h[k] * offset_[k];
  return {Rational(h[0] * scale_), Rational(h[1] * scale_), Rational(h[2] * scale_), Rational(offset)};
}

Located_point Scene_grid::locate(const Exact_point& p) const {
  std::array<Rational, 3> grid;
  for (std::size_t k = 0; k < 3; ++k) grid[k] = (p[k] * scale_ - offset_[k]) / unit_;
  const auto [whole, common] = Over_common(grid);
  Located_point q{whole[0], whole[1], whole[2], common, 0, 0, 0, 0};
  std::array<double*, 3> place{&q.ax, &q.ay, &q.az};
  for (std::size_t k = 0; k < 3; ++k) {
    Rational scaled = grid[k];
    scaled /= points_.divisor();
    mpq_div_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), static_cast<mp_bitcnt_t>(points_.shift()));
    *place[k] = nearest_double(scaled);
    if (!std::isfinite(*place[k]) || exact(*place[k]) == scaled) continue;
    q.error = std::max(q.error, std::fabs(*place[k]) * 0x1p-52 + 0x1p-1000);
  }
  for (const double* x : place)
    if (!std::isfinite(*x)) {
      q.ax = q.ay = q.az = 0;
      q.error = std::numeric_limits<double>::infinity();
    }
  return q;
}

Exact_point Scene_grid::position(const std::array<Integer, 4>& h) const {
  Exact_point p;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = Rational(offset_[k] * h[3] + unit_ * h[k], scale_ * h[3]);
    p[k].canonicalize();
  }
  return p;
}

Exact_point Scene_grid::position(std::uint32_t point) const {
  const std::optional<std::array<std::int64_t, 3>> scaled = small_position(point);
  if (!scaled) return position({points_.integer(point, 0), points_.integer(point, 1), points_.integer(point, 2), 1});
  const std::int64_t scale = scale_.get_si();
  Exact_point p;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t divisor = std::gcd((*scaled)[k], scale);
    p[k].get_num() = static_cast<long>((*scaled)[k] / divisor);
    p[k].get_den() = static_cast<long>(scale / divisor);
  }
  return p;
}

std::optional<std::array<std::int64_t, 3>> Scene_grid::small_position(std::uint32_t point) const {
  if (points_.limbs() != 1 || !fits_int64(scale_) || !fits_int64(unit_)) return std::nullopt;
  std::array<std::int64_t, 3> scaled{};
  for (std::size_t k = 0; k < 3; ++k)
    if (!fits_int64(offset_[k]) ||
        __builtin_mul_overflow(unit_.get_si(), points_.small(point, static_cast<int>(k)), &scaled[k]) ||
        __builtin_add_overflow(scaled[k], offset_[k].get_si(), &scaled[k]) ||
        scaled[k] == std::numeric_limits<std::int64_t>::min())  // which has no magnitude
      return std::nullopt;
  return scaled;
}

Point_id Scene_grid::add_point(std::uint32_t point, Polygon_soup& soup) const {
  if (const auto scaled = small_position(point)) return soup.add_point(*scaled, scale_.get_si());
  const Exact_point p = position(point);
  return soup.add_point(p[0], p[1], p[2]);
}

std::array<Exact_point, 2> Scene_grid::box() const {
  std::array<Exact_point, 2> corners;
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t k = 0; k < 3; ++k) corners[side][k] = Rational(offset_[k] + unit_ * box_[side][k]) / scale_;
  return corners;
}

}  // namespace sightline
