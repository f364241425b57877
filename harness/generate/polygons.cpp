#include <sightline/harness/generate/polygons.h>

namespace sightline::generate {

Exact_point along(const Exact_point& p, const Rational& t, const Exact_point& d) {
  return {Rational(p[0] + t * d[0]), Rational(p[1] + t * d[1]), Rational(p[2] + t * d[2])};
}

Exact_point centroid(const Points& points) {
  Exact_point sum{0, 0, 0};
  for (const Exact_point& p : points) sum = along(sum, 1, p);
  for (Rational& x : sum) x /= static_cast<long>(points.size());
  return sum;
}

std::vector<Point_id> added(Polygon_soup& soup, const Points& points) {
  std::vector<Point_id> ids;
  for (const Exact_point& p : points) ids.push_back(soup.add_point(p[0], p[1], p[2]));
  return ids;
}

Polygon_soup soup_of(const Faces& faces) {
  Polygon_soup soup;
  for (const Points& face : faces) soup.add_face(added(soup, face));
  return soup;
}

Points rectangle(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1, const Rational& z) {
  return {at(x0, y0, z), at(x1, y0, z), at(x1, y1, z), at(x0, y1, z)};
}

Points in_plane(const Exact_point& origin, const Exact_point& u, const Exact_point& v,
                const std::vector<std::array<long, 2>>& outline) {
  Points points;
  for (const std::array<long, 2>& p : outline) points.push_back(along(along(origin, p[0], u), p[1], v));
  return points;
}

Faces box(const Exact_point& low, const Exact_point& high) {
  const auto corner = [&](int bits) {
    return at(bits & 1 ? high[0] : low[0], bits & 2 ? high[1] : low[1], bits & 4 ? high[2] : low[2]);
  };
  static constexpr int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  Faces result;
  for (const auto& face : faces) result.push_back({corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])});
  return result;
}

Exact_point lattice(Random& random, std::int64_t reach) {
  Exact_point p{0, 0, 0};
  for (Rational& x : p) x = integer(random, -reach, reach);
  return p;
}

Exact_point lattice_in_plane(Random& random, const Exact_point& origin, const Exact_point& u, const Exact_point& v,
                             std::int64_t least, std::int64_t most) {
  const Exact_point p = along(origin, integer(random, least, most), u);
  return along(p, integer(random, least, most), v);
}

std::array<Exact_point, 2> directions(Random& random, std::int64_t reach) {
  while (true) {
    const Exact_point u = lattice(random, reach), v = lattice(random, reach);
    if (!is_zero(cross(u, v))) return {u, v};
  }
}

const std::vector<std::array<long, 2>>& outline(Random& random) {
  static const std::vector<std::vector<std::array<long, 2>>> outlines{{{0, 0}, {1, 0}, {0, 1}},
                                                                      {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                                                      {{0, 0}, {3, 0}, {2, 1}, {1, 1}},
                                                                      {{0, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 2}},
                                                                      {{1, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 2}, {0, 1}},
                                                                      {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                                                                      {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}};
  return outlines[random.below(outlines.size())];
}

Points any_face(Random& random, std::int64_t reach) {
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

}  // namespace sightline::generate
