#include <sightline/algorithms/rays/whole_ray.h>

#include <sightline/kernel/located_point.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/predicates.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <span>
#include <utility>

namespace sightline {

namespace {

// Small: directions and origins are below 2^40, corners times the weight too, so that corners from the origin are below
// 2^41, and sums of six products of three are below 2^125.
constexpr int most_bits = 40;

bool is_below(std::int64_t n, int bits) { return n < (std::int64_t{1} << bits) && n > -(std::int64_t{1} << bits); }

/// n 2^exponent, with the greatest exponent.
struct Dyadic {
  std::int64_t n;
  int exponent;
  static constexpr std::int64_t too_long = std::int64_t{1} << 62;

  /// Pre: finite.
  explicit Dyadic(double x) : n(0), exponent(std::numeric_limits<int>::max()) {
    if (x == 0) return;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const int biased = static_cast<int>(bits >> 52 & 0x7FF);
    std::uint64_t size = bits & 0xFFFFFFFFFFFFF;
    if (biased != 0) size |= std::uint64_t{1} << 52;
    const int zeros = std::countr_zero(size);
    n = static_cast<std::int64_t>(size >> zeros);
    if (x < 0) n = -n;
    exponent = std::max(biased, 1) - 1075 + zeros;
  }

  /// In units of 2^of, which is not above the exponent; too_long where that has 62 bits or more.
  std::int64_t in_units(int of) const {
    if (n == 0) return 0;
    const long shift = long{exponent} - of;
    return shift < 62 && is_below(n, static_cast<int>(62 - shift)) ? n * (std::int64_t{1} << shift) : too_long;
  }
};

/// Whether p is a multiple of a direction.
template <class Product, class Number>
bool is_on_line(const std::array<Number, 3>& direction, const std::array<Number, 3>& p) {
  for (std::size_t k = 0; k < 3; ++k)
    if (static_cast<const Product&>(direction[(k + 1) % 3]) * p[(k + 2) % 3] !=
        static_cast<const Product&>(direction[(k + 2) % 3]) * p[(k + 1) % 3])
      return false;
  return true;
}

}  // namespace

Whole_ray::Grid::Grid(const Scene& scene) : scene_(&scene) {
  const Exact_point centre = scene.position({0, 0, 0, 1});
  step_ = scene.position({1, 0, 0, 1})[0] - centre[0];
  double_step_ = nearest_double(step_);
  is_dyadic_ = std::isfinite(double_step_) && exact(double_step_) == step_;
  for (std::size_t k = 0; k < 3; ++k) {
    double_centre_[k] = nearest_double(centre[k]);
    is_dyadic_ = is_dyadic_ && std::isfinite(double_centre_[k]) && exact(double_centre_[k]) == centre[k];
  }
}

// ---- Numbers

const Whole_ray::Whole& Whole_ray::whole() {
  if (whole_) return *whole_;
  whole_.emplace();
  const Exact_ray ray = given_ != nullptr ? *given_ : doubles_->exact();
  Located_point from = scene_.locate(ray.origin);
  whole_->origin = {std::move(from.x), std::move(from.y), std::move(from.z)};
  whole_->weight = std::move(from.w);
  Exact_point direction;
  for (std::size_t k = 0; k < 3; ++k) direction[k] = ray.direction[k] / grid_.step();
  Over_common over(direction);
  whole_->direction = std::move(over.whole);
  whole_->denominator = std::move(over.denominator);
  return *whole_;
}

const std::optional<Whole_ray::Small>& Whole_ray::small() {
  if (small_) return *small_;
  small_.emplace();
  if (scene_.points().bits() > most_bits) return *small_;
  if (doubles_ != nullptr && grid_.is_dyadic_) *small_ = small_of(*doubles_);
  if (!*small_) *small_ = small_of(whole());
  return *small_;
}

/// Without a division: in units of the finest power of two that origin, grid and centre are multiples of.
std::optional<Whole_ray::Small> Whole_ray::small_of(const Double_ray& ray) const {
  const auto finest_of = [](std::initializer_list<Dyadic> all) {
    return std::min(all, [](const Dyadic& a, const Dyadic& b) { return a.exponent < b.exponent; }).exponent;
  };
  const Dyadic step(grid_.double_step_);
  const std::array<Dyadic, 3> centre{Dyadic(grid_.double_centre_[0]), Dyadic(grid_.double_centre_[1]),
                                     Dyadic(grid_.double_centre_[2])},
      origin{Dyadic(ray.origin[0]), Dyadic(ray.origin[1]), Dyadic(ray.origin[2])},
      direction{Dyadic(ray.direction[0]), Dyadic(ray.direction[1]), Dyadic(ray.direction[2])};
  const int finest = finest_of({step, centre[0], centre[1], centre[2], origin[0], origin[1], origin[2]}),
            finest_direction = finest_of({direction[0], direction[1], direction[2]});
  Small small;
  small.weight = step.in_units(finest);
  bool is_short = small.weight <= std::int64_t{1} << (most_bits - scene_.points().bits());
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t from = origin[k].in_units(finest), middle = centre[k].in_units(finest);
    small.origin[k] = from - middle;
    small.direction[k] = direction[k].in_units(finest_direction);
    is_short = is_short && from != Dyadic::too_long && middle != Dyadic::too_long &&
               is_below(small.origin[k], most_bits) && is_below(small.direction[k], most_bits);
  }
  return is_short ? std::optional(small) : std::nullopt;
}

