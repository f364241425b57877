#pragma once
// Models of Partition_traits that keep vertices as points of a CGAL kernel: what most programs do.

#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/partition_traits.h>
#include <sightline/kernel/vertex.h>

#include <CGAL/Gmpq.h>
#include <CGAL/Lazy_exact_nt.h>
#include <CGAL/number_utils.h>
#include <boost/multiprecision/gmp.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace sightline {

/// Conversions between GMP rationals and the field types of CGAL's kernels: exact where the field type is, else to the
/// nearest.
template <class FT>
struct Field_number {  // float, double
  static FT from(const Rational& value) { return static_cast<FT>(nearest_double(value)); }
  static Rational to(FT value) { return exact(static_cast<double>(value)); }
};
template <>
struct Field_number<Rational> {  // what Epeck stands on where CGAL uses GMP's own classes
  static Rational from(const Rational& value) { return value; }
  static Rational to(const Rational& value) { return value; }
};
template <>
struct Field_number<CGAL::Gmpq> {
  static CGAL::Gmpq from(const Rational& value) { return CGAL::Gmpq(value.get_mpq_t()); }
  static Rational to(const CGAL::Gmpq& value) { return Rational(value.mpq()); }
};
template <>
struct Field_number<boost::multiprecision::mpq_rational> {
  static boost::multiprecision::mpq_rational from(const Rational& value) {
    return boost::multiprecision::mpq_rational(value.get_mpq_t());
  }
  static Rational to(const boost::multiprecision::mpq_rational& value) { return Rational(value.backend().data()); }
};
template <class ET>
struct Field_number<CGAL::Lazy_exact_nt<ET>> {
  static CGAL::Lazy_exact_nt<ET> from(const Rational& value) {
    if (const double d = nearest_double(value); std::isfinite(d) && exact(d) == value) return d;
    return CGAL::Lazy_exact_nt<ET>(Field_number<ET>::from(value));
  }
  static Rational to(const CGAL::Lazy_exact_nt<ET>& value) { return Field_number<ET>::to(value.exact()); }
};

/// Vertices are points of the CGAL kernel K, planes go through three corners of each piece, crossings are interpolated.
/// A plane's corners are not known to lie on it and coplanar faces are not known to be coplanar: K's arithmetic
/// decides, which is right for Epeck and Cartesian<Gmpq> and not for Simple_cartesian<float>, Simple_cartesian<double>,
/// or Epick (whose constructions round). It takes the exact scene's convex pieces in the file's coordinates. Exact: as
/// K is.
template <class K>
class Point_traits {
 public:
  using Kernel = K;
  using Point_3 = typename K::Point_3;
  using Plane_3 = typename K::Plane_3;
  struct Vertex {
    Point_3 point;
    std::uint32_t input;  ///< an input point of the scene, or Vertex::no_point
  };
  struct Edge {};
  using Cutter = Plane_3;
  using Eye = Point_3;
  static constexpr bool is_exact = !std::is_floating_point_v<typename K::FT>;  // Epick's field type is double

  explicit Point_traits(Scene&&) = delete;
  explicit Point_traits(const Scene& scene) : scene_(&scene) {
    points_.reserve(scene.points().size());
    for (std::uint32_t p = 0; p < scene.points().size(); ++p) points_.push_back(eye(scene.position(p)));
    planes_.reserve(scene.pieces().size());
    for (const Piece& piece : scene.pieces()) {
      const auto corner = [&](std::uint32_t k) { return points_[scene.corners(piece)[k].point]; };
      planes_.emplace_back(corner(0), corner(1), corner(2));
      require_finite(planes_.back().a() + planes_.back().b() + planes_.back().c() + planes_.back().d());
    }
  }

  const Scene& scene() const { return *scene_; }
  std::size_t piece_count() const { return scene_->pieces().size(); }
  Face_id face(std::uint32_t piece) const { return scene_->pieces()[piece].face; }
  Plane supporting_plane(std::uint32_t piece) const { return {piece, false}; }
  template <class Function>
  void append_corners(std::uint32_t i, Function function) const {
    for (const Piece_corner& corner : scene_->corners(scene_->pieces()[i]))
      function(Vertex{points_[corner.point], corner.point}, Edge{});
  }

  /// A plane that is no piece's (a near plane, say), by its coefficients in the file's coordinates.
  Plane add_plane(const std::array<Rational, 4>& h) {
    planes_.emplace_back(number::from(h[0]), number::from(h[1]), number::from(h[2]), number::from(h[3]));
    return {static_cast<std::uint32_t>(planes_.size() - 1), false};
  }

