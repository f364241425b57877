#pragma once
// What families of small scenes are made of: vectors, polygons drawn by hand, and faces on a lattice.

#include <sightline/algorithms/generate/random.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <array>
#include <vector>

namespace sightline::generate {

using Points = std::vector<Exact_point>;  ///< a polygon
using Faces = std::vector<Points>;

// ---- Vectors
// ---------------------------------------------------------------------------------------------------------------------

inline Exact_point minus(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
}
/// p + t d
inline Exact_point along(const Exact_point& p, const Rational& t, const Exact_point& d) {
  return {Rational(p[0] + t * d[0]), Rational(p[1] + t * d[1]), Rational(p[2] + t * d[2])};
}
inline Exact_point cross(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[1] * b[2] - a[2] * b[1]), Rational(a[2] * b[0] - a[0] * b[2]),
          Rational(a[0] * b[1] - a[1] * b[0])};
}
inline bool is_zero(const Exact_point& v) { return sgn(v[0]) == 0 && sgn(v[1]) == 0 && sgn(v[2]) == 0; }
inline Exact_point centroid(const Points& points) {
  Exact_point sum{0, 0, 0};
  for (const Exact_point& p : points) sum = along(sum, 1, p);
  for (Rational& x : sum) x /= static_cast<long>(points.size());
  return sum;
}

/// Each list is a face of one loop, with points of its own.
inline Polygon_soup soup_of(const Faces& faces) {
  Polygon_soup soup;
  for (const Points& face : faces) {
    std::vector<Point_id> ids;
    for (const Exact_point& p : face) ids.push_back(soup.add_point(p[0], p[1], p[2]));
    soup.add_face(ids);
  }
  return soup;
}

// ---- By hand
// -------------------------------------------------------------------------------------------------------------------------

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
inline Points rectangle(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1,
                        const Rational& z) {
  return {at(x0, y0, z), at(x1, y0, z), at(x1, y1, z), at(x0, y1, z)};
}
/// Points of the plane through `origin`.
inline Points in_plane(const Exact_point& origin, const Exact_point& u, const Exact_point& v,
                       const std::vector<std::array<long, 2>>& outline) {
  Points points;
  for (const std::array<long, 2>& p : outline) points.push_back(along(along(origin, p[0], u), p[1], v));
  return points;
}
/// The six faces of a box, fronts outside: those at low and high x, at low and high y, at low and high z.
inline Faces box(const Exact_point& low, const Exact_point& high) {
  const auto corner = [&](int bits) {
    return at(bits & 1 ? high[0] : low[0], bits & 2 ? high[1] : low[1], bits & 4 ? high[2] : low[2]);
  };
  static constexpr int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  Faces result;
  for (const auto& face : faces) result.push_back({corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])});
  return result;
}

// ---- Pieces of scenes
// --------------------------------------------------------------------------------------------------------------------

// Numbers are drawn one by one: the order of a call's arguments differs between compilers.

inline Rational integer(Random& random, std::int64_t least, std::int64_t most) {
  return static_cast<long>(random.between(least, most));
}
inline Exact_point lattice(Random& random, std::int64_t reach) {
  Exact_point p{0, 0, 0};
  for (Rational& x : p) x = integer(random, -reach, reach);
  return p;
}
/// origin + i u + j v for integers in [least, most].
inline Exact_point lattice_in_plane(Random& random, const Exact_point& origin, const Exact_point& u,
                                    const Exact_point& v, std::int64_t least, std::int64_t most) {
  const Exact_point p = along(origin, integer(random, least, most), u);
  return along(p, integer(random, least, most), v);
}
inline Exact_point half_lattice(Random& random, std::int64_t reach) {
  Exact_point p = lattice(random, 2 * reach);
  for (Rational& x : p) x /= 2;
  return p;
}
/// Two lattice vectors that are not parallel.
inline std::array<Exact_point, 2> directions(Random& random, std::int64_t reach) {
  while (true) {
    const Exact_point u = lattice(random, reach), v = lattice(random, reach);
    if (!is_zero(cross(u, v))) return {u, v};
  }
}
inline const std::vector<std::array<long, 2>>& outline(Random& random) {
  static const std::vector<std::vector<std::array<long, 2>>> outlines{{{0, 0}, {1, 0}, {0, 1}},
                                                                      {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                                                      {{0, 0}, {3, 0}, {2, 1}, {1, 1}},
                                                                      {{0, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 2}},
                                                                      {{1, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 2}, {0, 1}},
                                                                      {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                                                                      {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}};
  return outlines[random.below(outlines.size())];
}
inline Points either_way(Points face, Random& random) { return random.chance(1, 2) ? reversed(face) : face; }
/// A triangle, or a convex or L-shaped outline in any plane, in the lattice [-reach, reach]^3.
inline Points any_face(Random& random, std::int64_t reach = 4) {
  while (true) {
    Points face;
    if (random.chance(1, 3)) {
      face = {lattice(random, reach), lattice(random, reach), lattice(random, reach)};
      if (is_zero(cross(minus(face[1], face[0]), minus(face[2], face[0])))) continue;
    } else {
      const auto [u, v] = directions(random, 3);
      const Exact_point corner = lattice(random, reach);
      face = in_plane(corner, u, v, outline(random));
      if (std::any_of(face.begin(), face.end(), [&](const Exact_point& p) {
            return abs(p[0]) > reach || abs(p[1]) > reach || abs(p[2]) > reach;
          }))
        continue;
    }
    return either_way(face, random);
  }
}
inline void add(Faces& faces, const Faces& more) { faces.insert(faces.end(), more.begin(), more.end()); }
inline void add_any(Faces& faces, std::size_t count, Random& random) {
  for (; count > 0; --count) faces.push_back(any_face(random));
}
/// A place in the list that is nobody's: ties go by face id.
inline void shuffle(Faces& faces, Random& random) { random.shuffle(faces); }

}  // namespace sightline::generate
