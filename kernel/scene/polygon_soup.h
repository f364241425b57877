#pragma once
// What a file says, before anything is decided about it: points with exact coordinates and faces as loops of points.

#include <sightline/kernel/coordinates.h>
#include <sightline/kernel/number.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sightline {

using Point_id = std::uint32_t;
using Face_id = std::uint32_t;  ///< 0-based place of a face in the input

/// What a Rational is made of.
template <class Number>
concept Coordinate_number = std::is_convertible_v<Number, Rational>;

/// A point, or a vector, of exact coordinates: an array of them that is also made of integers and of finite doubles,
/// each taken for the number that it is. Errors: std::domain_error for a double that is not finite. A Rational cannot
/// say that, GMP ends the process; so what is assigned to a coordinate goes through exact(). Exact: yes
struct Exact_point : std::array<Rational, 3> {
  Exact_point() : std::array<Rational, 3>{} {}  ///< the origin
  template <Coordinate_number X, Coordinate_number Y, Coordinate_number Z>
  Exact_point(X&& x, Y&& y, Z&& z)
      : std::array<Rational, 3>{number(std::forward<X>(x), 0), number(std::forward<Y>(y), 1),
                                number(std::forward<Z>(z), 2)} {}
  /// Of that type alone: braces in braces, which could be it, would pass doubles on to Rational.
  template <std::same_as<std::array<Rational, 3>> Array>
  Exact_point(Array coordinates) : std::array<Rational, 3>(std::move(coordinates)) {}

 private:
  template <Coordinate_number Number>
  static Rational number(Number&& x, int axis) {
    if constexpr (std::is_floating_point_v<std::remove_cvref_t<Number>>) check_finite(double{x}, axis);
    return std::forward<Number>(x);
  }
  static void check_finite(double x, int axis);
};

/// The point that finite doubles are. Exact: yes
inline Exact_point exact(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// A vector times a power of two: its largest coordinate is between 1/4 and 1, so that doubles can tell what depends on
/// directions alone. Degenerate: zero stays zero. Exact: yes
Exact_point scaled_to_one(Exact_point v);

/// A polygon soup. A face is one or more loops of point ids: the first is the outer contour, seen counterclockwise from
/// the face's front; further loops are holes (either sense). Repeated points, non-planar, concave and zero-area faces
/// are all welcome, and points may be unused. A face may be added before its points: check_corners() sees whether they
/// came.
struct Polygon_soup {
  std::string file;         ///< where it came from, for messages and for JSON
  Coordinates coordinates;  ///< x, y, z of point 0, then of point 1, ...

  std::size_t point_count() const { return coordinates.size() / 3; }
  Exact_point point(Point_id p) const {
    return {coordinates[3 * std::size_t{p}], coordinates[3 * std::size_t{p} + 1], coordinates[3 * std::size_t{p} + 2]};
  }

  std::size_t face_count() const { return face_begin_.size() - 1; }
  std::size_t loop_count(Face_id f) const { return face_begin_[f + 1] - face_begin_[f]; }
  std::span<const Point_id> loop(Face_id f, std::size_t k = 0) const& {
    const std::size_t l = face_begin_[f] + k;
    return {corners_.data() + loop_begin_[l], corners_.data() + loop_begin_[l + 1]};
  }
  void loop(Face_id f,
            std::size_t k = 0) const&& = delete;  // of a temporary, which is gone before its corners are read

  /// Appends a point and returns its id. Errors: std::domain_error, which names the point, where a double is not
  /// finite.
  Point_id add_point(const Rational& x, const Rational& y, const Rational& z);
  Point_id add_point(double x, double y, double z);
  /// The point of the given numerators over one denominator, which need not be reduced. Pre: denominator > 0.
  Point_id add_point(const std::array<std::int64_t, 3>& numerators, std::int64_t denominator);
  /// Appends a face of one loop (possibly of fewer than three points) and returns its id.
  Face_id add_face(std::span<const Point_id> outer) {
    add_loop(outer);
    face_begin_.push_back(loop_begin_.size() - 1);
    return static_cast<Face_id>(face_count() - 1);
  }
  Face_id add_face(std::initializer_list<Point_id> outer) { return add_face(std::span(outer.begin(), outer.size())); }
  /// Appends a hole to the face added last. Pre: there is one.
  void add_hole(std::span<const Point_id> hole) {
    add_loop(hole);
    face_begin_.back() = loop_begin_.size() - 1;
  }
  void add_hole(std::initializer_list<Point_id> hole) { add_hole(std::span(hole.begin(), hole.size())); }
  /// Errors: std::out_of_range, which names the face and the point, where a face has a point that there is not.
  void check_corners() const;

 private:
  void add_loop(std::span<const Point_id> loop) {
    corners_.insert(corners_.end(), loop.begin(), loop.end());
    loop_begin_.push_back(corners_.size());
  }
  std::vector<Point_id> corners_;
  std::vector<std::size_t> loop_begin_{0};  // loop l is corners_[loop_begin_[l] .. loop_begin_[l + 1])
  std::vector<std::size_t> face_begin_{0};  // face f has loops [face_begin_[f] .. face_begin_[f + 1])
};

}  // namespace sightline

// A point's coordinates are bound as those of an array: auto [x, y, z] = point.
template <>
struct std::tuple_size<sightline::Exact_point> : std::integral_constant<std::size_t, 3> {};
template <std::size_t k>
struct std::tuple_element<k, sightline::Exact_point> {
  using type = sightline::Rational;
};
