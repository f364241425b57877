#pragma once
// Convex polygons in the plane as cycles of lines, so that cutting never makes numbers wider: for exact areas.

#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sightline {

/// A convex polygon bounded by lines (a, b, c), interior where a x + b y + c > 0, counterclockwise; vertex i is where
/// line i - 1 meets line i. The same idea as the kernel's plane-defined polygons, one dimension down. Exact: yes.
class Flat_polygon {
 public:
  using Flat_line = std::array<Integer, 3>;
  using Point = std::array<Rational, 2>;

  /// The convex hull of points. Degenerate: empty where they are collinear. Cost: O(n log n) rational operations.
  static Flat_polygon hull(std::vector<Point> points);

  bool empty() const { return lines_.size() < 3; }
  std::span<const Flat_line> lines() const { return lines_; }
  /// Where line i - 1 meets line i. Pre: not empty.
  Point vertex(std::size_t i) const;

  /// The part where the line is positive. Degenerate: a part without area is empty.
  Flat_polygon clipped(const Flat_line& h) const;

  /// The convex pieces of what is in this polygon and not in the other one.
  std::vector<Flat_polygon> without(const Flat_polygon& other) const;

  Rational area() const;

 private:
  static Flat_line line_through(const Point& p, const Point& q);
  /// Vertex i in homogeneous coordinates with positive weight: consecutive lines turn left.
  std::array<Integer, 3> homogeneous(std::size_t i) const;
  int side_of_vertex(std::size_t i, const Flat_line& h) const;

  std::vector<Flat_line> lines_;
};

}  // namespace sightline
