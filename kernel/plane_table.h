#pragma once
// The planes of a scene: canonical integer coefficients, each plane once, numbered.

#include <sightline/kernel/arithmetic.h>
#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/row_table.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

/// a x + b y + c z + d in doubles for approximate coordinates (see Grid_points), each coefficient within a relative
/// 2^-52 of the plane's own times one common factor.
struct Approximate_plane {
  double a, b, c, d;
  bool exact;  ///< integers without error, where they are below 2^53
};

/// The input points on the scene's integer grid (see Scene), equal points once, as two's complement limbs.
/// Approximate coordinates, in doubles, are grid coordinates over `divisor` times 2^-shift. Up to 53 bits both change
/// nothing. A wider grid is mostly one where few coordinates are to blame: then the divisor takes most of them back to
/// small integers, which doubles hold exactly; with no such divisor (1), the shift makes them less than 1.
class Grid_points {
 public:
  Grid_points() = default;
  /// Pre: |every coordinate| < 2^coordinate_bits; divisor >= 1, and 1 where coordinate_bits <= 53.
  explicit Grid_points(int coordinate_bits, Integer divisor = 1)
      : bits_(coordinate_bits),
        limbs_per_(coordinate_bits / 64 + 1),
        divisor_(std::move(divisor)),
        shift_(coordinate_bits <= 53 || divisor_ > 1 ? 0 : coordinate_bits),
        rows_(static_cast<std::size_t>(3 * limbs_per_)) {
    Rational range;
    mpz_setbit(range.get_num().get_mpz_t(), static_cast<mp_bitcnt_t>(bits_ - shift_));
    range_ = nearest_double(Rational(range / divisor_)) * (1 + 0x1p-50);
  }

  int bits() const { return bits_; }
  int limbs() const { return limbs_per_; }
  long shift() const { return shift_; }
  const Integer& divisor() const { return divisor_; }
  /// At least the size of every approximate coordinate.
  double range() const { return range_; }
  std::size_t size() const { return rows_.size(); }
  void reserve(std::size_t n) { rows_.reserve(n); }

  /// The id of a point, new or not.
  std::uint32_t intern(const std::array<std::int64_t, 3>& p) {  // Pre: limbs() == 1
    const Limb row[3] = {static_cast<Limb>(p[0]), static_cast<Limb>(p[1]), static_cast<Limb>(p[2])};
    return remember(rows_.intern(row));
  }
  std::uint32_t intern(const std::array<Integer, 3>& p);

  const Limb* coordinate(std::uint32_t point, int axis) const { return rows_[point] + axis * limbs_per_; }
  std::int64_t small(std::uint32_t point, int axis) const {
    return static_cast<std::int64_t>(*coordinate(point, axis));
  }  // Pre: limbs() == 1
  Integer integer(std::uint32_t point, int axis) const { return from_limbs(coordinate(point, axis), limbs_per_); }

  double approximate(std::uint32_t point, int axis) const {
    return is_narrow() ? static_cast<double>(small(point, axis))
                       : wide_[3 * std::size_t{point} + static_cast<std::size_t>(axis)].value;
  }
  /// Whether the approximate coordinate is an integer without error.
  bool is_exact(std::uint32_t point, int axis) const {
    return is_narrow() || wide_[3 * std::size_t{point} + static_cast<std::size_t>(axis)].exact;
  }

 private:
  bool is_narrow() const { return bits_ <= 53; }
  /// Wide coordinates are approximated once.
  std::uint32_t remember(std::uint32_t id);

  struct Wide {
    double value;
    bool exact;
  };
  int bits_ = 0;
  int limbs_per_ = 1;
  Integer divisor_ = 1;
  long shift_ = 0;
  double range_ = 1;
  Row_table rows_{3};
  std::vector<Wide> wide_;
};

