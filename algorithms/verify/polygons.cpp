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

Integer_vector cross(const Integer_vector& a, const Integer_vector& b) {
  Integer_vector result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t x = (k + 1) % 3, y = (k + 2) % 3;
    mpz_mul(result[k].get_mpz_t(), a[x].get_mpz_t(), b[y].get_mpz_t());
    mpz_submul(result[k].get_mpz_t(), a[y].get_mpz_t(), b[x].get_mpz_t());
  }
  return result;
}

Integer dot(const Integer_vector& a, const Integer_vector& b) {
  Integer sum;
  for (std::size_t k = 0; k < 3; ++k) mpz_addmul(sum.get_mpz_t(), a[k].get_mpz_t(), b[k].get_mpz_t());
  return sum;
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

Integer_vector primitive(Integer_vector v) {
  thread_local Integer divisor;
  mpz_gcd(divisor.get_mpz_t(), v[0].get_mpz_t(), v[1].get_mpz_t());
  if (divisor != 1) mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), v[2].get_mpz_t());
  if (sgn(divisor) == 0 || divisor == 1) return v;
  for (Integer& n : v) mpz_divexact(n.get_mpz_t(), n.get_mpz_t(), divisor.get_mpz_t());
  return v;
}

Integer_vector primitive(const Exact_point& v) {
  const Homogeneous h = homogeneous(v);
  return primitive(Integer_vector{h[0], h[1], h[2]});
}

namespace {

/// The sum of the triangles of corner 0 with edges from `first` to `last`, half by half: denominators become long once,
/// and not with each that is added.
Exact_point sum_of_fractions(const Polygon& loop, std::size_t first, std::size_t last) {
  if (last <= first) return {};
  if (last == first + 1) return cross(minus(loop[first], loop[0]), minus(loop[last], loop[0]));
  const std::size_t middle = first + (last - first) / 2;
  Exact_point sum = sum_of_fractions(loop, first, middle);
  const Exact_point other = sum_of_fractions(loop, middle, last);
  for (std::size_t k = 0; k < 3; ++k) sum[k] += other[k];
  return sum;
}

}  // namespace

Integer_vector newell_normal(const Polygon& loop) {
  if (loop.size() < 3) return {};
  // Over one denominator, unless that would become much longer than those of the points.
  constexpr std::size_t most_bits = 2048;
  Integer scale = 1;
  for (std::size_t i = 0; i < loop.size() && bit_length(scale) <= most_bits; ++i)
    for (const Rational& x : loop[i])
      if (x.get_den() != scale) mpz_lcm(scale.get_mpz_t(), scale.get_mpz_t(), x.get_den_mpz_t());
  const auto sum_of_parts = [&](const auto& arm) {  // from the first corner
    auto last = arm(1), sum = cross(last, last);    // zero
    for (std::size_t i = 2; i < loop.size(); ++i) {
      auto next = arm(i);
      const auto part = cross(last, next);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
      last = std::move(next);
    }
    return primitive(sum);
  };
  if (bit_length(scale) > most_bits) return primitive(sum_of_fractions(loop, 1, loop.size() - 1));
  const auto scaled = [&](const Rational& x) {
    return x.get_den() == scale ? x.get_num() : Integer(x.get_num() * (scale / x.get_den()));
  };
  const Integer_vector origin{scaled(loop[0][0]), scaled(loop[0][1]), scaled(loop[0][2])};
  return sum_of_parts([&](std::size_t i) {
    Integer_vector difference;
    for (std::size_t k = 0; k < 3; ++k) difference[k] = scaled(loop[i][k]) - origin[k];
    return difference;
  });
}

