#pragma once
// The exact side of a vertex to a plane, decided by the first stage that can:
//   combinatorial -> double with a derived bound -> fixed width -> GMP.
// Laws, tested under all permutations and at every stage:
//   side(v, h) == -side(v, h.opposite());  side(meet(p, q, r), h) is the same for every order of p, q, r;
//   side(meet(p, q, r), p) == 0;  every stage that decides decides the same.

#include <sightline/kernel/arithmetic.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/vertex.h>

#include <CGAL/Uncertain.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace sightline {

using Sign = CGAL::Sign;  ///< NEGATIVE: behind, ZERO: on, POSITIVE: in front

/// The sign of a double. Pre: a number.
inline Sign sign_of(double value) { return value > 0 ? CGAL::POSITIVE : value < 0 ? CGAL::NEGATIVE : CGAL::ZERO; }

/// How many predicates each stage decided.
struct Predicate_counts {
  std::uint64_t combinatorial = 0, filtered = 0, fixed = 0, gmp = 0;
  /// Each by its key in reports, in their order.
  template <class Visit>
  static void each(Visit visit) {
    visit("combinatorial", &Predicate_counts::combinatorial);
    visit("filtered", &Predicate_counts::filtered);
    visit("fixed", &Predicate_counts::fixed);
    visit("gmp", &Predicate_counts::gmp);
  }
  std::uint64_t total() const { return combinatorial + filtered + fixed + gmp; }
};

/// A plane made ready for many sides: its oriented doubles and the bound below which they decide nothing.
struct Prepared_plane {
  Plane plane;
  bool exact;         ///< integers all through: at exact vertices the double value is the true one
  double a, b, c, d;  ///< oriented
  double norm;        ///< >= |a| + |b| + |c| of the true plane
  double bound;       ///< rounding error of the double value at any vertex, not counting the vertex's own error
};

/// A point that is not of the scene (an eye, a query), in homogeneous grid coordinates.
struct Located_point {
  Integer x, y, z, w;  ///< w > 0
  double ax, ay, az;   ///< approximations of x/w, ... times 2^-shift
  double error;        ///< their absolute error; infinity where doubles say nothing
};

/// The predicates over one scene's points and planes, and what is known of incidences. Cheap to copy: three references
/// and a width.
class Predicates {
 public:
  Predicates(const Grid_points& points, const Plane_table& planes, const Point_planes& incidences)
      : points_(&points),
        planes_(&planes),
        incidences_(&incidences),
        arithmetic_(planes.budget().arithmetic()),
        range_(points.range()),
        underflow_(points.bits() <= 53 ? 0 : 0x1p-1000) {}

  const Grid_points& points() const { return *points_; }
  const Plane_table& planes() const { return *planes_; }
  Arithmetic arithmetic() const { return arithmetic_; }

  // ---- Constructions

  /// An input point as a corner where the three given planes meet.
  Vertex input_vertex(std::uint32_t point, std::uint32_t p, std::uint32_t q, std::uint32_t r) const {
    const bool exact = points_->is_exact(point, 0) && points_->is_exact(point, 1) && points_->is_exact(point, 2);
    const double error =
        exact ? 0.0 : 0x1p-53 * range_ + 0x1p-1000;  // each coordinate is the nearest double, or underflows
    return {points_->approximate(point, 0),
            points_->approximate(point, 1),
            points_->approximate(point, 2),
            error,
            {p, q, r},
            point};
  }

