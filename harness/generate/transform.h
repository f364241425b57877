#pragma once
// Exact changes to a scene whose effect on every answer is known: the raw material of metamorphic tests.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

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
Polygon_soup translated(const Polygon_soup& soup, const Exact_point& offset);

/// The soup scaled from the origin. Keeps every answer. Pre: factor > 0 (others would turn fronts), or
/// std::invalid_argument. Exact: yes
Polygon_soup scaled(const Polygon_soup& soup, const Rational& factor);

using Rational_matrix = std::array<std::array<Rational, 3>, 3>;

/// The rotation of the quaternion a + b i + c j + d k, of any length but 0; (a, 0, 0, d) turns about the z axis by
/// 2 atan(d / a), counterclockwise seen from +z. Denominators divide a^2 + b^2 + c^2 + d^2.
/// Post: orthogonal, determinant 1. Pre: not all zero, or std::invalid_argument. Exact: yes
Rational_matrix rotation(long a, long b, long c, long d);

/// The soup with every point p replaced by matrix p. Keeps every answer if the matrix is a rotation. Exact: yes
Polygon_soup rotated(const Polygon_soup& soup, const Rational_matrix& matrix);

/// A soup with the same points whose face k is face order[k] of the given one; with `reverse`, every loop runs
/// backwards. Pre: order holds face ids, or std::out_of_range. (Faces may be left out or repeated.)
Polygon_soup with_faces(const Polygon_soup& soup, const std::vector<Face_id>& order, bool reverse = false);

/// Puts another soup's points and faces behind one's own. Exact: yes
void append(Polygon_soup& to, const Polygon_soup& more);

/// The ids 0 .. n - 1 in random order.
std::vector<Face_id> random_order(std::size_t n, std::uint64_t seed);

/// The soup with its faces in random order: face k of the result is face random_order(face_count, seed)[k] of the given
/// one.
inline Polygon_soup faces_permuted(const Polygon_soup& soup, std::uint64_t seed) {
  return with_faces(soup, random_order(soup.face_count(), seed));
}

/// The soup with every face turned round: fronts become backs.
Polygon_soup faces_reversed(const Polygon_soup& soup);

/// The soup with every coordinate rounded to the nearest double and then, at random, kept or moved to the double next
/// below or next above: faces with four or more corners are rarely planar after it, triangles in a plane rarely
/// coplanar. Pre: coordinates within the range of doubles, or std::domain_error.
Polygon_soup one_ulp_perturbed(const Polygon_soup& soup, std::uint64_t seed);

}  // namespace sightline::generate