Homogeneous homogeneous(const Exact_point& p) {
  Homogeneous h{p[0].get_num(), p[1].get_num(), p[2].get_num(), p[0].get_den()};
  if (h[3] == p[1].get_den() && h[3] == p[2].get_den()) return h;
  for (std::size_t k = 1; k < 3; ++k) mpz_lcm(h[3].get_mpz_t(), h[3].get_mpz_t(), p[k].get_den_mpz_t());
  for (std::size_t k = 0; k < 3; ++k) {
    mpz_divexact(h[k].get_mpz_t(), h[3].get_mpz_t(), p[k].get_den_mpz_t());
    h[k] *= p[k].get_num();
  }
  return h;
}

std::vector<Homogeneous> homogeneous(const Polygon& polygon) {
  std::vector<Homogeneous> corners;
  corners.reserve(polygon.size());
  for (const Exact_point& p : polygon) corners.push_back(homogeneous(p));
  return corners;
}

Integer_vector minus(const Homogeneous& a, const Homogeneous& b) {
  Integer_vector difference;
  for (std::size_t k = 0; k < 3; ++k) {
    difference[k] = a[k] * b[3];
    mpz_submul(difference[k].get_mpz_t(), b[k].get_mpz_t(), a[3].get_mpz_t());
  }
  return difference;
}

Homogeneous plane_of(const Plane& plane) {
  const Rational offset = -dot(plane.normal, plane.origin);
  Homogeneous result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = plane.normal[k] * offset.get_den();
  result[3] = offset.get_num();
  return result;
}

Homogeneous plane_of(const Polygon& polygon) { return plane_of(Plane{newell_normal(polygon), polygon[0]}); }

Integer height(const Homogeneous& plane, const Homogeneous& p) {
  return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3];
}

int side(const Homogeneous& plane, const Homogeneous& p) {
  thread_local Integer sum;
  mpz_mul(sum.get_mpz_t(), plane[0].get_mpz_t(), p[0].get_mpz_t());
  for (std::size_t k = 1; k < 4; ++k) mpz_addmul(sum.get_mpz_t(), plane[k].get_mpz_t(), p[k].get_mpz_t());
  return sgn(sum);
}

namespace {

template <class Value>
std::vector<const Value*> pointers_to(const std::vector<Value>& values) {
  std::vector<const Value*> places;
  places.reserve(values.size());
  for (const Value& value : values) places.push_back(&value);
  return places;
}

/// The axis along which a vector is longest.
std::size_t longest(const Integer_vector& v) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (mpz_cmpabs(v[k].get_mpz_t(), v[axis].get_mpz_t()) > 0) axis = k;
  return axis;
}

/// The sign of a b - c d.
int sign_of_difference(const Integer& a, const Integer& b, const Integer& c, const Integer& d) {
  thread_local Integer difference;
  mpz_mul(difference.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  mpz_submul(difference.get_mpz_t(), c.get_mpz_t(), d.get_mpz_t());
  return sgn(difference);
}

/// Around which a convex polygon runs counterclockwise: of its first corner that is not straight. Pre: it has area.
Integer_vector normal_of_convex(Corner_places corners) {
  const Integer_vector first = minus(*corners[1], *corners[0]);
  for (std::size_t i = 2; i < corners.size(); ++i)
    if (Integer_vector normal = cross(first, minus(*corners[i], *corners[0])); !is_zero(normal)) return normal;
  return {};
}

/// The sign of the area that a polygon winds around a normal.
int sign_of_area(Corner_places corners, const Integer_vector& normal) {
  Polygon polygon;
  for (const Homogeneous* const p : corners) {
    Exact_point& q = polygon.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] = Rational((*p)[k], (*p)[3]);
      q[k].canonicalize();
    }
  }
  return sign_of_dot(newell_normal(polygon), normal);
}

}  // namespace

std::string not_convex(const Polygon& polygon, const Plane& plane) {
  return not_convex(homogeneous(polygon), plane_of(plane));
}

std::string not_convex(const std::vector<Homogeneous>& corners, const Homogeneous& plane) {
  return not_convex(pointers_to(corners), plane);
}

