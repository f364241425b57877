#include <sightline/algorithms/solids/winding.h>

#include <sightline/kernel/located_point.h>
#include <sightline/kernel/predicates.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sightline {

namespace {

/// Random numbers that are the same everywhere: a step of splitmix64.
std::uint64_t scrambled(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

/// A point in homogeneous grid coordinates, as predicates take it. Pre: h[3] > 0.
Located_point located_on_grid(const Grid_points& points, const std::array<Integer, 4>& h) {
  Located_point q{h[0], h[1], h[2], h[3], 0, 0, 0, 0};
  const std::array<double*, 3> place{&q.ax, &q.ay, &q.az};
  for (std::size_t k = 0; k < 3; ++k) {
    Rational value(h[k], h[3] * points.divisor());
    value.canonicalize();
    mpq_div_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(points.shift()));
    *place[k] = nearest_double(value);
    q.error = std::max(q.error, std::fabs(*place[k]) * 0x1p-52 + 0x1p-1000);
  }
  return q;
}

/// Vertical: along one axis, which is the one that the fragment's plane is steepest to. Its point is exact from the
/// beginning where doubles do not lead into the fragment, else as soon as they do not suffice.
class Vertical_ray {
 public:
  Vertical_ray(const Operands& operands, const Predicates& predicates, const Solid_fragment& fragment,
               Predicate_counts& counts)
      : operands_(operands), predicates_(predicates), fragment_(fragment), counts_(counts) {
    support_ = operands.pieces()[fragment.piece].support;
    const Prepared_plane h = predicates.prepare(support_);
    const std::array<double, 3> n{std::fabs(h.a), std::fabs(h.b), std::fabs(h.c)};
    axis_ = static_cast<std::size_t>(std::max_element(n.begin(), n.end()) - n.begin());
  }

  /// Moves to another point inside the fragment. The first ones are looked for in doubles.
  void begin(std::uint64_t attempt) {
    if (attempt >= 3 || !begin_near(attempt)) begin_exactly(attempt);
  }

  /// Adds up what is met ahead of the point, by operand; nothing where an edge is met. Ahead is where the end is
  /// nearer.
  std::optional<std::vector<Winding>> ahead(const Box_tree& tree) {
    std::vector<Winding> sums;
    bool generic = true;
    std::array<double, 3> from{at_.ax, at_.ay, at_.az};
    is_upwards_ = tree.is_high(from[axis_], axis_);
    // Not beyond the point: twice its error makes up for the difference's own rounding.
    from[axis_] += is_upwards_ ? -2 * at_.error : 2 * at_.error;
    tree.for_each_along(from, axis_, is_upwards_, [&](std::uint32_t piece) {
      if (!generic) return;
      const Plane plane = operands_.pieces()[piece].support;
      if (plane.id() == support_.id()) return;
      const std::optional<bool> met = meets(piece);
      if (!met) generic = false;
      if (!met || !*met) return;
      // The plane's value falls to 0 on the way if it is met there.
      const Sign here = side(plane);
      if (here == CGAL::ZERO) generic = false;
      const Sign onwards = slope(plane);
      if (here == onwards) return;
      const std::uint32_t operand = operands_.operand_of_piece(piece);
      const auto of_operand =
          std::find_if(sums.begin(), sums.end(), [&](const Winding& w) { return w.operand == operand; });
      if (of_operand == sums.end()) sums.push_back({operand, onwards});
      else of_operand->number += onwards;
    });
    if (!generic) return std::nullopt;
    return sums;
  }

  /// Whether the fragment's front is ahead of it.
  bool front_is_ahead() const { return slope(support_) == CGAL::POSITIVE; }

 private:
  std::size_t u() const { return (axis_ + 1) % 3; }
  std::size_t v() const { return (axis_ + 2) % 3; }

  /// The sign of a plane's value as one goes on.
  Sign slope(Plane plane) const { return is_upwards_ ? slope_upwards(plane) : -slope_upwards(plane); }

  /// The sign of a plane's value as one goes up. Doubles may have lost it to underflow.
  Sign slope_upwards(Plane plane) const {
    const Prepared_plane h = predicates_.prepare(plane);
    const double near = axis_ == 0 ? h.a : axis_ == 1 ? h.b : h.c;
    if (near != 0) return sign_of(near);
    const int exactly = sgn(operands_.planes().integer(plane.id(), static_cast<int>(axis_)));
    return static_cast<Sign>(plane.flipped() ? -exactly : exactly);
  }