std::optional<Whole_ray::Small> Whole_ray::small_of(const Whole& whole) const {
  const auto is_within = [](const Integer& n, int bits) { return bit_length(n) <= static_cast<std::size_t>(bits); };
  bool is_short = is_within(whole.weight, most_bits - scene_.points().bits());
  for (std::size_t k = 0; k < 3; ++k)
    is_short = is_short && is_within(whole.origin[k], most_bits) && is_within(whole.direction[k], most_bits);
  if (!is_short) return std::nullopt;
  Small small;
  for (std::size_t k = 0; k < 3; ++k) {
    small.origin[k] = whole.origin[k].get_si();
    small.direction[k] = whole.direction[k].get_si();
  }
  small.weight = whole.weight.get_si();
  return small;
}

// ---- Pieces

Rational Whole_ray::parameter(std::uint32_t piece) {
  const Whole& w = whole();
  const std::array<Integer, 4> h = scene_.predicates().coefficients(scene_.pieces()[piece].support);
  const Integer value = h[0] * w.origin[0] + h[1] * w.origin[1] + h[2] * w.origin[2] + h[3] * w.weight;
  const Integer slope = h[0] * w.direction[0] + h[1] * w.direction[1] + h[2] * w.direction[2];
  Rational t(-value * w.denominator, slope * w.weight);
  t.canonicalize();
  return t;
}

template <class Product, class Number, class Place>
std::optional<Met_border> Whole_ray::crosses_in(std::uint32_t piece, const std::array<Number, 3>& direction,
                                                Place place) const {
  const auto from_origin = [&](std::uint32_t point) {
    return std::array<Number, 3>{place(point, 0), place(point, 1), place(point, 2)};
  };
  const std::span<const Piece_corner> corners = scene_.corners(scene_.pieces()[piece]);
  bool left = false, right = false;
  Met_border border;
  std::uint32_t from = corners.back().point;
  std::array<Number, 3> a = from_origin(from);
  for (const Piece_corner& corner : corners) {
    const std::uint32_t to = corner.point;
    std::array<Number, 3> b = from_origin(to);
    Product side = 0;
    for (std::size_t k = 0; k < 3; ++k)
      side += direction[k] * (static_cast<const Product&>(a[(k + 1) % 3]) * b[(k + 2) % 3] -
                              static_cast<const Product&>(a[(k + 2) % 3]) * b[(k + 1) % 3]);
    left = left || side > 0;
    right = right || side < 0;
    if (left && right) return std::nullopt;
    if (side == 0 && !border.is_corner()) {
      border = {std::min(from, to), std::max(from, to)};
      if (is_on_line<Product>(direction, a)) border = {from, from};
      else if (is_on_line<Product>(direction, b)) border = {to, to};
    }
    from = to;
    a = std::move(b);
  }
  return border;
}

std::optional<Met_border> Whole_ray::crosses(std::uint32_t piece) {
  const Grid_points& points = scene_.points();
  if (const std::optional<Small>& s = small())
    return crosses_in<__int128>(piece, s->direction, [&](std::uint32_t point, int k) {
      return s->weight * points.small(point, k) - s->origin[static_cast<std::size_t>(k)];
    });
  const Whole& w = whole();
  return crosses_in<Integer>(piece, w.direction, [&](std::uint32_t point, int k) -> Integer {
    return w.weight * points.integer(point, k) - w.origin[static_cast<std::size_t>(k)];
  });
}

std::optional<Face_hit> Whole_ray::part(std::uint32_t piece) {
  const Whole& w = whole();
  const Piece& its = scene_.pieces()[piece];
  const std::array<Integer, 4> h = scene_.predicates().coefficients(its.support);
  const Integer slope = h[0] * w.direction[0] + h[1] * w.direction[1] + h[2] * w.direction[2];
  if (slope == 0) return part_along(piece, h);
  if (!crosses(piece)) return std::nullopt;
  Rational t = parameter(piece);
  if (t < 0) return std::nullopt;
  return Face_hit{its.face, slope < 0 ? Met_side::front : Met_side::back, t, t};
}

std::optional<Face_hit> Whole_ray::part_along(std::uint32_t piece, const std::array<Integer, 4>& plane) {
  const Whole& w = whole();
  const Integer value = plane[0] * w.origin[0] + plane[1] * w.origin[1] + plane[2] * w.origin[2] + plane[3] * w.weight;
  if (value != 0) return std::nullopt;
  const Piece& its = scene_.pieces()[piece];
  const std::span<const Piece_corner> corners = scene_.corners(its);
  Rational low = 0;
  std::optional<Rational> high;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    // Inside of an edge is where normal x edge is positive.
    const std::uint32_t p = corners[i].point, q = corners[i + 1 == corners.size() ? 0 : i + 1].point;
    std::array<Integer, 3> at, edge;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = scene_.points().integer(p, static_cast<int>(k));
      edge[k] = scene_.points().integer(q, static_cast<int>(k)) - at[k];
    }
    Integer inside = 0, slope = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Integer inwards = plane[(k + 1) % 3] * edge[(k + 2) % 3] - plane[(k + 2) % 3] * edge[(k + 1) % 3];
      inside += inwards * (w.origin[k] - w.weight * at[k]);
      slope += inwards * w.direction[k];
    }
    if (slope == 0) {
      if (inside < 0) return std::nullopt;
      continue;
    }
    Rational t(-inside * w.denominator, slope * w.weight);
    t.canonicalize();
    if (slope > 0) low = std::max(low, t);
    else if (!high || t < *high) high = t;
    if (high && *high < low) return std::nullopt;
  }
  return Face_hit{its.face, Met_side::along, low, *high};  // a piece is bounded
}

}  // namespace sightline
