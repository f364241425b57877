#include <sightline/algorithms/weak_visibility/partition/curve_arrangement.h>

#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/time_limit.h>

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace sightline {
namespace {

using Range = CGAL::Interval_nt<>;

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial c(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  return c;
}

/// a + factor b
Polynomial sum(Polynomial a, const Polynomial& b, long factor) {
  if (a.size() < b.size()) a.resize(b.size());
  for (std::size_t k = 0; k < b.size(); ++k) a[k] += factor * b[k];
  return a;
}

int degree_in_y(const Plane_curve& f) { return sgn(f.c[5]) != 0 ? 2 : sgn(f.c[4]) != 0 || sgn(f.c[2]) != 0 ? 1 : 0; }

/// In x: zero where two curves have a value of y in common. Pre: both of degree 1 or 2 in y.
Polynomial resultant(const Plane_curve& f, const Plane_curve& g) {
  const int df = degree_in_y(f), dg = degree_in_y(g);
  if (df < dg) return resultant(g, f);
  const Polynomial a = f.coefficient(2), b = f.coefficient(1), c = f.coefficient(0), d = g.coefficient(2),
                   e = g.coefficient(1), h = g.coefficient(0);
  if (df == 1) return sum(product(b, h), product(e, c), -1);
  if (dg == 1)  // y = -h / e
    return sum(sum(product(a, product(h, h)), product(b, product(h, e)), -1), product(c, product(e, e)), 1);
  const Polynomial ac = sum(product(a, h), product(d, c), -1), ab = sum(product(a, e), product(d, b), -1),
                   bc = sum(product(b, h), product(e, c), -1);
  return sum(product(ac, ac), product(ab, bc), -1);
}

/// f(x, y) for that y, dyadic, times a positive number.
Polynomial at_height(const Plane_curve& f, const Rational& y) {
  const Integer &n = y.get_num(), &d = y.get_den();
  return {f.c[0] * d * d + f.c[2] * n * d + f.c[5] * n * n, f.c[1] * d * d + f.c[4] * n * d, f.c[3] * d * d};
}

Polynomial discriminant(const Plane_curve& f) {
  const Polynomial b = f.coefficient(1);
  return sum(product(b, b), product(f.coefficient(2), f.coefficient(0)), -4);
}

/// n / 2^shift
Bounded bounded(const Integer& n, long shift) {
  if (sgn(n) == 0) return {0, 0};
  long exponent = 0;
  const double m = mpz_get_d_2exp(&exponent, n.get_mpz_t());  // cut off towards zero
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const int e = static_cast<int>(std::max(exponent - shift, -5000L));
  const double a = std::ldexp(m, e), b = std::ldexp(std::nextafter(m, 2 * m), e);
  return {std::min(a, b) - least, std::max(a, b) + least};
}

Range range(const Bounded& b) { return {b.low, b.high}; }
Bounded bounded(const Range& r) { return {r.inf(), r.sup()}; }

Bounded bounded(Real_root& root) {
  root.refine_to(60);
  return {bounds_of(root.low()).low, bounds_of(root.high()).high};
}

/// The part that both have; the first where that is none, by rounding.
Range common(const Range& a, const Range& b) {
  const double low = std::max(a.inf(), b.inf()), high = std::min(a.sup(), b.sup());
  return low <= high ? Range(low, high) : a;
}

/// y of a curve's arc over a range of x. `near`: as Curve_arrangement::near_.
Range height(const std::array<Bounded, 9>& near, bool upper, const Range& x) {
  const auto n = [&](std::size_t k) { return range(near[k]); };
  const Range a = n(0), b = n(1) + n(2) * x, c = n(3) + x * (n(4) + x * n(5));
  if (near[0].low == 0 && near[0].high == 0) return -c / b;
  const Range d = n(6) + x * (n(7) + x * n(8));
  const Range root = CGAL::sqrt(Range(std::max(d.inf(), 0.0), std::max(d.sup(), 0.0)));
  const Range top = upper ? -b + root : -b - root;  // a is positive
  const Range first = top / (Range(2) * a), other = upper ? -b - root : -b + root;
  return other.inf() > 0 || other.sup() < 0 ? common(first, Range(2) * c / other) : first;
}

/// The integral of an arc, which is convex or concave: between that of chords and that of tangents.
Range integral(const std::array<Bounded, 9>& near, bool upper, double a, double b, const Range& at_a, const Range& at_b,
               int depth) {
  constexpr double tolerance = 0x1p-30;
  const double m = a + (b - a) / 2;
  // m is rounded; the middle is next to it.
  const Range width = Range(b) - Range(a),
              at_m = height(near, upper, Range(std::nextafter(m, a), std::nextafter(m, b)));
  const Range chord = width * (at_a + at_b) / Range(2), tangent = width * at_m;
  const double low = std::min(chord.inf(), tangent.inf()), high = std::max(chord.sup(), tangent.sup());
  if (depth == 0 || !(a < m && m < b) || high - low <= tolerance * (b - a)) return {low, high};
  return integral(near, upper, a, m, at_a, at_m, depth - 1) + integral(near, upper, m, b, at_m, at_b, depth - 1);
}

}  // namespace

Bounded bounds_of(const Rational& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double nearest = nearest_double(x);
  if (exact(nearest) == x) return {nearest, nearest};
  return {std::nextafter(nearest, -infinity), std::nextafter(nearest, infinity)};
}

bool may_meet(const Plane_curve& curve, const Chart_box& box) {
  const std::array<double, 6> c = in_proportion(curve.c);  // each within 2^-52
  const double x = (box.x0 + box.x1) / 2, y = (box.y0 + box.y1) / 2, w = (box.x1 - box.x0) / 2,
               h = (box.y1 - box.y0) / 2;
  const double middle = c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y;
  const double reach = std::fabs(c[1] + 2 * c[3] * x + c[4] * y) * w + std::fabs(c[2] + c[4] * x + 2 * c[5] * y) * h +
                       std::fabs(c[3]) * w * w + std::fabs(c[4]) * w * h + std::fabs(c[5]) * h * h;
  return !(std::fabs(middle) > reach + 0x1p-44);
}

Curve_arrangement::Curve_arrangement(std::span<const Plane_curve> curves, const Chart_box& box,
                                     const std::function<bool()>& out_of_time)
    : box_(box) {
  const Rational x0 = exact(box.x0), x1 = exact(box.x1), y0 = exact(box.y0), y1 = exact(box.y1);

  // 1. Where the order of curves may change.
  std::vector<Real_root> roots{Real_root(x0), Real_root(x1)};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Plane_curve& f = curves[i];
    const int degree = degree_in_y(f);
    append_real_roots(degree == 2 ? discriminant(f) : f.coefficient(degree), x0, x1, roots);
    if (degree == 0) continue;
    append_real_roots(at_height(f, y0), x0, x1, roots);
    append_real_roots(at_height(f, y1), x0, x1, roots);
    for (std::size_t j = 0; j < i; ++j) {
      if (has_run_out(out_of_time)) return;
      if (degree_in_y(curves[j]) > 0) append_real_roots(resultant(f, curves[j]), x0, x1, roots);
    }
  }
  if (!sort_distinct(roots, out_of_time)) return;

  // 2. What the curves are between.
  constexpr std::size_t asked_after = 64;  // slabs, each with a root of each curve
  std::vector<std::uint32_t> all(curves.size());
  std::iota(all.begin(), all.end(), 0u);
  for (std::size_t k = 0; k + 1 < roots.size(); ++k) {
    if (k % asked_after == asked_after - 1 && has_run_out(out_of_time)) {
      slabs_.clear();
      return;
    }
    slabs_.push_back(slab_of(curves, all, between(roots[k], roots[k + 1])));
  }
  keep_doubles(curves, roots);
}

