#include <sightline/algorithms/weak_visibility/partition/plane_chart.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sightline {
namespace {

/// Pre: not negative. Whether it is a square, and of what.
bool is_square(const Integer& n, Integer& root) {
  if (mpz_perfect_square_p(n.get_mpz_t()) == 0) return false;
  mpz_sqrt(root.get_mpz_t(), n.get_mpz_t());
  return true;
}

constexpr long few_bits = 3;

Integer floor_of(const Rational& x) {
  Integer floor;
  mpz_fdiv_q(floor.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
  return floor;
}

/// k with 2^k less than a range's width. Pre: it has one.
long power_below(const std::array<Rational, 2>& range) {
  const Rational width = range[1] - range[0];
  return static_cast<long>(bit_length(width.get_num())) - static_cast<long>(bit_length(width.get_den())) - 1;
}

Rational area(const std::vector<std::array<Rational, 2>>& corners) {
  Rational twice = 0;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const auto &p = corners[n], &q = corners[(n + 1) % corners.size()];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return abs(twice) / 2;
}

/// The line a x + b y + c = 0.
Plane_curve canonical_line(const Integer& c, const Integer& a, const Integer& b) {
  Plane_curve line{{c, a, b, 0, 0, 0}};
  make_canonical(line.c);
  return line;
}

/// Of c0 + c1 x + c2 x^2, c2 != 0, in which y does not occur.
std::vector<Plane_curve> upright_lines(const Plane_curve& curve) {
  const Integer &c0 = curve.c[0], &c1 = curve.c[1], &c2 = curve.c[3], d = c1 * c1 - 4 * c2 * c0;
  Integer root;
  if (sgn(d) < 0) return {};
  if (!is_square(d, root)) return {curve};
  std::vector<Plane_curve> lines{canonical_line(c1 - root, 2 * c2, 0)};
  if (sgn(d) > 0) lines.push_back(canonical_line(c1 + root, 2 * c2, 0));
  return lines;
}

}  // namespace

int Plane_curve::sign(const Rational& x, const Rational& y) const {
  const Integer &n = x.get_num(), &d = x.get_den(), &m = y.get_num(), &e = y.get_den();
  // times d^2 e^2
  const Integer nd = n * d, me = m * e, dd = d * d, ee = e * e;
  return sgn(Integer(ee * (c[0] * dd + c[1] * nd + c[3] * n * n) + me * (c[2] * dd + c[4] * nd) + c[5] * m * m * dd));
}

Polynomial Plane_curve::coefficient(int power) const {
  return power == 0 ? Polynomial{c[0], c[1], c[3]} : power == 1 ? Polynomial{c[2], c[4]} : Polynomial{c[5]};
}

std::optional<Quadratic_root> Plane_curve::height(const Rational& x, bool upper) const {
  const Integer &n = x.get_num(), &d = x.get_den();
  const Integer a = c[5] * d * d, b = (c[2] * d + c[4] * n) * d, e = (c[0] * d + c[1] * n) * d + c[3] * n * n;
  if (sgn(a) == 0) {
    if (sgn(b) == 0 || upper) return std::nullopt;
    return Quadratic_root(Integer(-e), 0, Integer(0), b);
  }
  const Integer square = b * b - 4 * a * e;
  if (sgn(square) < 0) return std::nullopt;
  return Quadratic_root(Integer(-b), upper ? 1 : -1, square, Integer(2 * a));  // a > 0
}

std::vector<Plane_curve> components(const Plane_curve& given) {
  Plane_curve curve = given;
  if (all_zero(curve.c)) return {};
  make_canonical(curve.c);
  const auto& [one, x, y, xx, xy, yy] = curve.c;
  if (curve.is_line()) return sgn(x) == 0 && sgn(y) == 0 ? std::vector<Plane_curve>{} : std::vector{curve};
  if (sgn(yy) == 0) {
    if (sgn(xy) == 0 && sgn(y) == 0) return upright_lines(curve);
    if (sgn(xy) == 0) return {curve};  // a parabola
    // (xy x + y) y + one + x x + xx x^2: where the first factor divides the rest
    if (sgn(Integer(one * xy * xy - x * y * xy + xx * y * y)) != 0) return {curve};
    // The other factor is y + (xx / xy) x + (x xy - xx y) / xy^2.
    return {canonical_line(y, xy, 0), canonical_line(x * xy - xx * y, xx * xy, xy * xy)};
  }
  // y = (-(y + xy x) +- sqrt(d2 x^2 + d1 x + d0)) / (2 yy)
  const Integer d2 = xy * xy - 4 * yy * xx, d1 = 2 * (xy * y - 2 * yy * x), d0 = y * y - 4 * yy * one;
  if (const int roots = cmp(d1 * d1, Integer(4 * d2 * d0)); roots != 0)
    return roots < 0 && sgn(d2) < 0 ? std::vector<Plane_curve>{} : std::vector{curve};
  Integer root;
  if (sgn(d2) != 0) {  // d2 (x + d1 / (2 d2))^2
    if (sgn(d2) < 0) return {};
    if (!is_square(d2, root)) return {curve};
    return {canonical_line(2 * d2 * y - root * d1, 2 * d2 * (xy - root), 4 * d2 * yy),
            canonical_line(2 * d2 * y + root * d1, 2 * d2 * (xy + root), 4 * d2 * yy)};
  }
  if (sgn(d0) < 0) return {};
  if (!is_square(d0, root)) return {curve};
  std::vector<Plane_curve> lines{canonical_line(y - root, xy, 2 * yy)};
  if (sgn(root) > 0) lines.push_back(canonical_line(y + root, xy, 2 * yy));
  return lines;
}

Plane_chart::Plane_chart(const Near_frame& frame, const Near_polygon& polygon, const Near_plane& plane) {
  k_ = 0;
  for (const std::size_t k : {1, 2})
    if (abs(plane.exact[k]) > abs(plane.exact[k_])) k_ = k;
  i_ = (k_ + 1) % 3;
  j_ = (k_ + 2) % 3;
  // 1. The least box of whole numbers around the polygon, or one that leans.
  std::vector<std::array<Rational, 2>> corners;
  for (const Near_point& corner : polygon) corners.push_back(place(corner.exact));
  for (std::size_t a = 0; a < 2; ++a) set_range(a, corners, 0);
  const Rational share = area(corners) / (wide_[0] * wide_[1]);
  constexpr int sliver = 20;
  if (times_power(share, sliver) < 1) lean(corners);
  for (std::size_t a = 0; a < 2; ++a) {
    near_low_[a] = frame.near(low_[a].get_num(), low_[a].get_den());
    near_wide_[a] = frame.near(wide_[a].get_num(), wide_[a].get_den());
  }
  near_slope_ = slope_.get_d();
  // 2. Its corner and its sides in space, over a common denominator.
  std::array<std::array<Rational, 2>, 2> sides{{{wide_[0], 0}, {0, wide_[1]}}};
  sides[along_][1 - along_] = slope_ * wide_[along_];
  Integer all = lcm(low_[0].get_den(), low_[1].get_den());
  for (const auto& side : sides)
    for (const Rational& x : side) all = lcm(all, x.get_den());
  const int sign = sgn(plane.exact[k_]);
  const auto& h = plane.exact;
  const auto set = [&](Homogeneous& p, const std::array<Rational, 2>& at, const Integer& w) {
    const Integer x = at[0].get_num() * (all / at[0].get_den()), y = at[1].get_num() * (all / at[1].get_den());
    p[i_] = sign * h[k_] * x;
    p[j_] = sign * h[k_] * y;
    p[k_] = -sign * (h[i_] * x + h[j_] * y + h[3] * w);
    p[3] = sign * h[k_] * w;
  };
  set(zero_, low_, all);
  set(x_, sides[0], 0);
  set(y_, sides[1], 0);
  near_plane_ = near(plane);
}

/// The least range of multiples of 2^power that holds a coordinate of all corners, along a lean box's own axes.
void Plane_chart::set_range(std::size_t axis, const Corners& corners, long power) {
  const auto [low, high] = range_of(axis, corners);
  low_[axis] = times_power(Rational(floor_of(times_power(low, -power))), power);
  wide_[axis] = times_power(Rational(-floor_of(times_power(-high, -power))), power) - low_[axis];
}

std::array<Rational, 2> Plane_chart::range_of(std::size_t axis, const Corners& corners) const {
  std::array<Rational, 2> range;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    Rational x = corners[n][axis];
    if (axis != along_ && sgn(slope_) != 0) x -= slope_ * (corners[n][along_] - low_[along_]);
    if (n == 0 || x < range[0]) range[0] = x;
    if (n == 0 || x > range[1]) range[1] = x;
  }
  return range;
}