  Sign side(Plane plane) {
    if (const CGAL::Uncertain<Sign> sign = predicates_.side_filtered(at_, plane); CGAL::is_certain(sign)) {
      ++counts_.filtered;
      return sign.inf();
    }
    find_exactly();
    return predicates_.side(at_, plane, counts_);
  }

  /// A mean of the corners in doubles, brought to the plane along the axis: whether it is inside. Proof of the bound:
  /// P-112
  bool begin_near(std::uint64_t attempt) {
    double weights = 0, x = 0, y = 0;
    for (std::size_t k = 0; k < fragment_.corners.size(); ++k) {
      const Vertex& vertex = fragment_.corners[k].vertex;
      if (!(vertex.error < 1e300)) return false;
      const std::array<double, 3> p{vertex.x, vertex.y, vertex.z};
      const double weight = 1 + static_cast<double>(scrambled(fragment_.piece * 64 + attempt * 16 + k) >> 11) * 0x1p-53;
      weights += weight;
      x += weight * p[u()];
      y += weight * p[v()];
    }
    const double s = x / weights, t = y / weights;
    const Prepared_plane plane = predicates_.prepare(support_);
    const std::array<double, 3> h{plane.a, plane.b, plane.c};
    const double height = -(h[u()] * s + h[v()] * t + plane.d) / h[axis_];
    const double size = std::fabs(h[u()] * s) + std::fabs(h[v()] * t) + std::fabs(plane.d);
    const std::array<double*, 3> place{&at_.ax, &at_.ay, &at_.az};
    *place[u()] = s;
    *place[v()] = t;
    *place[axis_] = height;
    at_.error = (0x1p-49 * size + 0x1p-1000 * (1 + std::fabs(s) + std::fabs(t))) / std::fabs(h[axis_]);
    beside_ = 0;
    is_exact_ = false;
    return std::all_of(fragment_.corners.begin(), fragment_.corners.end(),
                       [&](const Fragment_corner& corner) { return side(corner.edge) == CGAL::POSITIVE; });
  }

  /// The point that begin_near() has doubles of: on the line along the axis that these name, in the plane.
  void find_exactly() {
    if (is_exact_) return;
    is_exact_ = true;
    const std::array<double, 3> near{at_.ax, at_.ay, at_.az};
    const auto on_grid = [&](double value) {
      Rational at = exact(value) * operands_.points().divisor();
      mpq_mul_2exp(at.get_mpq_t(), at.get_mpq_t(), static_cast<mp_bitcnt_t>(operands_.points().shift()));
      return at;
    };
    const Rational s = on_grid(near[u()]), t = on_grid(near[v()]);
    const Integer common = lcm(s.get_den(), t.get_den());
    const std::array<Integer, 4> h = predicates_.coefficients(support_);
    std::array<Integer, 4> point;
    point[u()] = s.get_num() * (common / s.get_den());
    point[v()] = t.get_num() * (common / t.get_den());
    point[axis_] = -(h[u()] * point[u()] + h[v()] * point[v()] + h[3] * common);
    point[u()] *= h[axis_];
    point[v()] *= h[axis_];
    point[3] = common * h[axis_];
    if (sgn(point[3]) < 0)
      for (Integer& n : point) n = -n;
    at_.x = std::move(point[0]);
    at_.y = std::move(point[1]);
    at_.z = std::move(point[2]);
    at_.w = std::move(point[3]);
  }

  /// A mean of three corners, exactly.
  void begin_exactly(std::uint64_t attempt) {
    const std::size_t size = fragment_.corners.size();
    std::array<std::array<Integer, 4>, 3> corner;
    std::array<Integer, 3> weight;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = predicates_.homogeneous(fragment_.corners[k * size / 3].vertex);
      const std::uint64_t dice = scrambled(fragment_.piece + 977 * attempt + k) >> 40;
      weight[k] = static_cast<unsigned long>(dice % (7 + attempt * attempt) + 1);
    }
    std::array<Integer, 4> sum;
    for (std::size_t k = 0; k < 3; ++k) {
      const Integer scale = weight[k] * corner[(k + 1) % 3][3] * corner[(k + 2) % 3][3];
      for (std::size_t i = 0; i < 4; ++i) sum[i] += corner[k][i] * scale;
    }
    at_ = located_on_grid(operands_.points(), sum);
    beside_ = at_.error;
    is_exact_ = true;
  }

