#include <sightline/kernel/plane_table.h>

#include <bit>
#include <numeric>
#include <stdexcept>

namespace sightline {

namespace {

/// As std::gcd, without a branch on which of two odd numbers is the greater, which no processor can predict.
std::uint64_t common_divisor(std::uint64_t a, std::uint64_t b) {
  if (a == 0 || b == 0) return a | b;
  const int twos = std::countr_zero(a | b);
  a >>= std::countr_zero(a);
  b >>= std::countr_zero(b);
  while (a != b) {
    const std::uint64_t step = a - b;
    const std::uint64_t mask = 0 - std::uint64_t{a < b};  // all ones where the step is negative
    a = b + (step & mask);
    b = ((step ^ mask) - mask) >> std::countr_zero(step);
  }
  return a << twos;
}

}  // namespace

std::uint32_t Grid_points::intern(const std::array<Integer, 3>& p) {
  std::vector<Limb> row(rows_.stride());
  for (std::size_t k = 0; k < 3; ++k) to_limbs(p[k], &row[k * static_cast<std::size_t>(limbs_per_)], limbs_per_);
  return remember(rows_.intern(row.data()));
}

std::uint32_t Grid_points::remember(std::uint32_t id) {
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

Point_planes::Point_planes(std::size_t points, std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs)
    : begin_(points + 1), planes_(pairs.size()) {
  for (const auto& [point, plane] : pairs) ++begin_[point + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (const auto& [point, plane] : pairs) planes_[next[point]++] = plane;
  for (std::size_t p = 0; p < points; ++p)
    std::sort(planes_.begin() + static_cast<std::ptrdiff_t>(begin_[p]),
              planes_.begin() + static_cast<std::ptrdiff_t>(begin_[p + 1]));
}

std::uint32_t Point_planes::other_plane(std::uint32_t p, std::uint32_t q, std::uint32_t than) const {
  const std::span<const std::uint32_t> list = at(p);
  for (const std::uint32_t plane : list.first(std::min<std::size_t>(list.size(), 24)))
    if (plane != than && contains(q, plane)) return plane;
  return ~std::uint32_t{0};
}

Plane Plane_table::intern(const Integer& a, const Integer& b, const Integer& c, const Integer& d) {
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

Plane Plane_table::intern(std::int64_t a, std::int64_t b, std::int64_t c, __int128 d) {
  const auto magnitude = [](auto x) {
    return x < 0 ? -static_cast<unsigned __int128>(x) : static_cast<unsigned __int128>(x);
  };
  std::uint64_t common =
      common_divisor(static_cast<std::uint64_t>(magnitude(a)), static_cast<std::uint64_t>(magnitude(b)));
  // What is left of a common divisor is small, mostly.
  if (common > 1) common = common_divisor(common, static_cast<std::uint64_t>(magnitude(c)) % common);
  if (common == 0) common = static_cast<std::uint64_t>(magnitude(c));
  if (common == 0) throw std::domain_error("a plane needs a normal");
  const bool is_narrow = static_cast<std::int64_t>(d) == d;  // divisions of 128 bits take long
  if (common > 1)
    common = common_divisor(common, is_narrow ? static_cast<std::uint64_t>(magnitude(d)) % common
                                              : static_cast<std::uint64_t>(magnitude(d) % common));
  const bool flipped = a != 0 ? a < 0 : b != 0 ? b < 0 : c < 0;
  if (common > 1) {
    const auto divisor = static_cast<std::int64_t>(common);
    a /= divisor;
    b /= divisor;
    c /= divisor;
    d = is_narrow ? __int128{static_cast<std::int64_t>(d) / divisor} : d / divisor;
  }
  if (flipped) {
    a = -a;
    b = -b;
    c = -c;
    d = -d;
  }
  scratch_.assign(rows_.stride(), 0);
  const auto put = [&](__int128 x, Limb* limbs, int count) {
    limbs[0] = static_cast<Limb>(x);
    for (int i = 1; i < count; ++i) limbs[i] = static_cast<Limb>(i == 1 ? x >> 64 : x >> 127);
  };
  put(a, scratch_.data(), normal_limbs_);
  put(b, scratch_.data() + normal_limbs_, normal_limbs_);
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

Plane Plane_table::find_axis_plane(int axis, const Limb* coordinate, int coordinate_limbs) const {
  // Row (0.. 1 ..0, -x): negate in two's complement, sign-extended to the offset's width.
  std::array<Limb, 64> buffer;
  std::vector<Limb> heap;
  Limb* row = buffer.data();
  if (rows_.stride() > buffer.size()) {
    heap.resize(rows_.stride());
    row = heap.data();
  }
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

std::uint32_t Plane_table::place(int normal_width, int offset_width) {
  const std::uint32_t id = rows_.intern(scratch_.data());
  if (id < size()) return id;
  if (id >= Plane::max_table_planes) throw std::length_error("too many planes");
  budget_.normal = std::max(budget_.normal, normal_width);
  budget_.offset = std::max(budget_.offset, offset_width);
  approximate_.push_back(approximation(id, normal_width));
  return id;
}

Approximate_plane Plane_table::approximation(std::uint32_t id, int normal_width) const {
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

}  // namespace sightline
