#pragma once
// The exact model of View: names decide, then doubles with a derived bound, then integers as wide as the scene needs.

#include <sightline/algorithms/point_visibility/lazy_table.h>
#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sightline {

/// An eye at infinity, in this direction: all directions from it are the same, and it sees what light from there falls
/// on. Pre: not 0.
struct Sun {
  explicit Sun(const Exact_point& to) : direction(to) {}
  Exact_point direction;
};

/// Directions from the eye are integer vectors of b bits, so planes through it and an edge have normals of 2 b + 1
/// bits, rays where two of them meet 4 b + 3, and the side of such a ray 6 b + 7: 128 bits do for b <= 20, 256 for 41,
/// 512 for 84. Nothing is built on anything but input, so nothing grows. Of a sun they are where the lines to it cross
/// the coordinate plane that they are steepest to, as vectors (x, y, 1) of that plane: one linear map of the scene's
/// points, as p - eye is another one. Exact: yes. Proof: P-60, P-96
class Exact_view {
 public:
  static constexpr bool is_exact = true;

  /// Doubles within `error` in each coordinate; `size` is at least the sum of their magnitudes.
  struct Plane {
    double x, y, z, size, error;
    Eye_plane_name name;
    bool flipped;
  };
  /// The direction of a point of the scene (or against it), or the product of the normals of p and q, in that order.
  struct Ray {
    double x, y, z, size, error;
    Eye_plane_name p, q;
    std::uint32_t point;  ///< or no_point
    bool flipped;         ///< against the point, or against the product of the canonical normals
  };
  static constexpr std::uint32_t no_point = ~std::uint32_t{0};

  /// Pre: the scene outlives the view, and takes no further planes. `field`: normals of the sides of a field of view;
  /// side k meets side k + 1, in this sense, in a ray of it.
  Exact_view(Scene&&, const Exact_point&, std::vector<std::array<Integer, 3>> = {}) = delete;
  Exact_view(const Scene& scene, const Exact_point& eye, std::vector<std::array<Integer, 3>> field = {})
      : scene_(&scene),
        eye_point_(eye),
        eye_(scene.locate(eye)),
        field_(std::move(field)),
        forms_(scene.pieces().size()) {
    if (scene.pieces().size() >= (std::size_t{1} << 28)) throw std::length_error("scenes of up to 2^28 pieces only");
    measure();
  }
  Exact_view(Scene&&, const Sun&) = delete;
  Exact_view(const Scene& scene, const Sun& sun);

  const Scene& scene() const { return *scene_; }
  const Exact_point& eye() const { return eye_point_; }      ///< of a sun its direction
  const Located_point& located_eye() const { return eye_; }  ///< of a sun with w = 0 and an infinite error
  int bits() const { return bits_; }
  Sign eye_side(std::uint32_t piece) const { return static_cast<Sign>(form(piece).eye_side); }

  // ---- Planes and rays

  Plane edge(std::uint32_t p, std::uint32_t q) const;
  Plane axis(std::uint32_t k) const {
    return {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, 1, 0, Eye_plane_name::axis(k), false};
  }
  std::size_t field_sides() const { return field_.size(); }
  Plane field_side(std::uint32_t k) const;
  Plane crossing(std::uint32_t f, std::uint32_t g) const;
  /// Through the line where a plane of the scene, or an axis plane, cuts piece f's plane; in its front what is of f's
  /// plane in front of that one. Degenerate: where the eye is in that plane, that plane itself. Pre: the two cross, and
  /// the eye is not in f's plane. Proof: P-84
  Plane cut(std::uint32_t f, sightline::Plane by) const;
  Plane opposite(const Plane& w) const { return {-w.x, -w.y, -w.z, w.size, w.error, w.name, !w.flipped}; }

  Ray axis_ray(std::uint32_t k, bool positive) const;
  /// Towards a point of the scene.
  Ray ray(std::uint32_t point) const {
    const Approximate_vector d = approximate_direction(point);
    const double size = magnitude(d.x, d.y, d.z);
    return {d.x, d.y, d.z, size, 0x1p-50 * size + 0x1p-1000, {}, {}, point, false};
  }
  /// Where planes through edges with a common point meet, it is that point's direction or the one against it.
  Ray meet(const Plane& p, const Plane& q, Predicate_counts& counts) const;

