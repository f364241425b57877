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
  // The least box of whole numbers around the polygon.
  const std::array<std::size_t, 2> axes{i_, j_};
  for (std::size_t a = 0; a < 2; ++a) {
    Integer high;
    for (std::size_t n = 0; n < polygon.size(); ++n) {
      const Integer &p = polygon[n].exact[axes[a]], &w = polygon[n].exact[3];
      Integer floor, ceiling;
      mpz_fdiv_q(floor.get_mpz_t(), p.get_mpz_t(), w.get_mpz_t());
      mpz_cdiv_q(ceiling.get_mpz_t(), p.get_mpz_t(), w.get_mpz_t());
      if (n == 0 || floor < low_[a]) low_[a] = floor;
      if (n == 0 || ceiling > high) high = ceiling;
    }
    wide_[a] = high - low_[a];
    near_low_[a] = frame.near(low_[a], 1);
    near_wide_[a] = frame.near(wide_[a], 1);
  }
  const int sign = sgn(plane.exact[k_]);
  const auto& h = plane.exact;
  const auto set = [&](Homogeneous& p, const Integer& x, const Integer& y, const Integer& w) {
    p[i_] = sign * h[k_] * x;
    p[j_] = sign * h[k_] * y;
    p[k_] = -sign * (h[i_] * x + h[j_] * y + h[3] * w);
    p[3] = sign * h[k_] * w;
  };
  set(zero_, low_[0], low_[1], 1);
  set(x_, wide_[0], 0, 0);
  set(y_, 0, wide_[1], 0);
  near_plane_ = near(plane);
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
  std::array<Rational, 2> found{Rational(p[i_] - low_[0] * p[3], wide_[0] * p[3]),
                                Rational(p[j_] - low_[1] * p[3], wide_[1] * p[3])};
  for (Rational& x : found) x.canonicalize();
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
    const auto is_told = [&](std::size_t axis, std::size_t a, double& low, double& high) {
      const double q = p[axis] / p[3], x = (q - near_low_[a]) / near_wide_[a];
      const double slack = 1.001 * (error * (1 + std::fabs(q)) / w) / near_wide_[a] +
                           0x1p-48 * (std::fabs(q) + std::fabs(near_low_[a])) / near_wide_[a] + 0x1p-40;
      low = std::min(low, x - slack);
      high = std::max(high, x + slack);
      return x - slack <= x + slack;  // neither is NaN, as of a width that underflows
    };
    if (!is_told(i_, 0, found.x0, found.x1) || !is_told(j_, 1, found.y0, found.y1)) return all;
  }
  return found;
}

}  // namespace sightline