Curve_arrangement::Curve_arrangement(std::span<const Plane_curve> curves, const Chart_box& box,
                                     std::span<const Stretch> stretches, std::span<const Rational> uprights)
    : box_(box) {
  std::vector<Rational> limits{exact(box.x0), exact(box.x1)};
  limits.insert(limits.end(), uprights.begin(), uprights.end());
  for (const Stretch& stretch : stretches) limits.insert(limits.end(), {stretch.from, stretch.to});
  std::sort(limits.begin(), limits.end());
  limits.erase(std::unique(limits.begin(), limits.end()), limits.end());

  // 1. The stretches over each slab.
  const auto slab_from = [&](const Rational& x) {
    return static_cast<std::size_t>(std::lower_bound(limits.begin(), limits.end(), x) - limits.begin());
  };
  std::vector<std::vector<std::uint32_t>> active(limits.size() - 1);
  for (const Stretch& stretch : stretches)
    for (std::size_t k = slab_from(stretch.from); k < slab_from(stretch.to); ++k) active[k].push_back(stretch.curve);

  // 2. What they are between.
  std::vector<Real_root> roots;
  for (const Rational& x : limits) roots.emplace_back(x);
  for (std::size_t k = 0; k + 1 < roots.size(); ++k)
    slabs_.push_back(slab_of(curves, active[k], between(roots[k], roots[k + 1])));
  keep_doubles(curves, roots);
}

