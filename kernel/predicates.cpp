#include <sightline/kernel/predicates.h>

#include <type_traits>

namespace sightline {

namespace {

template <int L>
int signum(const Fixed_integer<L>& n) {
  return n.sign();
}
int signum(const Integer& n) { return sgn(n); }

}  // namespace

// ---- Coefficients and coordinates in an exact type of numbers

template <class Number>
Number Predicates::coordinate(std::uint32_t point, int axis) const {
  if constexpr (std::is_same_v<Number, Integer>) return points_->integer(point, axis);
  else return Number(points_->coordinate(point, axis), points_->limbs());
}

template <class Number>
Predicates::Row<Number> Predicates::row(std::uint32_t id) const {
  const Plane plane(id, false);
  if (plane.is_axis_plane()) {
    const auto unit = [&](int k) { return Number(std::int64_t{plane.axis() == k}); };
    return {unit(0), unit(1), unit(2), Number(std::int64_t{0}) - coordinate<Number>(plane.axis_point(), plane.axis())};
  }
  if constexpr (std::is_same_v<Number, Integer>) {
    return {planes_->integer(id, 0), planes_->integer(id, 1), planes_->integer(id, 2), planes_->integer(id, 3)};
  } else {
    const auto entry = [&](int k) {
      return Number(planes_->coefficient(id, k), k == 3 ? planes_->offset_limbs() : planes_->normal_limbs());
    };
    return {entry(0), entry(1), entry(2), entry(3)};
  }
}

/// Laplace expansion along two pairs of rows: 30 products.
template <class Number>
Number Predicates::determinant(const Row<Number>& p, const Row<Number>& q, const Row<Number>& r, const Row<Number>& s) {
  const auto minor = [](const Row<Number>& f, const Row<Number>& g, std::size_t i, std::size_t j) -> Number {
    return f[i] * g[j] - f[j] * g[i];
  };
  const Number upper01 = minor(p, q, 0, 1), upper02 = minor(p, q, 0, 2), upper03 = minor(p, q, 0, 3);
  const Number upper12 = minor(p, q, 1, 2), upper13 = minor(p, q, 1, 3), upper23 = minor(p, q, 2, 3);
  return upper01 * minor(r, s, 2, 3) - upper02 * minor(r, s, 1, 3) + upper03 * minor(r, s, 1, 2) +
         upper12 * minor(r, s, 0, 3) - upper13 * minor(r, s, 0, 2) + upper23 * minor(r, s, 0, 1);
}

// ---- Constructions and stages

Vertex Predicates::meet(std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t fourth) const {
  const Approximate_plane f = approximate(p), g = approximate(q), h = approximate(r);
  // Cofactors of the last row of (f; g; h; .): the homogeneous coordinates of the meet.
  const double bc = g.b * h.c - g.c * h.b, ca = g.c * h.a - g.a * h.c, ab = g.a * h.b - g.b * h.a;
  const double ad = g.a * h.d - g.d * h.a, bd = g.b * h.d - g.d * h.b, cd = g.c * h.d - g.d * h.c;
  double w = f.a * bc + f.b * ca + f.c * ab;
  double x = f.c * bd - f.b * cd - f.d * bc;
  double y = f.a * cd - f.c * ad - f.d * ca;
  double z = f.b * ad - f.a * bd - f.d * ab;
  // Every one of them is a sum of six products of three entries, bounded by the largest normal entries n and the
  // offsets.
  const double nf = largest(f), ng = largest(g), nh = largest(h);
  const double size_w = 6 * nf * ng * nh;
  const double size_x = 2 * (std::fabs(f.d) * ng * nh + nf * (std::fabs(g.d) * nh + ng * std::fabs(h.d)));
  // Entries carry a relative 2^-52 each, products and sums 2^-53 a step: below 16 x 2^-53 of the size. P-04
  const double error_w = 0x1p-49 * size_w, error_x = 0x1p-49 * size_x + underflow_ * size_w;
  Vertex v{0, 0, 0, std::numeric_limits<double>::infinity(), {p, q, r}, Vertex::with_plane(fourth)};
  const bool integers =
      f.exact && g.exact && h.exact && size_w < 0x1p53 && size_x < 0x1p53;  // then nothing was rounded
  if (integers ? w == 0 : !(std::fabs(w) > 2 * error_w)) {                  // also where w is not a number
    const int orientation = integers ? 0 : orientation_exact(p, q, r);
    if (orientation == 0) throw std::domain_error("three planes without a common point");
    if (orientation < 0) std::swap(v.plane[1], v.plane[2]);
    return v;
  }
  if (w < 0) std::swap(v.plane[1], v.plane[2]);
  v.x = x / w;
  v.y = y / w;
  v.z = z / w;
  const double reach = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (integers) {
    const bool grid_point = std::rint(v.x) * w == x && std::rint(v.y) * w == y && std::rint(v.z) * w == z;
    v.error = grid_point ? 0.0 : 0x1p-52 * reach;
  } else {
    // |X/W - x/w| <= (error_x + |x/w| error_w) / (|w| - error_w), and the division's own rounding; the factor is for
    // rounding of this line.
    v.error = ((error_x + reach * error_w) / (std::fabs(w) - error_w) + 0x1p-52 * reach) * (1 + 0x1p-20);
  }
  // Outside what Prepared_plane::bound covers, or not a number. Numbers all the same, so that no comparison need
  // mind.
  if (!(reach <= 2 * range_ && v.error < std::numeric_limits<double>::infinity())) {
    v.x = v.y = v.z = 0;
    v.error = std::numeric_limits<double>::infinity();
  }
  return v;
}

template <class Number>
Sign Predicates::side_exact(const Vertex& v, Plane plane) const {
  int sign = 0;
  if (v.is_input() && plane.is_axis_plane()) {
    sign = signum(
        Number(coordinate<Number>(v.point, plane.axis()) - coordinate<Number>(plane.axis_point(), plane.axis())));
  } else if (const Row<Number> h = row<Number>(plane.id()); v.is_input()) {
    Number value = h[3];
    for (int k = 0; k < 3; ++k) value = value + h[static_cast<std::size_t>(k)] * coordinate<Number>(v.point, k);
    sign = signum(value);
  } else {
    sign = signum(determinant<Number>(row<Number>(v.plane[0]), row<Number>(v.plane[1]), row<Number>(v.plane[2]), h));
  }
  return static_cast<Sign>(plane.flipped() ? -sign : sign);
}

CGAL::Uncertain<Sign> Predicates::side_fixed(const Vertex& v, Plane plane) const {
  switch (arithmetic_) {
    case Arithmetic::bits128: return side_exact<Fixed_integer<2>>(v, plane);
    case Arithmetic::bits256: return side_exact<Fixed_integer<4>>(v, plane);
    case Arithmetic::bits512: return side_exact<Fixed_integer<8>>(v, plane);
    case Arithmetic::gmp: break;
  }
  return CGAL::Uncertain<Sign>::indeterminate();
}

CGAL::Uncertain<Sign> Predicates::side_filtered(const Located_point& q, Plane plane) const {
  const Prepared_plane h = prepare(plane);
  const double value = h.a * q.ax + h.b * q.ay + h.c * q.az + h.d;
  // As in prepare(), but at the point's own distance.
  const double size = std::fabs(h.a * q.ax) + std::fabs(h.b * q.ay) + std::fabs(h.c * q.az) + std::fabs(h.d);
  // The last term is for underflow: the point may be as close to the origin, and the coefficients as unequal, as
  // doubles do not go. P-03
  const double bound =
      0x1p-50 * size + h.norm * q.error + 0x1p-1000 * (1 + std::fabs(q.ax) + std::fabs(q.ay) + std::fabs(q.az));
  if (std::fabs(value) > bound) return sign_of(value);
  return CGAL::Uncertain<Sign>::indeterminate();
}

Sign Predicates::side(const Located_point& q, Plane plane, Predicate_counts& counts) const {
  if (const CGAL::Uncertain<Sign> sign = side_filtered(q, plane); CGAL::is_certain(sign)) {
    ++counts.filtered;
    return sign.inf();
  }
  ++counts.gmp;
  const Row<Integer> f = row<Integer>(plane.id());
  const int sign = sgn(Integer(f[0] * q.x + f[1] * q.y + f[2] * q.z + f[3] * q.w));
  return static_cast<Sign>(plane.flipped() ? -sign : sign);
}

std::array<Integer, 4> Predicates::homogeneous(const Vertex& v) const {
  if (v.is_input())
    return {points_->integer(v.point, 0), points_->integer(v.point, 1), points_->integer(v.point, 2), 1};
  const Row<Integer> f = row<Integer>(v.plane[0]), g = row<Integer>(v.plane[1]), h = row<Integer>(v.plane[2]);
  const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) -> Integer {
    return f[i] * (g[j] * h[k] - g[k] * h[j]) - f[j] * (g[i] * h[k] - g[k] * h[i]) + f[k] * (g[i] * h[j] - g[j] * h[i]);
  };
  return {-minor(1, 2, 3), minor(0, 2, 3), -minor(0, 1, 3), minor(0, 1, 2)};
}

