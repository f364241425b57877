#pragma once
// Models of View in the plain numbers of a CGAL kernel: what most programs do.

#include <sightline/algorithms/point_visibility/lazy_table.h>
#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/partition_traits.h>
#include <sightline/kernel/traits/point_traits.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace sightline {

/// All values are computed in FT from the file's coordinates rounded to FT, and signs are believed; a plane is known to
/// hold only the rays that it made. Exact: for CGAL's Gmpq and Lazy_exact_nt, yes; for float and double, no: the result
/// may have gaps, overlaps and wrong faces, and corners that are no numbers (position() throws).
template <class FT>
class Number_view {
 public:
  static constexpr bool is_exact = !std::is_floating_point_v<FT>;
  struct Plane {
    std::array<FT, 3> n;
    Eye_plane_name name;
  };
  struct Ray {
    std::array<FT, 3> v;
    Eye_plane_name p, q;
  };

  /// `field`: as Exact_view has it.
  Number_view(Scene&&, const Exact_point&, const std::vector<std::array<Integer, 3>>& = {}) = delete;
  Number_view(const Scene& scene, const Exact_point& eye, const std::vector<std::array<Integer, 3>>& field = {})
      : scene_(&scene), eye_point_(eye), directions_(scene.points().size()), forms_(scene.pieces().size()) {
    for (std::size_t k = 0; k < 3; ++k) eye_[k] = number::from(eye[k]);
    Rational units = (scene.position({1, 0, 0, 1})[0] - scene.position({0, 0, 0, 1})[0]) *
                     scene.points().divisor();  // of a grid step
    mpq_mul_2exp(units.get_mpq_t(), units.get_mpq_t(), static_cast<mp_bitcnt_t>(scene.points().shift()));
    box_units_ = nearest_double(Rational(1 / units));
    for (const std::array<Integer, 3>& normal : field) {
      const auto scale =
          static_cast<mp_bitcnt_t>(std::max({bit_length(normal[0]), bit_length(normal[1]), bit_length(normal[2])}));
      Vector& side = field_.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        Rational x(normal[k]);
        mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), scale);
        side[k] = number::from(x);
      }
    }
  }

  const Scene& scene() const { return *scene_; }
  const Exact_point& eye() const { return eye_point_; }
  Sign eye_side(std::uint32_t piece) const { return form(piece).eye_side; }

  Plane edge(std::uint32_t p, std::uint32_t q) const {
    return {cross(direction(p), direction(q)), Eye_plane_name::edge(p, q)};
  }
  std::size_t field_sides() const { return field_.size(); }
  Plane field_side(std::uint32_t k) const { return {field_[k], Eye_plane_name::field(k)}; }
  Plane axis(std::uint32_t k) const { return {unit(k, FT(1)), Eye_plane_name::axis(k)}; }
  Plane crossing(std::uint32_t f, std::uint32_t g) const {
    const Vector &m = form(f).q,
                 &n = form(g).q;  // a difference of numbers is the same both ways but for its sign, rounded too
    return {{m[0] - n[0], m[1] - n[1], m[2] - n[2]}, Eye_plane_name::crossing(f, g)};
  }
  Plane opposite(const Plane& w) const { return {{-w.n[0], -w.n[1], -w.n[2]}, w.name}; }
  Ray axis_ray(std::uint32_t k, bool positive) const {
    return {unit(k, positive ? FT(1) : FT(-1)), Eye_plane_name::axis((k + 1) % 3), Eye_plane_name::axis((k + 2) % 3)};
  }
  Ray meet(const Plane& p, const Plane& q, Predicate_counts&) const { return {cross(p.n, q.n), p.name, q.name}; }

  Sign side(const Plane& w, const Ray& r, Predicate_counts& counts) const {
    ++counts.filtered;
    return w.name == r.p || w.name == r.q ? CGAL::ZERO : sign(dot(w.n, r.v));
  }
  Sign side(const Plane& w, std::uint32_t point, Predicate_counts& counts) const {
    ++counts.filtered;
    return w.name.has_point(point) ? CGAL::ZERO : sign(dot(w.n, direction(point)));
  }
  Sign nearer(std::uint32_t f, std::uint32_t g, const Ray& r, Predicate_counts& counts) const {
    return side(crossing(f, g), r, counts);  // as a cut along that plane will find it, so that the cut settles it
  }
  Sign beyond(std::uint32_t f, std::uint32_t point, Predicate_counts& counts) const {
    ++counts.filtered;
    return sign(dot(form(f).q, direction(point)) - FT(1));
  }
  bool same_plane(std::uint32_t f, std::uint32_t g) const {
    if constexpr (is_exact) return form(f).q == form(g).q;
    else return f == g;
  }

  Approximate_eye_plane approximate(const Plane& w) const {
    const Approximate_vector n = approximate(w.n);
    const double size = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
    return {{n.x, n.y, n.z}, size, slack * size};
  }
  Approximate_vector approximate(const Ray& r) const { return approximate(r.v); }
  double nearness(std::uint32_t piece, const Approximate_vector& direction) const {
    const Approximate_vector m = approximate(form(piece).q);
    return m.x * direction.x + m.y * direction.y + m.z * direction.z;
  }
  double farthest(std::uint32_t piece, const Ray& r) const {
    const Approximate_vector m = approximate(form(piece).q), v = approximate(r.v);
    const double near = m.x * v.x + m.y * v.y + m.z * v.z,
                 far = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z) / near * box_units_ * (1 + 8 * slack);
    return near > 0 && std::isfinite(far) ? far : std::numeric_limits<double>::infinity();
  }
  /// Errors: std::domain_error where the numbers overflowed.
  Exact_point position(std::uint32_t piece, const Ray& r) const {
    const FT near = dot(form(piece).q, r.v);
    Exact_point at;
    if (near == FT(0)) throw std::domain_error("a ray that runs along its plane");
    for (std::size_t k = 0; k < 3; ++k) at[k] = number::to(eye_[k] + r.v[k] / near);
    return at;
  }

 private:
  using Vector = std::array<FT, 3>;
  using number = Field_number<FT>;
  struct Form {
    Vector q;
    Sign eye_side;
  };
  static constexpr double slack = std::is_same_v<FT, float> ? 0x1p-20 : 0x1p-49;

  static Sign sign(const FT& value) {
    if constexpr (std::is_floating_point_v<FT>)
      return value > 0 ? CGAL::POSITIVE : value < 0 ? CGAL::NEGATIVE : CGAL::ZERO;  // no number is zero
    else return CGAL::sign(value);
  }
  static Vector unit(std::uint32_t k, const FT& length) {
    return {k == 0 ? length : FT(0), k == 1 ? length : FT(0), k == 2 ? length : FT(0)};
  }
  static Approximate_vector approximate(const Vector& v) {
    return {CGAL::to_double(v[0]), CGAL::to_double(v[1]), CGAL::to_double(v[2])};
  }

  const Vector& direction(std::uint32_t point) const {
    return directions_.at(point, [&](std::size_t p) {
      const Exact_point at = scene_->position(static_cast<std::uint32_t>(p));
      return Vector{number::from(at[0]) - eye_[0], number::from(at[1]) - eye_[1], number::from(at[2]) - eye_[2]};
    });
  }
  const Form& form(std::uint32_t piece) const {
    return forms_.at(piece, [&](std::size_t i) { return form_of(scene_->pieces()[i]); });
  }
  Form form_of(const Piece& piece) const {
    // n . x = c for x relative to the eye, through three corners; the eye is in front where c < 0.
    const std::span<const Piece_corner> corners = scene_->corners(piece);
    const Vector &a = direction(corners[0].point), &b = direction(corners[1].point), &c = direction(corners[2].point);
    const Vector normal = cross(minus(b, a), minus(c, a));
    const FT value = dot(normal, a);
    const Sign side = sign(-value);
    return {side == CGAL::ZERO ? Vector{FT(0), FT(0), FT(0)}
                               : Vector{normal[0] / value, normal[1] / value, normal[2] / value},
            side};
  }

  const Scene* scene_;
  Exact_point eye_point_;
  Vector eye_;
  double box_units_ = 1;  // the length of a unit of the file in approximate coordinates
  std::vector<Vector> field_;
  Lazy_table<Vector, 16> directions_;
  Lazy_table<Form, 16> forms_;
};

static_assert(View<Number_view<double>>);

}  // namespace sightline