/// Turns the box's sides across its longer way so that a sliver fills some of it.
void Plane_chart::lean(const Corners& corners) {
  // 1. The way from one corner to another that is longest in the box.
  std::array<double, 2> way{0, 0};
  std::array<Rational, 2> longest;
  for (std::size_t n = 0; n < corners.size(); ++n)
    for (std::size_t m = 0; m < n; ++m) {
      std::array<double, 2> step;
      for (std::size_t a = 0; a < 2; ++a)
        step[a] = std::fabs(Rational((corners[n][a] - corners[m][a]) / wide_[a]).get_d());
      if (std::max(step[0], step[1]) <= std::max(way[0], way[1])) continue;
      way = step;
      for (std::size_t a = 0; a < 2; ++a) longest[a] = corners[n][a] - corners[m][a];
    }
  along_ = way[0] >= way[1] ? 0 : 1;
  set_range(along_, corners, power_below(range_of(along_, corners)) - few_bits);
  // 2. Its slope and the range beside it, in few bits: what they are rounded by is little beside the sliver's width.
  slope_ = longest[1 - along_] / longest[along_];
  const long width = power_below(range_of(1 - along_, corners));
  const long finest = width - few_bits - static_cast<long>(bit_length(floor_of(wide_[along_]))) - 1;
  slope_ = times_power(Rational(floor_of(times_power(slope_, -finest))), finest);
  set_range(1 - along_, corners, width - few_bits);
}