  // ---- Predicates

  Sign side(const Plane& w, const Ray& r, Predicate_counts& counts) const;
  Sign side(const Plane& w, std::uint32_t point, Predicate_counts& counts) const;
  /// Degenerate: ZERO where both planes are met at once, everywhere for pieces of one plane. Proof: P-61
  Sign nearer(std::uint32_t f, std::uint32_t g, const Ray& r, Predicate_counts& counts) const;
  Sign beyond(std::uint32_t f, std::uint32_t point, Predicate_counts& counts) const;
  bool same_plane(std::uint32_t f, std::uint32_t g) const {
    return scene_->pieces()[f].support.id() == scene_->pieces()[g].support.id();
  }

  /// The side of a point of the scene to a piece's plane.
  Sign side(std::uint32_t piece, std::uint32_t point, Predicate_counts& counts) const;

  // ---- Exact values

  /// An integer vector along a ray, and one along a plane's normal.
  std::array<Integer, 3> direction(const Ray& r) const;
  std::array<Integer, 3> normal(const Plane& w) const;
  Exact_point position(std::uint32_t piece, const Ray& r) const;

  // ---- Doubles for culling and for choices

  bool is_sun() const { return sun_axis_ >= 0; }
  /// Of a sun: a plane through it as a plane of the scene, a x + b y + c z + d > 0 in front, in approximate
  /// coordinates. With these at most `reach` in size its values are within (error + 2^-49 size)(4 reach +
  /// |sun_last()|), error and size of the eye plane. P-96
  std::array<double, 4> sun_plane(const Approximate_eye_plane& w) const {
    const auto m = static_cast<std::size_t>(sun_axis_);
    std::array<double, 4> plane;
    plane[(m + 1) % 3] = w.normal[0];
    plane[(m + 2) % 3] = w.normal[1];
    plane[m] = -(w.normal[0] * sun_slope_[(m + 1) % 3] + w.normal[1] * sun_slope_[(m + 2) % 3]);
    plane[3] = w.normal[2] * sun_last_;
    return plane;
  }
  double sun_last() const { return sun_last_; }
  /// A sun's direction, about, its greatest coordinate 1 or -1.
  const std::array<double, 3>& towards_sun() const { return sun_; }
  Approximate_eye_plane approximate(const Plane& w) const { return {{w.x, w.y, w.z}, w.size, w.error}; }
  double farthest(std::uint32_t piece, const Ray& r) const;
  Approximate_vector approximate(const Ray& r) const { return {r.x, r.y, r.z}; }
  /// q of 1/t = q . r, for directions in the scene's grid. Infinite in size where doubles do not hold it.
  Approximate_eye_plane nearness(std::uint32_t piece) const {
    const Form& m = form(piece);
    return {{m.x, m.y, m.z}, m.size, 0x1p-50 * m.size};
  }
  double nearness(std::uint32_t piece, const Approximate_vector& direction) const {
    const Form& m = form(piece);
    return m.x * direction.x + m.y * direction.y + m.z * direction.z;
  }

 private:
  struct Form {
    double x, y, z, size;  // each within 2^-50 of its own value; size infinite where they overflow
    int eye_side;
  };
  template <class Number>
  using Vector = std::array<Number, 3>;
  struct Wide_direction {
    Vector<Integer> exact;
    Approximate_vector approximate;
  };

  Predicates predicates() const;
  static double magnitude(double x, double y, double z) {
    return (std::fabs(x) + std::fabs(y) + std::fabs(z)) * (1 + 0x1p-50);
  }
  static int signum(const Integer& n) { return sgn(n); }
  /// The sign of what lies within `bound` of a double; ZERO where that leaves it open.
  static Sign filtered(double value, double bound, Predicate_counts& counts) {
    const Sign sign = value > bound ? CGAL::POSITIVE : value < -bound ? CGAL::NEGATIVE : CGAL::ZERO;
    if (sign != CGAL::ZERO) ++counts.filtered;
    return sign;
  }
  template <int L>
  static int signum(const Fixed_integer<L>& n);

