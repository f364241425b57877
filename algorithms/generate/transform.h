#pragma once
// Exact changes to a scene whose effect on every answer is known: the raw material of metamorphic tests.

#include <sightline/algorithms/generate/random.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <limits>

namespace sightline::generate {

/// A soup with the same faces in the same order, over the points map(p, point p). Exact: as map is
template <class Map>
Polygon_soup mapped(const Polygon_soup& soup, Map map) {
  Polygon_soup result;
  result.file = soup.file;
  result.coordinates.reserve(soup.coordinates.size());
  for (std::size_t p = 0; p < soup.point_count(); ++p) {
    const Exact_point q = map(static_cast<Point_id>(p), soup.point(static_cast<Point_id>(p)));
    result.add_point(q[0], q[1], q[2]);
  }
  for (std::size_t f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(static_cast<Face_id>(f)); ++k) {
      if (k == 0) result.add_face(soup.loop(static_cast<Face_id>(f), k));
      else result.add_hole(soup.loop(static_cast<Face_id>(f), k));
    }
  return result;
}

/// The soup moved by an offset. Keeps every answer. Exact: yes
inline Polygon_soup translated(const Polygon_soup& soup, const Exact_point& offset) {
  return mapped(soup, [&](Point_id, Exact_point p) {
    for (std::size_t i = 0; i < 3; ++i) p[i] += offset[i];
    return p;
  });
}

/// The soup scaled from the origin. Keeps every answer. Pre: factor > 0 (others would turn fronts), or
/// std::invalid_argument. Exact: yes
inline Polygon_soup scaled(const Polygon_soup& soup, const Rational& factor) {
  require(sgn(factor) > 0, "scaled: the factor must be positive");
  return mapped(soup, [&](Point_id, Exact_point p) {
    for (Rational& c : p) c *= factor;
    return p;
  });
}

using Rational_matrix = std::array<std::array<Rational, 3>, 3>;

/// The rotation of the quaternion a + b i + c j + d k, of any length but 0; (a, 0, 0, d) turns about the z axis by
/// 2 atan(d / a), counterclockwise seen from +z. Denominators divide a^2 + b^2 + c^2 + d^2.
/// Post: orthogonal, determinant 1. Pre: not all zero, or std::invalid_argument. Exact: yes
inline Rational_matrix rotation(long a, long b, long c, long d) {
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

/// The soup with every point p replaced by matrix p. Keeps every answer if the matrix is a rotation. Exact: yes
inline Polygon_soup rotated(const Polygon_soup& soup, const Rational_matrix& matrix) {
  return mapped(soup, [&](Point_id, const Exact_point& p) {
    Exact_point q;
    for (std::size_t i = 0; i < 3; ++i) q[i] = matrix[i][0] * p[0] + matrix[i][1] * p[1] + matrix[i][2] * p[2];
    return q;
  });
}

/// A soup with the same points whose face k is face order[k] of the given one; with `reverse`, every loop runs
/// backwards. Pre: order holds face ids, or std::out_of_range. (Faces may be left out or repeated.)
inline Polygon_soup with_faces(const Polygon_soup& soup, const std::vector<Face_id>& order, bool reverse = false) {
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

/// The ids 0 .. n - 1 in random order.
inline std::vector<Face_id> random_order(std::size_t n, std::uint64_t seed) {
  std::vector<Face_id> order(n);
  for (std::size_t k = 0; k < n; ++k) order[k] = static_cast<Face_id>(k);
  Random(seed).shuffle(order);
  return order;
}

/// The soup with its faces in random order: face k of the result is face random_order(face_count, seed)[k] of the given
/// one.
inline Polygon_soup faces_permuted(const Polygon_soup& soup, std::uint64_t seed) {
  return with_faces(soup, random_order(soup.face_count(), seed));
}

/// The soup with every face turned round: fronts become backs.
inline Polygon_soup faces_reversed(const Polygon_soup& soup) {
  std::vector<Face_id> order(soup.face_count());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Face_id>(k);
  return with_faces(soup, order, true);
}

/// The soup with every coordinate rounded to the nearest double and then, at random, kept or moved to the double next
/// below or next above: faces with four or more corners are rarely planar after it, triangles in a plane rarely
/// coplanar. Pre: coordinates within the range of doubles, or std::domain_error.
inline Polygon_soup one_ulp_perturbed(const Polygon_soup& soup, std::uint64_t seed) {
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