/// Which supporting planes pass through each input point, as far as faces with a corner there say.
class Point_planes {
 public:
  Point_planes() = default;
  /// Pre: pairs (point, plane id), points below `points`. Cost: O(pairs log valence).
  Point_planes(std::size_t points, std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs);

  /// Ascending, with repetitions.
  std::span<const std::uint32_t> at(std::uint32_t point) const {
    if (point + std::size_t{1} >= begin_.size()) return {};
    return {planes_.data() + begin_[point], begin_[point + 1] - begin_[point]};
  }
  bool contains(std::uint32_t point, std::uint32_t plane) const {
    const std::span<const std::uint32_t> list = at(point);
    return std::binary_search(list.begin(), list.end(), plane);
  }
  /// A plane through both points other than the given one, or Vertex::no_plane: the face on the other side of an edge.
  /// Looks at few planes only.
  std::uint32_t other_plane(std::uint32_t p, std::uint32_t q, std::uint32_t than) const;

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> planes_;
};

/// Interned planes with integer coefficients in canonical form: gcd(a, b, c, d) = 1 and the first non-zero of a, b, c
/// positive. Equal planes have equal ids, whatever they were made from and however they were oriented. Exact: yes.
/// Proof: P-01
class Plane_table {
 public:
  Plane_table() : Plane_table(Grid_points(1)) {}
  /// For planes through points of the given grid: rows are as wide as such planes can be (P-02), wider ones are
  /// refused.
  explicit Plane_table(const Grid_points& points)
      : divisor_(points.divisor()),
        shift_(points.shift()),
        normal_limbs_((2 * points.bits() + 3) / 64 + 1),
        offset_limbs_((3 * points.bits() + 5) / 64 + 1),
        rows_(static_cast<std::size_t>(3 * normal_limbs_ + offset_limbs_)) {
    budget_.coordinate = points.bits();
  }

  /// The handle of a x + b y + c z + d = 0 whose front is where that is positive. Pre: (a, b, c) != 0, or
  /// std::domain_error. std::overflow_error where the reduced coefficients are wider than a plane through three grid
  /// points can be.
  Plane intern(const Integer& a, const Integer& b, const Integer& c, const Integer& d);

  /// The same for coefficients of machine width. Pre: |a|, |b|, |c| < 2^63, |d| < 2^126.
  Plane intern(std::int64_t a, std::int64_t b, std::int64_t c, __int128 d);

  std::size_t size() const { return approximate_.size(); }
  /// Room for so many planes.
  void reserve(std::size_t planes) {
    rows_.reserve(planes);
    approximate_.reserve(planes);
  }
  const Bit_budget& budget() const { return budget_; }
  int normal_limbs() const { return normal_limbs_; }
  int offset_limbs() const { return offset_limbs_; }

  /// Coefficient k (0..2: normal, 3: offset) of a plane in its canonical orientation. Pre: not an axis plane.
  const Limb* coefficient(std::uint32_t id, int k) const { return rows_[id] + k * normal_limbs_; }
  Integer integer(std::uint32_t id, int k) const {
    return from_limbs(coefficient(id, k), k == 3 ? offset_limbs_ : normal_limbs_);
  }
  /// The canonical plane in doubles, for approximate coordinates.
  const Approximate_plane& approximate(std::uint32_t id) const { return approximate_[id]; }

  /// The plane a x + b y + c z + d = 0 if the table holds it. Thread-safe beside other reads.
  Plane find_axis_plane(int axis, const Limb* coordinate, int coordinate_limbs) const;

 private:
  /// The id of the row in scratch_, which is new or not.
  std::uint32_t place(int normal_width, int offset_width);
  Approximate_plane approximation(std::uint32_t id, int normal_width) const;

  Integer divisor_;
  long shift_;
  int normal_limbs_, offset_limbs_;
  Bit_budget budget_;
  Row_table rows_;
  std::vector<Approximate_plane> approximate_;
  std::vector<Limb> scratch_;
};

}  // namespace sightline