  /// Whether the ray's line meets a piece: strictly inside, or not at all, or, nothing, on its boundary.
  std::optional<bool> meets(std::uint32_t piece) {
    bool left = false, right = false, on = false;
    const std::span<const Piece_corner> corners = operands_.corners(piece);
    for (std::size_t k = 0; k < corners.size() && !(left && right); ++k) {
      const int turn = turn_of(corners[k].point, corners[k + 1 == corners.size() ? 0 : k + 1].point);
      left |= turn > 0;
      right |= turn < 0;
      on |= turn == 0;
    }
    if (left && right) return false;
    if (on) return std::nullopt;
    return true;
  }

  /// The turn from p over q to the ray, seen along the axis. Proof of the bound: P-112
  int turn_of(std::uint32_t p, std::uint32_t q) {
    const Grid_points& points = operands_.points();
    const auto error_of = [&](std::uint32_t point, std::size_t k) {
      return points.is_exact(point, static_cast<int>(k)) ? 0.0 : 0x1p-53 * points.range() + 0x1p-1000;
    };
    const std::array<double, 3> at{at_.ax, at_.ay, at_.az};
    const auto from_ray = [&](std::uint32_t point, std::size_t k) {
      return points.approximate(point, static_cast<int>(k)) - at[k];
    };
    const double a = from_ray(p, u()), b = from_ray(p, v()), c = from_ray(q, u()), d = from_ray(q, v());
    const double error = beside_ + std::max({error_of(p, u()), error_of(p, v()), error_of(q, u()), error_of(q, v())});
    const double value = a * d - b * c;
    const double size = std::fabs(a) + std::fabs(b) + std::fabs(c) + std::fabs(d);
    const double bound = 0x1p-50 * (std::fabs(a * d) + std::fabs(b * c)) + 4 * error * (size + 2 * error) + 0x1p-1000;
    if (std::fabs(value) > bound) {
      ++counts_.filtered;
      return value > 0 ? 1 : -1;
    }
    ++counts_.gmp;
    find_exactly();
    const std::array<const Integer*, 3> ray{&at_.x, &at_.y, &at_.z};
    const auto exactly = [&](std::uint32_t point, std::size_t k) -> Integer {
      return points.integer(point, static_cast<int>(k)) * at_.w - *ray[k];
    };
    return sgn(Integer(exactly(p, u()) * exactly(q, v()) - exactly(p, v()) * exactly(q, u())));
  }

  const Operands& operands_;
  const Predicates& predicates_;
  const Solid_fragment& fragment_;
  Predicate_counts& counts_;
  Plane support_;
  std::size_t axis_ = 0;
  Located_point at_{};
  bool is_upwards_ = true;
  bool is_exact_ = false;  // at_, and not only its doubles
  double beside_ = 0;      // how far these may be from the ray's line
};

void add_to(Windings& windings, std::uint32_t operand, int step) {
  const auto at = std::lower_bound(windings.begin(), windings.end(), operand,
                                   [](const Winding& w, std::uint32_t o) { return w.operand < o; });
  if (at == windings.end() || at->operand != operand) windings.insert(at, {operand, step});
  else if (at->number += step; at->number == 0) windings.erase(at);
}

}  // namespace

Fragment_sides sides_of(const Operands& operands, const Predicates& predicates, const Box_tree& tree,
                        const Solid_fragment& fragment, Predicate_counts& counts) {
  // 1. Ahead of it, far enough from all edges.
  Vertical_ray ray(operands, predicates, fragment, counts);
  std::optional<Windings> ahead;
  for (std::uint64_t attempt = 0; !ahead; ++attempt) {
    ray.begin(attempt);
    ahead = ray.ahead(tree);
  }
  Fragment_sides sides;
  for (const Winding& w : *ahead)
    if (w.number != 0) add_to(sides.front, w.operand, w.number);

  // 2. Across it: behind a front that looks out one is wound round once more.
  const Plane support = operands.pieces()[fragment.piece].support;
  sides.behind = sides.front;
  Windings& across = ray.front_is_ahead() ? sides.behind : sides.front;
  const int step = ray.front_is_ahead() ? 1 : -1;
  add_to(across, operands.operand_of_piece(fragment.piece), step);
  for (const std::uint32_t other : fragment.upon)
    add_to(across, operands.operand_of_piece(other), operands.pieces()[other].support == support ? step : -step);
  return sides;
}

}  // namespace sightline
