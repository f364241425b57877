#pragma once
// Polygons seen from an eye in the numbers of a kernel, as cones: as exact as those numbers are.

#include <sightline/algorithms/image/pixel_cones.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/vectors.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <vector>

namespace sightline::image_detail {

template <class Number>
using Vector_of = std::array<Number, 3>;

template <class Number>
Number rounded(const Rational& x) {
  if constexpr (std::is_same_v<Number, Rational>) return x;
  else return static_cast<Number>(nearest_double(x));
}
template <class Number>
Vector_of<Number> rounded(const Exact_point& p) {
  return {rounded<Number>(p[0]), rounded<Number>(p[1]), rounded<Number>(p[2])};
}
template <class Number>
Vector_of<Number> converted(const std::array<double, 3>& v) {
  return {Number(v[0]), Number(v[1]), Number(v[2])};
}

/// The plane of a polygon, with respect to the eye: normal . d = at_plane for the d that lead to it.
template <class Number>
struct Number_plane {
  Vector_of<Number> normal;
  Number at_plane;
};

/// An eye and its image in floats or doubles.
template <class Number>
class Number_image {
 public:
  explicit Number_image(const Pixel_view& view)
      : eye_(rounded<Number>(view.eye)),
        look_(converted<Number>(view.look)),
        right_(converted<Number>(view.right)),
        up_(converted<Number>(view.up)) {}

  /// A linear form of directions, at places of the image. What is zero in these numbers, is: its bound is 0.
  Pixel_form form(const Vector_of<Number>& n) const {
    return {double(dot(n, right_)), double(dot(n, up_)), double(dot(n, look_)), 0};
  }
  /// Whether the form, and the difference of two such forms, is a number in all of the image.
  static bool is_finite(const Pixel_form& form) {
    return std::fabs(form.a) + std::fabs(form.b) + std::fabs(form.c) < 0x1p1000;
  }

  /// From the eye.
  Vector_of<Number> arm(const Exact_point& p) const { return minus(rounded<Number>(p), eye_); }

  /// The plane of a polygon with these arms, unless the numbers cannot hold it, or the eye is in it.
  static std::optional<Number_plane<Number>> plane(const std::vector<Vector_of<Number>>& arms) {
    Number_plane<Number> plane{{0, 0, 0}, 0};
    for (std::size_t k = 2; k < arms.size(); ++k) {
      const Vector_of<Number> n = cross(minus(arms[k - 1], arms[0]), minus(arms[k], arms[0]));
      for (std::size_t i = 0; i < 3; ++i) plane.normal[i] += n[i];
    }
    plane.at_plane = dot(arms[0], plane.normal);
    if (!(std::fabs(plane.at_plane) > 0) || !std::isfinite(plane.at_plane)) return std::nullopt;
    return plane;
  }

  /// Adds the cone of a polygon with these arms in that plane, unless the numbers cannot hold it.
  bool add(Pixel_cones& to, const std::vector<Vector_of<Number>>& arms, const Number_plane<Number>& plane) const {
    std::vector<Approximate_vector> directions;
    std::vector<Pixel_form> edges;
    for (std::size_t k = 0; k < arms.size(); ++k) {
      directions.push_back({double(arms[k][0]), double(arms[k][1]), double(arms[k][2])});
      Vector_of<Number> n = cross(arms[k], arms[k + 1 == arms.size() ? 0 : k + 1]);
      if (plane.at_plane < 0) n = {-n[0], -n[1], -n[2]};
      edges.push_back(form(n));
      if (!is_finite(edges.back())) return false;
    }
    if (to.add(directions, 1))
      for (const Pixel_form& edge : edges) to.add_edge(edge);
    return true;
  }

 private:
  Vector_of<Number> eye_, look_, right_, up_;
};

/// For Pixel_cones: what is zero in the numbers of a kernel is on the border.
inline std::array<Integer, 3> no_normal(std::uint32_t, std::uint32_t) { return {0, 0, 0}; }

}  // namespace sightline::image_detail