/// What those curves are between at a place that none of them is upright at, and where no two of them meet.
Curve_arrangement::Slab Curve_arrangement::slab_of(std::span<const Plane_curve> curves,
                                                   std::span<const std::uint32_t> active, Rational x) const {
  const Rational y0 = exact(box_.y0), y1 = exact(box_.y1);
  const Quadratic_root bottom(y0.get_num(), 0, Integer(0), y0.get_den()),
      top(y1.get_num(), 0, Integer(0), y1.get_den());
  Slab slab;
  slab.x = std::move(x);
  std::vector<std::pair<Quadratic_root, Arc>> crossings;
  for (const std::uint32_t i : active)
    for (const bool upper : {false, true}) {
      std::optional<Quadratic_root> y = curves[i].height(slab.x, upper);
      if (y && bottom < *y && *y < top) crossings.emplace_back(std::move(*y), Arc{i, upper});
    }
  std::sort(crossings.begin(), crossings.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  const Quadratic_root* below = &bottom;
  for (const auto& [y, arc] : crossings) {
    slab.y.push_back(inner_rational({*below, y}));
    slab.arcs.push_back(arc);
    below = &y;
  }
  slab.y.push_back(inner_rational({*below, top}));
  return slab;
}

void Curve_arrangement::keep_doubles(std::span<const Plane_curve> curves, std::vector<Real_root>& roots) {
  for (Real_root& root : roots) limits_.push_back(bounded(root));
  for (const Plane_curve& f : curves) {
    std::size_t most = 0;
    for (const Integer& c : f.c) most = std::max(most, bit_length(c));
    const auto shift = static_cast<long>(most);
    Polynomial square = discriminant(f);
    square.resize(3);
    near_.push_back({bounded(f.c[5], shift), bounded(f.c[2], shift), bounded(f.c[4], shift), bounded(f.c[0], shift),
                     bounded(f.c[1], shift), bounded(f.c[3], shift), bounded(square[0], 2 * shift),
                     bounded(square[1], 2 * shift), bounded(square[2], 2 * shift)});
  }
}

Bounded Curve_arrangement::value(const Arc& arc, std::size_t limit) const {
  const Range y = height(near_[arc.curve], arc.upper, range(limits_[limit]));
  return {std::max(y.inf(), box_.y0), std::min(y.sup(), box_.y1)};
}

double Curve_arrangement::near(const Arc& arc, double x) const {
  const Range y = height(near_[arc.curve], arc.upper, Range(x));
  return std::clamp((std::max(y.inf(), box_.y0) + std::min(y.sup(), box_.y1)) / 2, box_.y0, box_.y1);
}

Bounded Curve_arrangement::area_below(const Arc& arc, std::size_t slab, int halvings) const {
  const Range box(box_.y0, box_.y1), from = range(limits_[slab]), to = range(limits_[slab + 1]);
  const double a = from.sup(), b = to.inf();
  if (!(a < b)) return bounded(common(to - from, Range(0, 1)) * box);
  const std::array<Bounded, 9>& near = near_[arc.curve];
  const auto at = [&](double x) { return common(box, height(near, arc.upper, Range(x))); };
  const Range inner = integral(near, arc.upper, a, b, at(a), at(b), halvings);
  // What the limits' bounds leave out.
  return bounded(inner + (Range(a) - from) * box + (to - Range(b)) * box);
}

}  // namespace sightline