std::array<Rational, 2> Plane_chart::place(const Homogeneous& p) const {
  std::array<Rational, 2> found{Rational(p[i_], p[3]), Rational(p[j_], p[3])};
  for (Rational& x : found) x.canonicalize();
  return found;
}

Homogeneous Plane_chart::point(const Rational& x, const Rational& y) const {
  const Integer w = lcm(x.get_den(), y.get_den()), a = x.get_num() * (w / x.get_den()),
                b = y.get_num() * (w / y.get_den());
  Homogeneous p;
  Integer common = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    p[k] = w * zero_[k] + a * x_[k] + b * y_[k];
    common = gcd(common, p[k]);
  }
  for (Integer& c : p) c /= common;
  return p;
}

std::array<Rational, 2> Plane_chart::at(const Homogeneous& p) const {
  std::array<Rational, 2> found = place(p);
  if (sgn(slope_) != 0) found[1 - along_] -= slope_ * (found[along_] - low_[along_]);
  for (std::size_t a = 0; a < 2; ++a) found[a] = (found[a] - low_[a]) / wide_[a];
  return found;
}

Plane_curve Plane_chart::trace(const Homogeneous& plane) const {
  return {{dot(plane, zero_), dot(plane, x_), dot(plane, y_), 0, 0, 0}};
}

Plane_curve Plane_chart::trace(const Exact_pluecker& a, const Exact_pluecker& b, const Exact_pluecker& c) const {
  // x is on it where its planes with b and with c meet in a line that meets a.
  const std::array<const Homogeneous*, 3> basis{&zero_, &x_, &y_};
  std::array<Homogeneous, 3> with_b, with_c;
  for (std::size_t n = 0; n < 3; ++n) {
    with_b[n] = join(*basis[n], b);
    with_c[n] = join(*basis[n], c);
  }
  const auto form = [&](std::size_t m, std::size_t n) { return side(meet(with_b[m], with_c[n]), a); };
  return {
      {form(0, 0), form(0, 1) + form(1, 0), form(0, 2) + form(2, 0), form(1, 1), form(1, 2) + form(2, 1), form(2, 2)}};
}

Plane_curve Plane_chart::line(const Homogeneous& p, const Homogeneous& q) const {
  const std::array<Rational, 2> a = at(p), b = at(q);
  const Rational x = a[1] - b[1], y = b[0] - a[0], one = -(x * a[0] + y * a[1]);
  const Integer scale = lcm(lcm(x.get_den(), y.get_den()), one.get_den());
  const auto whole = [&](const Rational& r) { return Integer(r.get_num() * (scale / r.get_den())); };
  return {{whole(one), whole(x), whole(y), 0, 0, 0}};
}

Plane_chart::Bounds Plane_chart::bounds(const std::array<Near<6>, 3>& lines) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Bounds all{-infinity, infinity, -infinity, infinity};
  Bounds found{infinity, -infinity, infinity, -infinity};
  int sign = 0;
  for (const Near<6>& line : lines) {
    const std::array<double, 4>& h = near_plane_.at;
    const std::array<double, 6>& e = line.at;
    const std::array<double, 4> p{h[1] * e[5] - h[2] * e[4] - h[3] * e[0], h[2] * e[3] - h[0] * e[5] - h[3] * e[1],
                                  h[0] * e[4] - h[1] * e[3] - h[3] * e[2], h[0] * e[0] + h[1] * e[1] + h[2] * e[2]};
    const double error = homogeneous_detail::error_of_products(3, near_plane_, line), w = std::fabs(p[3]) - error;
    if (!(w > 0) || (p[3] > 0 ? 1 : -1) * sign < 0) return all;
    sign = p[3] > 0 ? 1 : -1;
    const std::array<double, 2> q{p[i_] / p[3], p[j_] / p[3]};
    const auto is_told = [&](std::size_t a, double& low, double& high) {
      double at = q[a], of_products = 1 + std::fabs(q[a]), of_sums = std::fabs(q[a]) + std::fabs(near_low_[a]);
      if (a != along_ && near_slope_ != 0) {
        const double size = std::fabs(near_slope_);
        at -= near_slope_ * (q[along_] - near_low_[along_]);
        of_products += size * (1 + std::fabs(q[along_]));
        of_sums += size * (std::fabs(q[along_]) + std::fabs(near_low_[along_]));
      }
      const double x = (at - near_low_[a]) / near_wide_[a];
      const double slack =
          1.001 * (error * of_products / w) / near_wide_[a] + 0x1p-48 * of_sums / near_wide_[a] + 0x1p-40;
      low = std::min(low, x - slack);
      high = std::max(high, x + slack);
      return x - slack <= x + slack;  // neither is NaN, as of a width that underflows
    };
    if (!is_told(0, found.x0, found.x1) || !is_told(1, found.y0, found.y1)) return all;
  }
  return found;
}

}  // namespace sightline
