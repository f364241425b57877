#pragma once
// Lines, polygons and cells of lines, for the check of weak visibility: rationals and integers only, shared with
// nothing that is checked. To be read after covering.h and before weak.h.

#include <sightline/algorithms/verify/covering.h>

#include <memory>
#include <unordered_map>

namespace sightline::weak_check {

using namespace certificate_check;

using Corners = std::vector<Homogeneous>;

// ---- Lines and polygons
// -----------------------------------------------------------------------------------------------------

/// The oriented line from a to b, as the form det[p, q, a, b] in p and q: its entries 01, 02, 03, 12, 13, 23.
/// Of an edge of a polygon that p is in front of and q behind: positive if the segment passes inside.
using Line = std::array<Integer, 6>;

inline Line line_through(const Homogeneous& a, const Homogeneous& b) {
  const auto minor = [&](std::size_t i, std::size_t j) { return Integer(a[i] * b[j] - a[j] * b[i]); };
  return {minor(2, 3), minor(3, 1), minor(1, 2), minor(0, 3), minor(2, 0), minor(0, 1)};
}

/// The plane through a line and p. Its value at q is the line's side, det[p, q, a, b].
inline Homogeneous plane_through(const Line& line, const Homogeneous& p) {
  Homogeneous plane;
  std::size_t entry = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j, ++entry) {
      mpz_addmul(plane[j].get_mpz_t(), p[i].get_mpz_t(), line[entry].get_mpz_t());
      mpz_submul(plane[i].get_mpz_t(), p[j].get_mpz_t(), line[entry].get_mpz_t());
    }
  return plane;
}

inline Integer value(const Homogeneous& plane, const Homogeneous& p) {
  return Integer(plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3]);
}

inline bool reaches(const Homogeneous& plane, const Corners& corners, int sign) {
  return std::any_of(corners.begin(), corners.end(), [&](const Homogeneous& p) { return side(plane, p) == sign; });
}
/// 1 or -1: the corners are on that closed side of the plane, and not all on it. 0: they are on both sides, or all on
/// it.
inline int position(const Homogeneous& plane, const Corners& corners) {
  return int{reaches(plane, corners, 1)} - int{reaches(plane, corners, -1)};
}

/// Where the line from p to q, p in front of a convex polygon's plane or q behind it, meets that plane: 1 inside the
/// polygon, 0 on its boundary, -1 outside. With p and q exchanged, front = -1.
inline int crossing(const Line& line, const Corners& corners, int front = 1) {
  int least = 1;
  for (std::size_t i = 0; i < corners.size() && least >= 0; ++i)
    least = std::min(least, front * side(plane_through(line, corners[i]),
                                         corners[(i + 1) % corners.size()]));  // det[a, b, p, q] = det[p, q, a, b]
  return least;
}

/// A convex polygon without straight corners, and its plane. Pre: not_convex() is empty for it.
struct Outline {
  Corners corners;
  Homogeneous plane;

  explicit Outline(const Polygon& polygon) : plane(plane_of(polygon)) {
    Integer_vector in = primitive(minus(polygon.front(), polygon.back()));
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      Integer_vector out = primitive(minus(polygon[(i + 1) % polygon.size()], polygon[i]));
      if (out != in) corners.push_back(homogeneous(polygon[i]));
      in = std::move(out);
    }
  }
  /// The point at infinity that its front looks to.
  Homogeneous upwards() const { return {plane[0], plane[1], plane[2], 0}; }

  bool has_inside(const Homogeneous& p) const {
    return side(plane, p) == 0 && crossing(line_through(upwards(), p), corners) > 0;
  }

  bool in_plane(const Homogeneous& other) const { return !reaches(other, corners, 1) && !reaches(other, corners, -1); }

  /// Whether it meets the closed segment from p to q. Pre: both are in its plane. Proof: P-72b
  bool meets_in_plane(const Homogeneous& p, const Homogeneous& q) const {
    const Homogeneous upright = plane_through(line_through(p, q), upwards());
    if (position(upright, corners) != 0 && !reaches(upright, corners, 0)) return false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Homogeneous wall = plane_through(line_through(corners[i], corners[(i + 1) % corners.size()]), upwards());
      if (side(wall, p) < 0 && side(wall, q) < 0) return false;
    }
    return true;
  }
};

// ---- Cells
// ------------------------------------------------------------------------------------------------------------------

/// Lines by number: one in space has one number, whichever edge it was named by.
class Lines {
 public:
  /// det[p, q, a, b] is `scale` times the numbered line's value.
  struct Named {
    std::size_t number;
    Rational scale;
  };
  Named through(const Homogeneous& a, const Homogeneous& b) {
    Line line = line_through(a, b);
    Integer divisor = 0;
    for (const Integer& entry : line) divisor = gcd(divisor, entry);
    if (line < Line{}) divisor = -divisor;
    for (Integer& entry : line) entry /= divisor;
    const auto [place, is_new] = numbers_.try_emplace(std::move(line), lines_.size());
    if (is_new) lines_.push_back(&place->first);
    return {place->second, Rational(divisor) / Rational(a[3] * b[3])};
  }
  const Line& operator[](std::size_t number) const { return *lines_[number]; }
  std::size_t size() const { return lines_.size(); }

 private:
  std::map<Line, std::size_t> numbers_;
  std::vector<const Line*> lines_;
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
inline Corners cut(const Corners& corners, const Homogeneous& plane) {
  Corners kept;
  if (!reaches(plane, corners, 1)) return kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Homogeneous &from = corners[i], &to = corners[(i + 1) % corners.size()];
    const Integer at_from = value(plane, from), at_to = value(plane, to);
    if (sgn(at_from) >= 0) kept.push_back(from);
    if (sgn(at_from) * sgn(at_to) >= 0) continue;
    Homogeneous meet;
    for (std::size_t k = 0; k < 4; ++k) meet[k] = abs(at_to) * from[k] + abs(at_from) * to[k];
    const Integer divisor = gcd(gcd(meet[0], meet[1]), gcd(meet[2], meet[3]));
    for (Integer& entry : meet) entry /= divisor;
    kept.push_back(std::move(meet));
  }
  return kept;
}

using Matrix = std::vector<std::vector<Integer>>;

inline Matrix transposed(const Matrix& matrix) {
  Matrix result(matrix[0].size());
  for (std::size_t j = 0; j < result.size(); ++j)
    for (const std::vector<Integer>& row : matrix) result[j].push_back(row[j]);
  return result;
}

/// The coefficients of form(p) h(p) in the products of two weights of p, from the values at the corners: a row for each
/// pair of corners. Proof: P-72e
inline Matrix times(const Homogeneous& form, const Corners& corners, const Matrix& h) {
  Matrix result;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i; j < corners.size(); ++j) {
      const Integer at_i = value(form, corners[i]), at_j = value(form, corners[j]);
      std::vector<Integer>& row = result.emplace_back();
      for (std::size_t k = 0; k < h[i].size(); ++k)
        row.push_back(i == j ? Integer(at_i * h[i][k]) : Integer(at_i * h[j][k] + at_j * h[i][k]));
    }
  return result;
}

}  // namespace sightline::weak_check
