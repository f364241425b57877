#pragma once
// The planes of a scene: canonical integer coefficients, each plane once, numbered.

#include <sightline/kernel/arithmetic.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/row_table.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
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
  std::uint32_t intern(const std::array<Integer, 3>& p) {
    std::vector<Limb> row(rows_.stride());
    for (std::size_t k = 0; k < 3; ++k) to_limbs(p[k], &row[k * static_cast<std::size_t>(limbs_per_)], limbs_per_);
    return remember(rows_.intern(row.data()));
  }

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
  std::uint32_t remember(std::uint32_t id) {
    if (is_narrow() || 3 * std::size_t{id} < wide_.size()) return id;
    for (int axis = 0; axis < 3; ++axis) {
      Rational value(integer(id, axis), divisor_);
      value.canonicalize();
      const bool whole = divisor_ > 1 && value.get_den() == 1 && bit_length(value.get_num()) <= 53;
      mpq_div_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(shift_));
      wide_.push_back({nearest_double(value), whole});
    }
    return id;
  }

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
  Point_planes(std::size_t points, std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs)
      : begin_(points + 1), planes_(pairs.size()) {
    for (const auto& [point, plane] : pairs) ++begin_[point + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (const auto& [point, plane] : pairs) planes_[next[point]++] = plane;
    for (std::size_t p = 0; p < points; ++p)
      std::sort(planes_.begin() + static_cast<std::ptrdiff_t>(begin_[p]),
                planes_.begin() + static_cast<std::ptrdiff_t>(begin_[p + 1]));
  }

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
  std::uint32_t other_plane(std::uint32_t p, std::uint32_t q, std::uint32_t than) const {
    const std::span<const std::uint32_t> list = at(p);
    for (const std::uint32_t plane : list.first(std::min<std::size_t>(list.size(), 24)))
      if (plane != than && contains(q, plane)) return plane;
    return ~std::uint32_t{0};
  }

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
  Plane intern(const Integer& a, const Integer& b, const Integer& c, const Integer& d) {
    std::array<Integer, 4> row{a, b, c, d};
    const Integer divisor = gcd(gcd(a, b), c);
    if (sgn(divisor) == 0) throw std::domain_error("a plane needs a normal");
    const Integer common = gcd(divisor, d);
    const bool flipped = sgn(a) != 0 ? sgn(a) < 0 : sgn(b) != 0 ? sgn(b) < 0 : sgn(c) < 0;
    for (Integer& x : row) {
      mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), common.get_mpz_t());
      if (flipped) x = -x;
    }
    scratch_.resize(rows_.stride());
    for (int k = 0; k < 3; ++k)
      to_limbs(row[static_cast<std::size_t>(k)], scratch_.data() + k * normal_limbs_, normal_limbs_);
    to_limbs(row[3], scratch_.data() + 3 * normal_limbs_, offset_limbs_);
    const auto width = [&](int k) { return static_cast<int>(bit_length(row[static_cast<std::size_t>(k)])); };
    return {place(std::max({width(0), width(1), width(2)}), width(3)), flipped};
  }

  /// The same for coefficients of machine width. Pre: |a|, |b|, |c| < 2^63, |d| < 2^126.
  Plane intern(std::int64_t a, std::int64_t b, std::int64_t c, __int128 d) {
    const auto magnitude = [](auto x) {
      return x < 0 ? -static_cast<unsigned __int128>(x) : static_cast<unsigned __int128>(x);
    };
    std::uint64_t common =
        std::gcd(std::gcd(static_cast<std::uint64_t>(magnitude(a)), static_cast<std::uint64_t>(magnitude(b))),
                 static_cast<std::uint64_t>(magnitude(c)));
    if (common == 0) throw std::domain_error("a plane needs a normal");
    if (common > 1) common = std::gcd(common, static_cast<std::uint64_t>(magnitude(d) % common));
    const bool flipped = a != 0 ? a < 0 : b != 0 ? b < 0 : c < 0;
    const std::int64_t divisor = flipped ? -static_cast<std::int64_t>(common) : static_cast<std::int64_t>(common);
    if (common > 1 || flipped) a /= divisor, b /= divisor, c /= divisor, d /= divisor;
    scratch_.assign(rows_.stride(), 0);
    const auto put = [&](__int128 x, Limb* limbs, int count) {
      limbs[0] = static_cast<Limb>(x);
      for (int i = 1; i < count; ++i) limbs[i] = static_cast<Limb>(i == 1 ? x >> 64 : x >> 127);
    };
    put(a, scratch_.data(), normal_limbs_), put(b, scratch_.data() + normal_limbs_, normal_limbs_),
        put(c, scratch_.data() + 2 * normal_limbs_, normal_limbs_);
    put(d, scratch_.data() + 3 * normal_limbs_, offset_limbs_);
    const auto width = [&](__int128 x) {
      const unsigned __int128 m = magnitude(x);
      const std::uint64_t high = static_cast<std::uint64_t>(m >> 64);
      return high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(static_cast<std::uint64_t>(m));
    };
    if (offset_limbs_ == 1 && width(d) > 63) throw std::overflow_error("offset wider than its limbs");
    return {place(std::max({width(a), width(b), width(c)}), width(d)), flipped};
  }

  std::size_t size() const { return approximate_.size(); }
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
  Plane find_axis_plane(int axis, const Limb* coordinate, int coordinate_limbs) const {
    // Row (0.. 1 ..0, -x): negate in two's complement, sign-extended to the offset's width.
    std::array<Limb, 64> buffer;
    std::vector<Limb> heap;
    Limb* row = buffer.data();
    if (rows_.stride() > buffer.size()) heap.resize(rows_.stride()), row = heap.data();
    std::fill(row, row + rows_.stride(), Limb{0});
    row[axis * normal_limbs_] = 1;
    const Limb extension = static_cast<Limb>(static_cast<std::int64_t>(coordinate[coordinate_limbs - 1]) >> 63);
    Limb carry = 1;
    for (int i = 0; i < offset_limbs_; ++i) {
      const Limb x = ~(i < coordinate_limbs ? coordinate[i] : extension);
      row[3 * normal_limbs_ + i] = x + carry;
      carry = carry != 0 && x == ~Limb{0};
    }
    const std::uint32_t id = rows_.find(row);
    return id == Row_table::none ? Plane{} : Plane{id, false};
  }

 private:
  /// The id of the row in scratch_, which is new or not.
  std::uint32_t place(int normal_width, int offset_width) {
    const std::uint32_t id = rows_.intern(scratch_.data());
    if (id < size()) return id;
    if (id >= Plane::max_table_planes) throw std::length_error("too many planes");
    budget_.normal = std::max(budget_.normal, normal_width);
    budget_.offset = std::max(budget_.offset, offset_width);
    approximate_.push_back(approximation(id, normal_width));
    return id;
  }
  Approximate_plane approximation(std::uint32_t id, int normal_width) const {
    const auto in_double = [&](int k, long shift) {
      return sightline::approximate(coefficient(id, k), k == 3 ? offset_limbs_ : normal_limbs_, shift);
    };
    if (divisor_ == 1 && shift_ == 0) return {in_double(0, 0), in_double(1, 0), in_double(2, 0), in_double(3, 0), true};
    // Points are divided by divisor_ 2^shift_, so the offset is too, relative to the normal; then all by a power of two
    // where that is wide.
    const long scale = shift_ == 0 && normal_width <= 53 ? 0 : normal_width;
    Rational offset(integer(id, 3), divisor_);
    offset.canonicalize();
    const bool exact = shift_ == 0 && scale == 0 && offset.get_den() == 1;
    mpq_div_2exp(offset.get_mpq_t(), offset.get_mpq_t(), static_cast<mp_bitcnt_t>(scale + shift_));
    return {in_double(0, scale), in_double(1, scale), in_double(2, scale), nearest_double(offset), exact};
  }

  Integer divisor_;
  long shift_;
  int normal_limbs_, offset_limbs_;
  Bit_budget budget_;
  Row_table rows_;
  std::vector<Approximate_plane> approximate_;
  std::vector<Limb> scratch_;
};

}  // namespace sightline
