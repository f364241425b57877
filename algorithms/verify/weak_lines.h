#pragma once
// Lines, polygons and cells of lines, for the check of weak visibility: rationals and integers only, shared with
// nothing that is checked. To be read after polygons.h and before weak.cpp.

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

namespace sightline::weak_check {

using namespace certificate_check;

using Corners = std::vector<Homogeneous>;

// ---- Lines and polygons

/// The oriented line from a to b, as the form det[p, q, a, b] in p and q: its entries 01, 02, 03, 12, 13, 23.
/// Of an edge of a polygon that p is in front of and q behind: positive if the segment passes inside.
using Pluecker_line = std::array<Integer, 6>;

Pluecker_line line_through(const Homogeneous& a, const Homogeneous& b);

/// The plane through a line and p. Its value at q is the line's side, det[p, q, a, b].
Homogeneous plane_through(const Pluecker_line& line, const Homogeneous& p);

Integer value(const Homogeneous& plane, const Homogeneous& p);

bool reaches(const Homogeneous& plane, const Corners& corners, int sign);
/// 1 or -1: the corners are on that closed side of the plane, and not all on it. 0: they are on both sides, or all on
/// it.
inline int position(const Homogeneous& plane, const Corners& corners) {
  return int{reaches(plane, corners, 1)} - int{reaches(plane, corners, -1)};
}

/// Where the line from p to q, p in front of a convex polygon's plane or q behind it, meets that plane: 1 inside the
/// polygon, 0 on its boundary, -1 outside. With p and q exchanged, front = -1.
int crossing(const Pluecker_line& line, const Corners& corners, int front = 1);

/// A convex polygon without straight corners, and its plane. Pre: not_convex() is empty for it.
struct Outline {
  Corners corners;
  Homogeneous plane;

  explicit Outline(const Polygon& polygon);
  /// The point at infinity that its front looks to.
  Homogeneous upwards() const { return {plane[0], plane[1], plane[2], 0}; }

  bool has_inside(const Homogeneous& p) const {
    return side(plane, p) == 0 && crossing(line_through(upwards(), p), corners) > 0;
  }

  bool in_plane(const Homogeneous& other) const { return !reaches(other, corners, 1) && !reaches(other, corners, -1); }

  /// Whether it meets the closed segment from p to q. Pre: both are in its plane. Proof: P-72b
  bool meets_in_plane(const Homogeneous& p, const Homogeneous& q) const;
};

// ---- Cells

/// Lines by number: one in space has one number, whichever edge it was named by.
class Lines {
 public:
  /// det[p, q, a, b] is `scale` times the numbered line's value.
  struct Named {
    std::size_t number;
    Rational scale;
  };
  Named through(const Homogeneous& a, const Homogeneous& b);
  const Pluecker_line& operator[](std::size_t number) const { return *lines_[number]; }
  std::size_t size() const { return lines_.size(); }

 private:
  std::map<Pluecker_line, std::size_t> numbers_;
  std::vector<const Pluecker_line*> lines_;
};

/// The lines from a convex part of a source to one of a fragment; the path says which of them are meant. A part without
/// an inside has no corners.
struct Cell {
  std::shared_ptr<const Corners> source, target;
  std::size_t cuts = 0;  ///< above it

  struct Signs {
    bool positive = false, negative = false;
  };
  std::unordered_map<std::size_t, Signs> known;  ///< of the values of numbered lines at pairs of corners
};

/// The part of a convex polygon with plane >= 0; none if it has no inside. The corners are counterclockwise as before.
/// Proof: P-72c
Corners cut(const Corners& corners, const Homogeneous& plane);

using Matrix = std::vector<std::vector<Integer>>;

Matrix transposed(const Matrix& matrix);

/// The coefficients of form(p) h(p) in the products of two weights of p, from the values at the corners: a row for each
/// pair of corners. Proof: P-72e
Matrix times(const Homogeneous& form, const Corners& corners, const Matrix& h);

}  // namespace sightline::weak_check
