// To be read after polygons.cpp and before weak.cpp, in the order of weak_lines.h.

#include <sightline/algorithms/verify/weak_lines.h>

#include <algorithm>
#include <utility>

namespace sightline::weak_check {

Pluecker_line line_through(const Homogeneous& a, const Homogeneous& b) {
  const auto minor = [&](std::size_t i, std::size_t j) { return Integer(a[i] * b[j] - a[j] * b[i]); };
  return {minor(2, 3), minor(3, 1), minor(1, 2), minor(0, 3), minor(2, 0), minor(0, 1)};
}

Homogeneous plane_through(const Pluecker_line& line, const Homogeneous& p) {
  Homogeneous plane;
  std::size_t entry = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j, ++entry) {
      mpz_addmul(plane[j].get_mpz_t(), p[i].get_mpz_t(), line[entry].get_mpz_t());
      mpz_submul(plane[i].get_mpz_t(), p[j].get_mpz_t(), line[entry].get_mpz_t());
    }
  return plane;
}

Integer value(const Homogeneous& plane, const Homogeneous& p) {
  return Integer(plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3]);
}

bool reaches(const Homogeneous& plane, const Corners& corners, int sign) {
  return std::any_of(corners.begin(), corners.end(), [&](const Homogeneous& p) { return side(plane, p) == sign; });
}

int crossing(const Pluecker_line& line, const Corners& corners, int front) {
  int least = 1;
  for (std::size_t i = 0; i < corners.size() && least >= 0; ++i)
    least = std::min(least, front * side(plane_through(line, corners[i]),
                                         corners[(i + 1) % corners.size()]));  // det[a, b, p, q] = det[p, q, a, b]
  return least;
}

Outline::Outline(const Polygon& polygon) : plane(plane_of(polygon)) {
  Integer_vector in = primitive(minus(polygon.front(), polygon.back()));
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Integer_vector out = primitive(minus(polygon[(i + 1) % polygon.size()], polygon[i]));
    if (out != in) corners.push_back(homogeneous(polygon[i]));
    in = std::move(out);
  }
}

bool Outline::meets_in_plane(const Homogeneous& p, const Homogeneous& q) const {
  const Homogeneous upright = plane_through(line_through(p, q), upwards());
  if (position(upright, corners) != 0 && !reaches(upright, corners, 0)) return false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Homogeneous wall = plane_through(line_through(corners[i], corners[(i + 1) % corners.size()]), upwards());
    if (side(wall, p) < 0 && side(wall, q) < 0) return false;
  }
  return true;
}

Lines::Named Lines::through(const Homogeneous& a, const Homogeneous& b) {
  Pluecker_line line = line_through(a, b);
  Integer divisor = 0;
  for (const Integer& entry : line) divisor = gcd(divisor, entry);
  if (line < Pluecker_line{}) divisor = -divisor;
  for (Integer& entry : line) entry /= divisor;
  const auto [place, is_new] = numbers_.try_emplace(std::move(line), lines_.size());
  if (is_new) lines_.push_back(&place->first);
  return {place->second, Rational(divisor) / Rational(a[3] * b[3])};
}

Corners cut(const Corners& corners, const Homogeneous& plane) {
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

Matrix transposed(const Matrix& matrix) {
  Matrix result(matrix[0].size());
  for (std::size_t j = 0; j < result.size(); ++j)
    for (const std::vector<Integer>& row : matrix) result[j].push_back(row[j]);
  return result;
}

Matrix times(const Homogeneous& form, const Corners& corners, const Matrix& h) {
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
