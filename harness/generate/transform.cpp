#include <sightline/harness/generate/transform.h>

#include <sightline/harness/generate/random.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sightline::generate {

Polygon_soup translated(const Polygon_soup& soup, const Exact_point& offset) {
  return mapped(soup, [&](Point_id, Exact_point p) {
    for (std::size_t i = 0; i < 3; ++i) p[i] += offset[i];
    return p;
  });
}

Polygon_soup scaled(const Polygon_soup& soup, const Rational& factor) {
  require(sgn(factor) > 0, "scaled: the factor must be positive");
  return mapped(soup, [&](Point_id, Exact_point p) {
    for (Rational& c : p) c *= factor;
    return p;
  });
}

Rational_matrix rotation(long a, long b, long c, long d) {
  const Integer A = a, B = b, C = c, D = d, norm = A * A + B * B + C * C + D * D;
  require(sgn(norm) != 0, "rotation: the quaternion must not be zero");
  const std::array<std::array<Integer, 3>, 3> numerators{{
      {A * A + B * B - C * C - D * D, 2 * (B * C - A * D), 2 * (B * D + A * C)},
      {2 * (B * C + A * D), A * A - B * B + C * C - D * D, 2 * (C * D - A * B)},
      {2 * (B * D - A * C), 2 * (C * D + A * B), A * A - B * B - C * C + D * D},
  }};
  Rational_matrix matrix;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      matrix[i][j] = Rational(numerators[i][j], norm);
      matrix[i][j].canonicalize();
    }
  return matrix;
}

Polygon_soup rotated(const Polygon_soup& soup, const Rational_matrix& matrix) {
  return mapped(soup, [&](Point_id, const Exact_point& p) {
    Exact_point q;
    for (std::size_t i = 0; i < 3; ++i) q[i] = matrix[i][0] * p[0] + matrix[i][1] * p[1] + matrix[i][2] * p[2];
    return q;
  });
}

Polygon_soup with_faces(const Polygon_soup& soup, const std::vector<Face_id>& order, bool reverse) {
  Polygon_soup result;
  result.file = soup.file;
  result.coordinates = soup.coordinates;
  std::vector<Point_id> loop;
  for (const Face_id f : order) {
    if (f >= soup.face_count()) throw std::out_of_range("with_faces: no face " + std::to_string(f));
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      const auto given = soup.loop(f, k);
      if (reverse) loop.assign(given.rbegin(), given.rend());
      else loop.assign(given.begin(), given.end());
      if (k == 0) result.add_face(loop);
      else result.add_hole(loop);
    }
  }
  return result;
}

void append(Polygon_soup& to, const Polygon_soup& more) {
  const auto first = static_cast<Point_id>(to.point_count());
  for (Point_id p = 0; p < more.point_count(); ++p) to.add_point(more.point(p)[0], more.point(p)[1], more.point(p)[2]);
  std::vector<Point_id> loop;
  for (Face_id f = 0; f < more.face_count(); ++f)
    for (std::size_t k = 0; k < more.loop_count(f); ++k) {
      const auto given = more.loop(f, k);
      loop.assign(given.begin(), given.end());
      for (Point_id& p : loop) p += first;
      if (k == 0) to.add_face(loop);
      else to.add_hole(loop);
    }
}

std::vector<Face_id> random_order(std::size_t n, std::uint64_t seed) {
  std::vector<Face_id> order(n);
  for (std::size_t k = 0; k < n; ++k) order[k] = static_cast<Face_id>(k);
  Random(seed).shuffle(order);
  return order;
}

Polygon_soup faces_reversed(const Polygon_soup& soup) {
  std::vector<Face_id> order(soup.face_count());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Face_id>(k);
  return with_faces(soup, order, true);
}

Polygon_soup one_ulp_perturbed(const Polygon_soup& soup, std::uint64_t seed) {
  Random random(seed);
  return mapped(soup, [&](Point_id, Exact_point p) {
    for (Rational& c : p) {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      double rounded = nearest_double(c);
      const std::int64_t move = random.between(-1, 1);
      if (move != 0) rounded = std::nextafter(rounded, move < 0 ? -infinity : infinity);
      c = exact(rounded);
    }
    return p;
  });
}

}  // namespace sightline::generate