std::array<Integer, 4> Predicates::coefficients(Plane plane) const {
  std::array<Integer, 4> h = row<Integer>(plane.id());
  if (plane.flipped())
    for (Integer& x : h) x = -x;
  return h;
}

Sign Predicates::orientation(Plane p, Plane q, Plane r, Predicate_counts& counts) const {
  const bool flipped = (p.flipped() != q.flipped()) != r.flipped();
  if (p.id() == q.id() || q.id() == r.id() || r.id() == p.id()) {
    ++counts.combinatorial;
    return CGAL::ZERO;
  }
  const Approximate_plane f = approximate(p.id()), g = approximate(q.id()), h = approximate(r.id());
  const double w = f.a * (g.b * h.c - g.c * h.b) + f.b * (g.c * h.a - g.a * h.c) + f.c * (g.a * h.b - g.b * h.a);
  const double size = 6 * largest(f) * largest(g) * largest(h);
  const bool integers = f.exact && g.exact && h.exact && size < 0x1p53;
  int sign;
  if (integers || std::fabs(w) > 0x1p-48 * size) {  // as in meet()
    ++counts.filtered;
    sign = w > 0 ? 1 : w < 0 ? -1 : 0;
  } else {
    ++counts.gmp;
    sign = orientation_exact(p.id(), q.id(), r.id());
  }
  return static_cast<Sign>(flipped ? -sign : sign);
}