  Cutter prepare(Plane plane) const {
    const Plane_3 h = !plane.is_axis_plane() ? planes_[plane.id()] : across(plane.axis(), points_[plane.axis_point()]);
    return plane.flipped() ? h.opposite() : h;
  }
  Sign side(const Vertex& v, const Cutter& cutter, Predicate_counts& counts) const {
    ++counts.filtered;  // K does not say how it decided
    return cutter.oriented_side(v.point);
  }
  Vertex meet(std::uint32_t, const Corner<Point_traits>& from, const Corner<Point_traits>& to, Sign side_from,
              const Cutter& cutter) const {
    // Always from behind to in front, so that faces that share the edge get one point.
    const Point_3& behind = (side_from == CGAL::NEGATIVE ? from : to).vertex->point;
    const Point_3& front = (side_from == CGAL::NEGATIVE ? to : from).vertex->point;
    const auto value = [&](const Point_3& p) {
      return cutter.a() * p.x() + cutter.b() * p.y() + cutter.c() * p.z() + cutter.d();
    };
    const typename K::FT low = value(behind), high = value(front);
    if (high == low) return {front, sightline::Vertex::no_point};  // an inexact sign lied
    const typename K::FT t = low / (low - high);
    require_finite(t);
    return {Point_3(behind.x() + t * (front.x() - behind.x()), behind.y() + t * (front.y() - behind.y()),
                    behind.z() + t * (front.z() - behind.z())),
            sightline::Vertex::no_point};
  }
  Edge bound(const Cutter&, Sign) const { return {}; }
  bool same_plane(Plane g, Plane h) const { return g.id() == h.id(); }
  bool same_sense(Plane g, Plane h) const {
    const Cutter a = prepare(g), b = prepare(h);
    return CGAL::is_positive(a.a() * b.a() + a.b() * b.b() + a.c() * b.c());
  }

  Eye eye(const Exact_point& p) const { return Point_3(number::from(p[0]), number::from(p[1]), number::from(p[2])); }
  Sign side(const Eye& eye, Plane plane, Predicate_counts& counts) const {
    ++counts.filtered;
    return prepare(plane).oriented_side(eye);
  }

  bool is_input(const Vertex& v) const { return v.input != sightline::Vertex::no_point; }
  std::optional<Plane> axis_plane(int axis, const Vertex& v) const {
    if (!is_input(v)) return std::nullopt;
    return Plane::across(axis, v.input);
  }
  double coordinate(const Vertex& v, int axis) const { return CGAL::to_double(v.point[axis]); }
  Approximate_point approximate(const Vertex& v) const {
    Approximate_point p{0, 0, 0, 0};
    const std::array<double*, 3> place{&p.x, &p.y, &p.z};
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = CGAL::to_interval(v.point[axis]);
      *place[static_cast<std::size_t>(axis)] = low + (high - low) / 2;
      p.error = std::max(p.error, high - low);
      if (!std::isfinite(*place[static_cast<std::size_t>(axis)]))
        return {0, 0, 0, std::numeric_limits<double>::infinity()};
    }
    return p;
  }
  Approximate_plane approximate(Plane plane) const {
    const Cutter h = prepare(plane);
    if constexpr (std::is_floating_point_v<typename K::FT>) {
      const auto rounded = [](typename K::FT x) { return static_cast<double>(x); };
      return {rounded(h.a()), rounded(h.b()), rounded(h.c()), rounded(h.d()), false};
    } else {
      // Times a power of two, so that the normal is about 1 long and neither is lost beside the other.
      const std::array<Rational, 4> exact{number::to(h.a()), number::to(h.b()), number::to(h.c()), number::to(h.d())};
      long exponent = std::numeric_limits<long>::min();
      for (std::size_t k = 0; k < 3; ++k)
        if (sgn(exact[k]) != 0) exponent = std::max(exponent, binary_exponent(exact[k]));
      const auto rounded = [&](std::size_t k) { return nearest_double(times_power(exact[k], -exponent)); };
      return {rounded(0), rounded(1), rounded(2), rounded(3), false};
    }
  }

  /// Errors: std::domain_error where an inexact construction overflowed.
  Exact_point position(const Vertex& v) const {
    return {number::to(v.point.x()), number::to(v.point.y()), number::to(v.point.z())};
  }

 private:
  /// Epick's exact stages end the program on infinity and NaN, so they must not get there; plain floats only get things
  /// wrong.
  static void require_finite(const typename K::FT& value) {
    if constexpr (std::is_floating_point_v<typename K::FT> && K::Has_filtered_predicates)
      if (!std::isfinite(value))
        throw std::domain_error("coordinates are beyond the range of this kernel's numbers; take an exact kernel");
  }

  using number = Field_number<typename K::FT>;

  Plane_3 across(int axis, const Point_3& p) const {
    using FT = typename K::FT;
    return {FT(axis == 0), FT(axis == 1), FT(axis == 2), -p[axis]};
  }

  const Scene* scene_;
  std::vector<Point_3> points_;
  std::vector<Plane_3> planes_;
};

}  // namespace sightline