std::string not_convex(Corner_places corners, const Homogeneous& plane) {
  const std::size_t n = corners.size();
  if (n < 3) return "has fewer than three vertices";
  // 1. In the plane, and each vertex another one than the next.
  for (const Homogeneous* const p : corners)
    if (side(plane, *p) != 0) return "has a vertex off the plane of its face";
  const Integer_vector normal{plane[0], plane[1], plane[2]};
  std::vector<Integer_vector> edges(n);  // positive multiples
  for (std::size_t i = 0; i < n; ++i) {
    edges[i] = minus(*corners[(i + 1) % n], *corners[i]);
    if (is_zero(edges[i])) return "has a repeated vertex";
  }
  // 2. Every corner turns left by less than 180 degrees, and the edges turn once around in all. Seen along the axis in
  // which the normal is longest.
  const std::size_t axis = longest(normal), x = (axis + 1) % 3, y = (axis + 2) % 3;
  const int sense = sgn(normal[axis]);
  const auto turn = [&](const Integer_vector& a, const Integer_vector& b) {
    return sense * sign_of_difference(a[x], b[y], a[y], b[x]);
  };
  const auto upper = [&](const Integer_vector& edge) {  // angle to edge 0 in [0, 180)
    const int left = turn(edges[0], edge);
    return left > 0 || (left == 0 && sign_of_dot(edges[0], edge) > 0);
  };
  bool turns_left = true;
  std::size_t rounds = 0;
  bool in_upper = upper(edges[0]);
  for (std::size_t i = 0; i < n && turns_left; ++i) {
    const Integer_vector &in = edges[i], &out = edges[(i + 1) % n];
    const int left = turn(in, out);
    turns_left = left > 0 || (left == 0 && sign_of_dot(in, out) > 0);
    const bool out_upper = upper(out);
    rounds += !in_upper && out_upper;
    in_upper = out_upper;
  }
  if (turns_left && rounds == 1) return "";
  // 3. What is wrong with it.
  const int area = sign_of_area(corners, normal);
  if (area <= 0) return area == 0 ? "has zero area" : "is clockwise as seen from the front of its face";
  return turns_left ? "is not convex (it turns more than once around)" : "is not convex";
}

Integer_vector ray_to(const Homogeneous& p, const Homogeneous& eye) { return primitive(minus(p, eye)); }

Cone::Cone(const Polygon& polygon, const Exact_point& eye) : Cone(homogeneous(polygon), homogeneous(eye)) {}

Cone::Cone(const std::vector<Homogeneous>& corners, const Homogeneous& from) {
  std::vector<Integer_vector> to_corners;
  to_corners.reserve(corners.size());
  for (const Homogeneous& p : corners) to_corners.push_back(ray_to(p, from));
  *this = Cone(pointers_to(corners), pointers_to(to_corners), from);
}

Cone::Cone(Corner_places corners, std::span<const Integer_vector* const> all, const Homogeneous& from) {
  const Integer_vector normal = primitive(normal_of_convex(corners));
  Rational height(dot(normal, minus(from, *corners[0])), from[3] * (*corners[0])[3]);
  height.canonicalize();
  edge_on = sgn(height) == 0;
  if (edge_on) return;
  const bool front = sgn(height) > 0;
  rays.reserve(corners.size());
  edge_planes.reserve(corners.size());
  sense = front ? -1 : 1;
  const auto edge_plane = [&](const Integer_vector& first, const Integer_vector& second) {
    Integer_vector plane = cross(first, second);
    if (front)
      for (Integer& x : plane) mpz_neg(x.get_mpz_t(), x.get_mpz_t());
    return plane;
  };
  Integer_vector plane = edge_plane(*all.back(), *all.front());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Integer_vector& next = *all[i + 1 == all.size() ? 0 : i + 1];
    if (sign_of_dot(plane, next) == 0) continue;  // straight on
    plane = edge_plane(*all[i], next);
    rays.push_back(*all[i]);
    edge_planes.push_back(plane);
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