int Predicates::orientation_exact(std::uint32_t p, std::uint32_t q, std::uint32_t r) const {
  const Row<Integer> f = row<Integer>(p), g = row<Integer>(q), h = row<Integer>(r);
  return sgn(Integer(f[0] * (g[1] * h[2] - g[2] * h[1]) + f[1] * (g[2] * h[0] - g[0] * h[2]) +
                     f[2] * (g[0] * h[1] - g[1] * h[0])));
}

Sign Predicates::side_unfiltered(const Vertex& v, const Prepared_plane& h, Predicate_counts& counts) const {
  const Plane plane = h.plane;
  if (incident(v, plane.id())) {
    ++counts.combinatorial;
    return CGAL::ZERO;
  }
  if (const CGAL::Uncertain<Sign> sign = side_filtered(v, h); CGAL::is_certain(sign)) {
    ++counts.filtered;
    return sign.inf();
  }
  if (const CGAL::Uncertain<Sign> sign = side_fixed(v, plane); CGAL::is_certain(sign)) {
    ++counts.fixed;
    return sign.inf();
  }
  ++counts.gmp;
  return side_exact<Integer>(v, plane);
}

template Sign Predicates::side_exact<Fixed_integer<2>>(const Vertex&, Plane) const;
template Sign Predicates::side_exact<Fixed_integer<4>>(const Vertex&, Plane) const;
template Sign Predicates::side_exact<Fixed_integer<8>>(const Vertex&, Plane) const;
template Sign Predicates::side_exact<Fixed_integer<16>>(const Vertex&, Plane) const;
template Sign Predicates::side_exact<Integer>(const Vertex&, Plane) const;

}  // namespace sightline