  /// The meet of three planes; `fourth`, where given, is known to pass through it. Pre: their normals are linearly
  /// independent, or std::domain_error. Exact: its position, yes; the doubles beside it are within `error`. Proof: P-04
  Vertex meet(std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t fourth = Vertex::no_plane) const {
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
      const bool grid_point = std::rint(v.x) * w == x && std::rint(v.y) * w == y && std::rint(v.z) * w == z &&
                              std::rint(v.x) == v.x && std::rint(v.y) == v.y && std::rint(v.z) == v.z;
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

  /// A plane made ready for side(). Proof of the bound: P-03
  Prepared_plane prepare(Plane plane) const {
    Approximate_plane f = approximate(plane.id());
    const double sense = 1 - 2 * static_cast<int>(plane.flipped());  // without a branch, which no processor can predict
    f = {sense * f.a, sense * f.b, sense * f.c, sense * f.d, f.exact};
    const double norm = (std::fabs(f.a) + std::fabs(f.b) + std::fabs(f.c)) * (1 + 0x1p-50);
    // The value a x + b y + c z + d: 2^-52 in each coefficient, three products and three sums of 2^-53, at coordinates
    // up to twice the range: below 6 x 2^-53 (norm 2 range + |d|) (1 + 2^-50), so 8 x 2^-53 covers it and the rounding
    // of the bound.
    const double size = norm * (2 * range_) + std::fabs(f.d);
    const bool exact = f.exact && size < 0x1p53;  // all terms and sums are integers below 2^53
    return {plane, exact, f.a, f.b, f.c, f.d, norm, 0x1p-50 * size + underflow_};
  }

  // ---- Stages of side()

  /// Stage 1: whether the plane is one of those that made the vertex, or of a face with a corner there.
  bool incident(const Vertex& v, std::uint32_t plane) const {
    if (v.plane[0] == plane || v.plane[1] == plane || v.plane[2] == plane) return true;
    return v.is_input() ? incidences_->contains(v.point, plane) : v.fourth_plane() == plane;
  }

  /// Stage 2: the sign in doubles where their error bound allows, else uncertain. Proof: P-03
  static CGAL::Uncertain<Sign> side_filtered(const Vertex& v, const Prepared_plane& h) {
    const double value = h.a * v.x + h.b * v.y + h.c * v.z + h.d;
    const double bound = h.bound + v.error * h.norm;
    if (value > bound) return CGAL::POSITIVE;
    if (value < -bound) return CGAL::NEGATIVE;
    if (h.exact && v.error == 0) return sign_of(value);
    return CGAL::Uncertain<Sign>::indeterminate();
  }

  /// Stages 3 and 4: the sign of an exact determinant in the given number type. Pre: Number is wide enough for the
  /// scene. Proof: P-02
  template <class Number>
  Sign side_exact(const Vertex& v, Plane plane) const {
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

  /// Stage 3 at the scene's own width; uncertain where that is GMP.
  CGAL::Uncertain<Sign> side_fixed(const Vertex& v, Plane plane) const {
    switch (arithmetic_) {
      case Arithmetic::bits128: return side_exact<Fixed_integer<2>>(v, plane);
      case Arithmetic::bits256: return side_exact<Fixed_integer<4>>(v, plane);
      case Arithmetic::bits512: return side_exact<Fixed_integer<8>>(v, plane);
      case Arithmetic::gmp: break;
    }
    return CGAL::Uncertain<Sign>::indeterminate();
  }

  /// The side of a vertex to an oriented plane: POSITIVE in front, ZERO on it, NEGATIVE behind.
  /// Degenerate: a vertex on the plane is ZERO, always. Cost: about four multiplications; 0.2 us where doubles cannot
  /// tell. Exact: yes.
  Sign side(const Vertex& v, const Prepared_plane& h, Predicate_counts& counts) const {
    // side_filtered() without a branch on the sign, which no processor can predict.
    const double value = h.a * v.x + h.b * v.y + h.c * v.z + h.d;
    const double bound = h.bound + v.error * h.norm;
    const int sign = int{value > bound} - int{value < -bound};
    if (sign != 0) [[likely]] {
      ++counts.filtered;
      return static_cast<Sign>(sign);
    }
    return side_unfiltered(v, h, counts);
  }

  /// The side of a point that is not of the scene. Exact: filtered, then GMP.
  Sign side(const Located_point& q, Plane plane, Predicate_counts& counts) const {
    const Prepared_plane h = prepare(plane);
    const double value = h.a * q.ax + h.b * q.ay + h.c * q.az + h.d;
    // As in prepare(), but at the point's own distance.
    const double size = std::fabs(h.a * q.ax) + std::fabs(h.b * q.ay) + std::fabs(h.c * q.az) + std::fabs(h.d);
    // The last term is for underflow: the point may be as close to the origin, and the coefficients as unequal, as
    // doubles do not go. P-03
    const double bound =
        0x1p-50 * size + h.norm * q.error + 0x1p-1000 * (1 + std::fabs(q.ax) + std::fabs(q.ay) + std::fabs(q.az));
    if (std::fabs(value) > bound) {
      ++counts.filtered;
      return sign_of(value);
    }
    ++counts.gmp;
    const Row<Integer> f = row<Integer>(plane.id());
    const int sign = sgn(Integer(f[0] * q.x + f[1] * q.y + f[2] * q.z + f[3] * q.w));
    return static_cast<Sign>(plane.flipped() ? -sign : sign);
  }

  // ---- Exact values

  /// A vertex in homogeneous integer grid coordinates (x, y, z, w), w > 0, not reduced.
  std::array<Integer, 4> homogeneous(const Vertex& v) const {
    if (v.is_input())
      return {points_->integer(v.point, 0), points_->integer(v.point, 1), points_->integer(v.point, 2), 1};
    const Row<Integer> f = row<Integer>(v.plane[0]), g = row<Integer>(v.plane[1]), h = row<Integer>(v.plane[2]);
    const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) -> Integer {
      return f[i] * (g[j] * h[k] - g[k] * h[j]) - f[j] * (g[i] * h[k] - g[k] * h[i]) +
             f[k] * (g[i] * h[j] - g[j] * h[i]);
    };
    return {-minor(1, 2, 3), minor(0, 2, 3), -minor(0, 1, 3), minor(0, 1, 2)};
  }

  /// The coefficients (a, b, c, d) of an oriented plane.
  std::array<Integer, 4> coefficients(Plane plane) const {
    std::array<Integer, 4> h = row<Integer>(plane.id());
    if (plane.flipped())
      for (Integer& x : h) x = -x;
    return h;
  }

  /// The sign of the determinant of three oriented planes' normals. Laws: exchanging two, or turning one round, negates
  /// it; equal planes give ZERO. Exact: filtered, then GMP. Proof: P-04
  Sign orientation(Plane p, Plane q, Plane r, Predicate_counts& counts) const {
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

  /// The sign of the determinant of three planes' canonical normals. Exact: yes, in GMP.
  int orientation_exact(std::uint32_t p, std::uint32_t q, std::uint32_t r) const {
    const Row<Integer> f = row<Integer>(p), g = row<Integer>(q), h = row<Integer>(r);
    return sgn(Integer(f[0] * (g[1] * h[2] - g[2] * h[1]) + f[1] * (g[2] * h[0] - g[0] * h[2]) +
                       f[2] * (g[0] * h[1] - g[1] * h[0])));
  }

 private:
  template <class Number>
  using Row = std::array<Number, 4>;

  template <int L>
  static int signum(const Fixed_integer<L>& n) {
    return n.sign();
  }
  static int signum(const Integer& n) { return sgn(n); }

  static double largest(const Approximate_plane& f) {
    return std::max({std::fabs(f.a), std::fabs(f.b), std::fabs(f.c)});
  }

  Approximate_plane approximate(std::uint32_t id) const {
    const Plane plane(id, false);
    return plane.is_axis_plane() ? approximate_axis(plane) : planes_->approximate(id);
  }
  Approximate_plane approximate_axis(Plane plane) const {
    const int axis = plane.axis();
    return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0,
            -points_->approximate(plane.axis_point(), axis), points_->is_exact(plane.axis_point(), axis)};
  }

  template <class Number>
  Number coordinate(std::uint32_t point, int axis) const {
    if constexpr (std::is_same_v<Number, Integer>) return points_->integer(point, axis);
    else return Number(points_->coordinate(point, axis), points_->limbs());
  }

  template <class Number>
  Row<Number> row(std::uint32_t id) const {
    const Plane plane(id, false);
    if (plane.is_axis_plane()) {
      const auto unit = [&](int k) { return Number(std::int64_t{plane.axis() == k}); };
      return {unit(0), unit(1), unit(2),
              Number(std::int64_t{0}) - coordinate<Number>(plane.axis_point(), plane.axis())};
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
  static Number determinant(const Row<Number>& p, const Row<Number>& q, const Row<Number>& r, const Row<Number>& s) {
    const auto minor = [](const Row<Number>& f, const Row<Number>& g, std::size_t i, std::size_t j) -> Number {
      return f[i] * g[j] - f[j] * g[i];
    };
    const Number upper01 = minor(p, q, 0, 1), upper02 = minor(p, q, 0, 2), upper03 = minor(p, q, 0, 3);
    const Number upper12 = minor(p, q, 1, 2), upper13 = minor(p, q, 1, 3), upper23 = minor(p, q, 2, 3);
    return upper01 * minor(r, s, 2, 3) - upper02 * minor(r, s, 1, 3) + upper03 * minor(r, s, 1, 2) +
           upper12 * minor(r, s, 0, 3) - upper13 * minor(r, s, 0, 2) + upper23 * minor(r, s, 0, 1);
  }

  /// What side() does where the sign of doubles alone cannot tell.
  Sign side_unfiltered(const Vertex& v, const Prepared_plane& h, Predicate_counts& counts) const {
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

  const Grid_points* points_;
  const Plane_table* planes_;
  const Point_planes* incidences_;
  Arithmetic arithmetic_;
  double range_;      // |approximate coordinate| <= range_
  double underflow_;  // covers what is lost below 2^-1074: nothing where doubles are integers. P-03, P-04
};

}  // namespace sightline