  // ---- Construction

  /// How wide directions are, and how long.
  void measure();
  /// w p - eye. Pre: narrow.
  Vector<std::int64_t> narrow_direction(std::uint32_t p) const {
    const Grid_points& points = scene_->points();
    if (sun_axis_ >= 0) [[unlikely]] {
      const auto coordinate = [&](int axis) { return points.small(p, axis); };
      return sun_direction<std::int64_t>(coordinate, {narrow_eye_[0], narrow_eye_[1], narrow_eye_[2]});
    }
    const auto& [x, y, z, w] = narrow_eye_;
    return {w * points.small(p, 0) - x, w * points.small(p, 1) - y, w * points.small(p, 2) - z};
  }
  /// The same of a sun. Pre: the sun's numbers are e. P-96
  template <class Number, class Coordinate>
  Vector<Number> sun_direction(Coordinate coordinate, const Vector<Number>& e) const {
    const int m = sun_axis_, i = (m + 1) % 3, j = (m + 2) % 3;
    const Number &along = e[static_cast<std::size_t>(m)], along_size = along < 0 ? Number(-along) : along;
    const auto across = [&](int k) -> Number {
      const Number& slope = e[static_cast<std::size_t>(k)];
      const Number way = along < 0 ? Number(-slope) : slope;
      return along_size * coordinate(k) - way * coordinate(m);
    };
    return {across(i), across(j), Number(-along)};
  }
  /// What a plane through the eye is as a normal of directions. P-96
  Vector<Integer> in_view(const std::array<Integer, 4>& h) const {
    if (sun_axis_ < 0) return {h[0], h[1], h[2]};
    const auto m = static_cast<std::size_t>(sun_axis_);
    const Integer& along = m == 0 ? eye_.x : m == 1 ? eye_.y : eye_.z;
    return {h[(m + 1) % 3], h[(m + 2) % 3], along < 0 ? h[3] : Integer(-h[3])};
  }
  /// The same where it is not.
  const Wide_direction& wide_direction(std::uint32_t point) const;
  /// As doubles, at one scale for all points.
  Approximate_vector approximate_direction(std::uint32_t point) const {
    if (!narrow_) return wide_direction(point).approximate;
    const Vector<std::int64_t> d = narrow_direction(point);
    return {static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
  }
  /// q = -n / (n eye + d w) of a piece, and the eye's side.
  const Form& form(std::uint32_t piece) const {
    return forms_.at(piece, [&](std::size_t i) { return form_of(scene_->pieces()[i]); });
  }
  Form form_of(const Piece& piece) const;
  Integer value_at_eye(const std::array<Integer, 4>& h) const {
    return h[0] * eye_.x + h[1] * eye_.y + h[2] * eye_.z + h[3] * eye_.w;
  }

  /// A normal as doubles, each within 2^-52 of its own value.
  static Plane from(const Vector<__int128>& n) {
    return with_size(static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2]));
  }
  static Plane from(const Vector<Integer>& n) {
    const std::array<double, 3> near = in_proportion(n);
    return with_size(near[0], near[1], near[2]);
  }
  static Plane with_size(double x, double y, double z) {
    const double size = magnitude(x, y, z);
    return {x, y, z, size, 0x1p-52 * size + 0x1p-1060, {}, false};
  }

  // ---- Exact stages

  template <class Number>
  Vector<Number> point_direction(std::uint32_t p) const;
  template <class Number>
  Vector<Number> normal_of(std::uint32_t p, std::uint32_t q) const;

  /// The canonical normal of a name. Pre: a fixed width only for planes of edges and axes.
  template <class Number>
  Vector<Number> normal(Eye_plane_name name) const;
  /// A positive multiple of q_f - q_g.
  Vector<Integer> crossing_normal(std::uint32_t f, std::uint32_t g) const;
  Vector<Integer> cut_normal(std::uint32_t f, sightline::Plane by) const;
  template <class Number>
  int side_in(const Plane& w, const Ray& r) const;
  static bool is_fixed(Eye_plane_name name) { return name.is_edge() || name.kind() == Eye_plane_name::axis_kind; }

  [[gnu::noinline]] Sign side_unfiltered(const Plane& w, const Ray& r, Predicate_counts& counts) const;
  [[gnu::noinline]] Sign nearer_unfiltered(std::uint32_t f, std::uint32_t g, const Ray& r,
                                           Predicate_counts& counts) const;
  [[gnu::noinline]] Sign beyond_unfiltered(std::uint32_t f, std::uint32_t point, Predicate_counts& counts) const {
    return static_cast<Sign>(-side(f, point, counts) * form(f).eye_side);
  }
  /// The ray of a point, or the one against it, whichever goes the way of r.
  Ray along(std::uint32_t point, const Ray& r, Predicate_counts& counts) const;

  const Scene* scene_;
  Exact_point eye_point_;
  Located_point eye_;
  std::vector<Vector<Integer>> field_;
  int bits_ = 0, width_ = 0;                   // of directions; in limbs, 0: GMP
  int sun_axis_ = -1;                          // of a sun, along which its direction is longest; the others follow it
  std::array<double, 3> sun_{}, sun_slope_{};  // its direction over its greatest coordinate's size, and over that
  double sun_last_ = 0;  // the last coordinate of its directions, where the others are in approximate coordinates
  bool narrow_ = true;
  double box_units_ = 1;                            // the length of a direction's unit in approximate coordinates
  std::array<std::int64_t, 4> narrow_eye_{};        // where narrow
  Lazy_table<Wide_direction, 16> wide_directions_;  // where not
  Lazy_table<Form, 16> forms_;
};

