#include <sightline/harness/generate/rays.h>

#include <array>
#include <cstddef>

namespace sightline::generate {

namespace ray_kinds_detail {

Rational share(Random& random, std::int64_t least, std::int64_t most, long of) {
  Rational r(static_cast<long>(random.between(least, most)), of);
  r.canonicalize();
  return r;
}

Exact_point between(const Exact_point& p, const Exact_point& q, const Rational& at) {
  Exact_point r;
  for (std::size_t k = 0; k < 3; ++k) r[k] = p[k] + at * (q[k] - p[k]);
  return r;
}

/// Three corners of a face that follow each other, of any loop; nothing where the face picked has fewer.
bool pick(const Polygon_soup& soup, Random& random, std::array<Exact_point, 3>& corners) {
  if (soup.face_count() == 0) return false;
  const auto face = static_cast<Face_id>(random.below(soup.face_count()));
  const auto loop = soup.loop(face, random.below(soup.loop_count(face)));
  if (loop.size() < 3) return false;
  const std::size_t at = random.below(loop.size());
  for (std::size_t k = 0; k < 3; ++k) corners[k] = soup.point(loop[(at + k) % loop.size()]);
  return true;
}

Exact_ray towards(const Exact_point& from, const Exact_point& to) {
  Exact_ray ray{from, {}};
  for (std::size_t k = 0; k < 3; ++k) ray.direction[k] = to[k] - from[k];
  if (ray.direction == Exact_point{0, 0, 0}) ray.direction = {1, 0, 0};
  return ray;
}

/// A point about the corners, off their plane as a rule: what three random affine combinations give, axis by axis.
Exact_point about(const std::array<Exact_point, 3>& p, const Exact_point& beside, Random& random) {
  Exact_point at;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational a = share(random, -16, 16, 16), b = share(random, -64, 64, 16), c = share(random, -64, 64, 16);
    at[k] = p[0][k] + c * (p[1][k] - p[0][k]) + b * (p[2][k] - p[0][k]) + a * (beside[k] - p[0][k]);
  }
  return at;
}
/// A point in the plane of the corners; inside the triangle where `inside`.
Exact_point in_plane(const std::array<Exact_point, 3>& p, bool inside, Random& random) {
  const std::int64_t least = inside ? 1 : -16;
  const Rational a = share(random, least, inside ? 7 : 16, 8), b = share(random, least, inside ? 7 : 16, 8);
  const Exact_point on = between(p[1], p[2], b);
  return between(p[0], on, a);
}

using Make = Exact_ray (*)(const std::array<Exact_point, 3>& face, const std::array<Exact_point, 3>& other, Random&);

template <Make make>
Exact_ray made(const Polygon_soup& soup, Random& random) {
  std::array<Exact_point, 3> face, other;
  if (!pick(soup, random, face) || !pick(soup, random, other)) return {{0, 0, 0}, {1, 0, 0}};
  return make(face, other, random);
}

Exact_ray anywhere(const std::array<Exact_point, 3>& face, const std::array<Exact_point, 3>& other, Random& random) {
  const Exact_point to = about(other, face[1], random);
  return towards(about(face, other[0], random), to);
}
Exact_ray corners(const std::array<Exact_point, 3>& face, const std::array<Exact_point, 3>& other, Random& random) {
  const Exact_point from = random.chance(1, 3) ? other[1] : about(other, face[0], random);
  return towards(from, face[0]);
}
Exact_ray edges(const std::array<Exact_point, 3>& face, const std::array<Exact_point, 3>& other, Random& random) {
  const Exact_point from =
      random.chance(1, 3) ? between(other[0], other[1], share(random, 1, 7, 8)) : about(other, face[0], random);
  return towards(from, between(face[0], face[1], share(random, 0, 8, 8)));
}
Exact_ray grazing(const std::array<Exact_point, 3>& face, const std::array<Exact_point, 3>&, Random& random) {
  if (random.chance(1, 4))
    return towards(between(face[0], face[1], share(random, -8, 16, 8)), face[1]);  // along an edge
  const Exact_point to = in_plane(face, random.chance(1, 2), random);
  return towards(in_plane(face, random.chance(1, 3), random), to);
}
Exact_ray surfaces(const std::array<Exact_point, 3>& face, const std::array<Exact_point, 3>& other, Random& random) {
  const Exact_point to = random.chance(1, 2) ? in_plane(other, true, random) : about(other, face[0], random);
  return towards(in_plane(face, true, random), to);
}
Exact_ray from_afar(const std::array<Exact_point, 3>& face, const std::array<Exact_point, 3>& other, Random& random) {
  const Exact_point to = random.chance(1, 2) ? face[0] : in_plane(face, true, random);
  Exact_ray ray = towards(about(other, face[1], random), to);
  Rational distance = 1;
  mpq_mul_2exp(distance.get_mpq_t(), distance.get_mpq_t(), static_cast<mp_bitcnt_t>(random.between(3, 70)));
  for (std::size_t k = 0; k < 3; ++k) ray.origin[k] = to[k] - distance * ray.direction[k];
  if (random.chance(1, 8))
    for (Rational& x : ray.direction) x = -x;
  return ray;
}

constexpr std::array<Ray_kind, 6> all{{
    {"anywhere", "between two points about the faces", made<anywhere>},
    {"corners", "towards a corner, from anywhere or from another corner", made<corners>},
    {"edges", "towards a point of an edge, from anywhere or from another edge", made<edges>},
    {"grazing", "in a face's plane, some along an edge", made<grazing>},
    {"surfaces", "from a point of a face, to one of another or anywhere", made<surfaces>},
    {"far", "through a corner or a face's inside, from 2^3 to 2^70 times as far", made<from_afar>},
}};

}  // namespace ray_kinds_detail

std::span<const Ray_kind> ray_kinds() { return ray_kinds_detail::all; }

}  // namespace sightline::generate
