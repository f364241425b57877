// To be read first, in the order of polygons.h.

#include <sightline/algorithms/verify/polygons.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sightline::certificate_check {

Exact_point minus(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
}

Rational dot(const Integer_vector& a, const Exact_point& b) {
  return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

Integer dot(const Integer_vector& a, const Integer_vector& b) {
  return Integer(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

int sign_of_dot(const Integer_vector& a, const Integer_vector& b) {
  thread_local Integer sum;  // reused: most of the time of a check is spent here
  mpz_mul(sum.get_mpz_t(), a[0].get_mpz_t(), b[0].get_mpz_t());
  mpz_addmul(sum.get_mpz_t(), a[1].get_mpz_t(), b[1].get_mpz_t());
  mpz_addmul(sum.get_mpz_t(), a[2].get_mpz_t(), b[2].get_mpz_t());
  return sgn(sum);
}

bool is_zero(const Integer_vector& a) { return sgn(a[0]) == 0 && sgn(a[1]) == 0 && sgn(a[2]) == 0; }

Integer_vector negated(const Integer_vector& a) { return {Integer(-a[0]), Integer(-a[1]), Integer(-a[2])}; }

Integer_vector primitive(const Integer_vector& v) {
  const Integer divisor = gcd(gcd(v[0], v[1]), v[2]);
  if (sgn(divisor) == 0) return v;
  return {Integer(v[0] / divisor), Integer(v[1] / divisor), Integer(v[2] / divisor)};
}

Integer_vector primitive(const Exact_point& v) {
  const Integer scale = lcm(lcm(v[0].get_den(), v[1].get_den()), v[2].get_den());
  Integer_vector scaled;
  for (std::size_t k = 0; k < 3; ++k) scaled[k] = v[k].get_num() * (scale / v[k].get_den());
  return primitive(scaled);
}

Integer_vector newell_normal(const Polygon& loop) {
  Exact_point sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Exact_point part = cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return primitive(sum);
}

Homogeneous homogeneous(const Exact_point& p) {
  const Integer scale = lcm(lcm(p[0].get_den(), p[1].get_den()), p[2].get_den());
  Homogeneous h;
  for (std::size_t k = 0; k < 3; ++k) h[k] = p[k].get_num() * (scale / p[k].get_den());
  h[3] = scale;
  return h;
}

Homogeneous plane_of(const Polygon& polygon) {
  const Integer_vector normal = newell_normal(polygon);
  const Rational offset = -dot(normal, polygon[0]);
  Homogeneous plane;
  for (std::size_t k = 0; k < 3; ++k) plane[k] = normal[k] * offset.get_den();
  plane[3] = offset.get_num();
  return plane;
}

int side(const Homogeneous& plane, const Homogeneous& p) {
  thread_local Integer sum;
  mpz_mul(sum.get_mpz_t(), plane[0].get_mpz_t(), p[0].get_mpz_t());
  for (std::size_t k = 1; k < 4; ++k) mpz_addmul(sum.get_mpz_t(), plane[k].get_mpz_t(), p[k].get_mpz_t());
  return sgn(sum);
}

std::string not_convex(const Polygon& polygon, const Plane& plane) {
  const std::size_t n = polygon.size();
  if (n < 3) return "has fewer than three vertices";
  for (const Exact_point& p : polygon)
    if (plane.side(p) != 0) return "has a vertex off the plane of its face";
  std::vector<Integer_vector> edges(n);
  for (std::size_t i = 0; i < n; ++i) {
    edges[i] = primitive(minus(polygon[(i + 1) % n], polygon[i]));
    if (is_zero(edges[i])) return "has a repeated vertex";
  }
  const int area = sign_of_dot(newell_normal(polygon), plane.normal);
  if (area <= 0) return area == 0 ? "has zero area" : "is clockwise as seen from the front of its face";
  // Every corner turns left by less than 180 degrees, and the edges turn once around in all.
  const auto turn = [&](const Integer_vector& a, const Integer_vector& b) {
    return sign_of_dot(cross(a, b), plane.normal);
  };
  const auto upper = [&](const Integer_vector& edge) {  // angle to edge 0 in [0, 180)
    const int left = turn(edges[0], edge);
    return left > 0 || (left == 0 && sign_of_dot(edges[0], edge) > 0);
  };
  std::size_t rounds = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Integer_vector &in = edges[i], &out = edges[(i + 1) % n];
    const int left = turn(in, out);
    if (left < 0 || (left == 0 && sign_of_dot(in, out) < 0)) return "is not convex";
    rounds += !upper(in) && upper(out);
  }
  return rounds == 1 ? "" : "is not convex (it turns more than once around)";
}

Cone::Cone(const Polygon& polygon, const Exact_point& eye) {
  const Integer_vector normal = newell_normal(polygon);
  const Rational height = dot(normal, minus(eye, polygon[0]));
  edge_on = sgn(height) == 0;
  if (edge_on) return;
  const bool front = sgn(height) > 0;
  std::vector<Integer_vector> all;
  for (const Exact_point& p : polygon) all.push_back(primitive(minus(p, eye)));
  const auto edge_plane = [&](std::size_t i) {
    const Integer_vector plane = primitive(cross(all[i], all[(i + 1) % all.size()]));
    return front ? negated(plane) : plane;
  };
  Integer_vector previous = edge_plane(all.size() - 1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Integer_vector next = edge_plane(i);
    if (next == previous) continue;  // a straight corner
    rays.push_back(all[i]);
    edge_planes.push_back(next);
    previous = std::move(next);
  }
  const Integer_vector inward = front ? negated(normal) : normal;
  for (std::size_t k = 0; k < 3; ++k) nearness[k] = inward[k] * height.get_den();
  distance = abs(height.get_num());  // coprime to nearness, as the normal is primitive and the height reduced
}

bool separates(const Cone& a, const Cone& b) {
  return std::any_of(a.edge_planes.begin(), a.edge_planes.end(), [&](const Integer_vector& plane) {
    return std::none_of(b.rays.begin(), b.rays.end(),
                        [&](const Integer_vector& ray) { return sign_of_dot(plane, ray) > 0; });
  });
}

}  // namespace sightline::certificate_check