// ---- Filters: inline, as solving spends most of its time in them

inline Sign Exact_view::side(const Plane& w, const Ray& r, Predicate_counts& counts) const {
  const double value = w.x * r.x + w.y * r.y + w.z * r.z;
  const double bound =
      w.size * r.error + w.error * (r.size + 4 * r.error);  // the rounding of these lines is in r.error. P-60
  if (const Sign sign = filtered(value, bound, counts); sign != CGAL::ZERO) return sign;
  return side_unfiltered(w, r, counts);
}

inline Sign Exact_view::side(const Plane& w, std::uint32_t point, Predicate_counts& counts) const {
  const Approximate_vector d = approximate_direction(point);
  const double value = w.x * d.x + w.y * d.y + w.z * d.z;
  const double bound = (w.size * 0x1p-50 + w.error) * magnitude(d.x, d.y, d.z) + 0x1p-1000 * (1 + w.size);
  if (const Sign sign = filtered(value, bound, counts); sign != CGAL::ZERO) return sign;
  if (w.name.has_point(point)) {
    ++counts.combinatorial;
    return CGAL::ZERO;
  }
  return side_unfiltered(w, ray(point), counts);
}

inline Sign Exact_view::nearer(std::uint32_t f, std::uint32_t g, const Ray& r, Predicate_counts& counts) const {
  const Form &m = form(f), &n = form(g);
  const double value = (m.x - n.x) * r.x + (m.y - n.y) * r.y + (m.z - n.z) * r.z;
  const double bound = (m.size + n.size) * (2 * r.error + 0x1p-48 * r.size) + 0x1p-700;
  if (const Sign sign = filtered(value, bound, counts); sign != CGAL::ZERO) return sign;
  return nearer_unfiltered(f, g, r, counts);
}

static_assert(View<Exact_view>);

/// The normals of the sides of a cone that rays span, for Exact_view's field of view.
/// Pre: each three rays in this order turn one way, and all are within less than a half space: or
/// std::invalid_argument. Exact: yes
std::vector<std::array<Integer, 3>> field_of(const std::vector<Exact_point>& rays);

}  // namespace sightline
