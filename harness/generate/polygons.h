#pragma once
// What families of small scenes are made of: vectors, polygons drawn by hand, and faces on a lattice.

#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline::generate {

using Points = std::vector<Exact_point>;  ///< a polygon
using Faces = std::vector<Points>;

// ---- Vectors

/// p + t d
Exact_point along(const Exact_point& p, const Rational& t, const Exact_point& d);
Exact_point centroid(const Points& points);

/// The ids of points that are added to a soup.
std::vector<Point_id> added(Polygon_soup& soup, const Points& points);
/// Each list is a face of one loop, with points of its own.
Polygon_soup soup_of(const Faces& faces);

// ---- By hand

inline Rational ratio(long p, long q) {
  Rational value(p, static_cast<unsigned long>(q));
  value.canonicalize();
  return value;
}
inline Exact_point at(const Rational& x, const Rational& y, const Rational& z) { return {x, y, z}; }
inline Points reversed(Points points) {
  std::reverse(points.begin(), points.end());
  return points;
}
/// The rectangle [x0, x1] x [y0, y1] at height z, front up.
Points rectangle(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1, const Rational& z);
/// Points of the plane through `origin`.
Points in_plane(const Exact_point& origin, const Exact_point& u, const Exact_point& v,
                const std::vector<std::array<long, 2>>& outline);
/// The six faces of a box, fronts outside: those at low and high x, at low and high y, at low and high z.
Faces box(const Exact_point& low, const Exact_point& high);

// ---- Pieces of scenes

// Numbers are drawn one by one: the order of a call's arguments differs between compilers.

inline Rational integer(Random& random, std::int64_t least, std::int64_t most) {
  return static_cast<long>(random.between(least, most));
}
Exact_point lattice(Random& random, std::int64_t reach);
/// origin + i u + j v for integers in [least, most].
Exact_point lattice_in_plane(Random& random, const Exact_point& origin, const Exact_point& u, const Exact_point& v,
                             std::int64_t least, std::int64_t most);
inline Exact_point half_lattice(Random& random, std::int64_t reach) {
  Exact_point p = lattice(random, 2 * reach);
  for (Rational& x : p) x /= 2;
  return p;
}
/// Two lattice vectors that are not parallel.
std::array<Exact_point, 2> directions(Random& random, std::int64_t reach);
const std::vector<std::array<long, 2>>& outline(Random& random);
inline Points either_way(Points face, Random& random) { return random.chance(1, 2) ? reversed(face) : face; }
/// A triangle, or a convex or L-shaped outline in any plane, in the lattice [-reach, reach]^3.
Points any_face(Random& random, std::int64_t reach = 4);
inline void add(Faces& faces, const Faces& more) { faces.insert(faces.end(), more.begin(), more.end()); }
inline void add_any(Faces& faces, std::size_t count, Random& random) {
  for (; count > 0; --count) faces.push_back(any_face(random));
}
/// A place in the list that is nobody's: ties go by face id.
inline void shuffle(Faces& faces, Random& random) { random.shuffle(faces); }

}  // namespace sightline::generate
