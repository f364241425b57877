#pragma once
// What a file says, before anything is decided about it: points with exact coordinates and faces as loops of points.

#include <sightline/kernel/coordinates.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace sightline {

using Point_id = std::uint32_t;
using Face_id = std::uint32_t;  ///< 0-based place of a face in the input
using Exact_point = std::array<Rational, 3>;

/// The point that finite doubles are. Exact: yes
inline Exact_point exact(const std::array<double, 3>& v) { return {exact(v[0]), exact(v[1]), exact(v[2])}; }

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
  std::span<const Point_id> loop(Face_id f, std::size_t k = 0) const {
    const std::size_t l = face_begin_[f] + k;
    return {corners_.data() + loop_begin_[l], corners_.data() + loop_begin_[l + 1]};
  }

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
