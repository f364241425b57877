// To be read from top to bottom: numbers near others, sides and turns, then what two faces have in common.

#include <sightline/algorithms/verify/solid_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace sightline::certificate_check {

// ---- Numbers near others; each step adds its rounding, in any rounding mode. Proof: P-116

namespace {
constexpr double rounding = 0x1p-52, of_errors = 1 + 0x1p-48;
}  // namespace

Near operator+(Near a, Near b) {
  const double value = a.value + b.value;
  return {value, (a.error + b.error + std::fabs(value) * rounding) * of_errors};
}
Near operator-(Near a, Near b) { return a + Near{-b.value, b.error}; }
Near operator*(Near a, Near b) {
  const double value = a.value * b.value;
  return {value, (std::fabs(a.value) * b.error + std::fabs(b.value) * a.error + a.error * b.error +
                  std::fabs(value) * rounding) *
                     of_errors};
}

namespace {

Near near(const Rational& x) {
  constexpr double least = 0x1p-150, most = 0x1p150;  // so that no product of three differences or errors underflows
  const double value = x.get_d(), size = std::fabs(value);  // truncated
  if (sgn(x) == 0) return {0, 0};
  if (!(least <= size && size <= most)) return {0, std::numeric_limits<double>::infinity()};
  return {value, size * rounding};
}

// ---- Sides and turns

/// The sign of the determinant of the coordinates x, y and 3 of three points.
int sign_of_determinant(const Homogeneous& p, const Homogeneous& q, const Homogeneous& r, std::size_t x,
                        std::size_t y) {
  thread_local Integer sum, minor;
  const auto add = [&](std::size_t of, std::size_t a, std::size_t b) {
    mpz_mul(minor.get_mpz_t(), q[a].get_mpz_t(), r[b].get_mpz_t());
    mpz_submul(minor.get_mpz_t(), q[b].get_mpz_t(), r[a].get_mpz_t());
    mpz_addmul(sum.get_mpz_t(), p[of].get_mpz_t(), minor.get_mpz_t());
  };
  sum = 0;
  add(x, y, 3);
  add(y, 3, x);
  add(3, x, y);
  return sgn(sum);
}

/// Around which a convex polygon runs counterclockwise, from its first corner that is not straight; else zero.
Integer_vector normal_of(const std::vector<const Solid_point*>& corners) {
  if (corners.size() < 3) return {};
  const Integer_vector first = minus(corners[1]->exact, corners[0]->exact);
  for (std::size_t i = 2; i < corners.size(); ++i)
    if (const Integer_vector normal = cross(first, minus(corners[i]->exact, corners[0]->exact)); !is_zero(normal))
      return primitive(normal);
  return {};
}

std::array<Near, 3> near_cross(const std::array<Near, 3>& a, const std::array<Near, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::array<Near, 3> difference(const Solid_point& a, const Solid_point& b) {
  return {a.near[0] - b.near[0], a.near[1] - b.near[1], a.near[2] - b.near[2]};
}

}  // namespace

Solid_point::Solid_point(const Exact_point& p) : exact(homogeneous(p)), near{} {
  for (std::size_t k = 0; k < 3; ++k) near[k] = certificate_check::near(p[k]);
}

int turn_along(const Solid_point& p, const Solid_point& q, const Solid_point& r, std::size_t axis) {
  if (&r == &p || &r == &q) return 0;
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  const Near turn =
      (q.near[x] - p.near[x]) * (r.near[y] - p.near[y]) - (q.near[y] - p.near[y]) * (r.near[x] - p.near[x]);
  return turn.sign() != 0 ? turn.sign() : sign_of_determinant(p.exact, q.exact, r.exact, x, y);
}

Solid_face::Solid_face(std::vector<Number> of, const std::vector<Solid_point>& points)
    : numbers(std::move(of)), plane{}, normal{} {
  for (const Number number : numbers) corners.push_back(&points[number]);
  const Integer_vector across = normal_of(corners);
  if (is_zero(across)) return;
  // across . x = across . p / w, in lowest terms, as `across` is.
  const Homogeneous& p = corners[0]->exact;
  plane[3] = -dot(across, Integer_vector{p[0], p[1], p[2]});
  Integer common = gcd(plane[3], p[3]);
  plane[3] /= common;
  common = p[3] / common;
  for (std::size_t k = 0; k < 3; ++k) plane[k] = across[k] * common;
  for (std::size_t k = 1; k < 3; ++k)
    if (mpz_cmpabs(plane[k].get_mpz_t(), plane[axis].get_mpz_t()) > 0) axis = k;
  const std::size_t size = corners.size();
  normal = near_cross(difference(*corners[size / 3], *corners[0]), difference(*corners[2 * size / 3], *corners[0]));
}

int Solid_face::side(const Solid_point& p) const {
  const std::array<Near, 3> arm = difference(p, *corners[0]);
  const Near height = normal[0] * arm[0] + normal[1] * arm[1] + normal[2] * arm[2];
  return height.sign() != 0 ? height.sign() : certificate_check::side(plane, p.exact);
}

namespace {

// ---- What two faces in different planes have in common

/// Where the segment from p (at height s) to q (at t, of the other sign) is at height 0.
Homogeneous crossing(const Homogeneous& p, const Integer& s, const Homogeneous& q, const Integer& t) {
  Homogeneous c;
  for (std::size_t k = 0; k < 4; ++k) c[k] = p[k] * t - q[k] * s;
  if (sgn(c[3]) < 0)
    for (Integer& n : c) n = -n;
  return c;
}

Homogeneous mean(const Homogeneous& p, const Homogeneous& q) {
  Homogeneous m;
  for (std::size_t k = 0; k < 3; ++k) m[k] = p[k] * q[3] + q[k] * p[3];
  m[3] = 2 * p[3] * q[3];
  return m;
}

/// Lexicographic: along a line, one way.
bool is_less(const Homogeneous& p, const Homogeneous& q) {
  for (std::size_t k = 0; k < 3; ++k)
    if (const int order = cmp(Integer(p[k] * q[3]), Integer(q[k] * p[3])); order != 0) return order < 0;
  return false;
}

/// How the corners of one face are to the plane of another.
struct Sides {
  bool front = false, behind = false;
  std::size_t count_on = 0;
  std::array<std::size_t, 2> on{};  // places of the first two
};

Sides sides_of(const Solid_face& corners_of, const Solid_face& plane_of) {
  Sides sides;
  for (std::size_t k = 0; k < corners_of.numbers.size(); ++k) {
    const auto& known = plane_of.numbers;
    const bool is_corner = std::find(known.begin(), known.end(), corners_of.numbers[k]) != known.end();
    const int side = is_corner ? 0 : plane_of.side(*corners_of.corners[k]);
    sides.front |= side > 0;
    sides.behind |= side < 0;
    if (side == 0 && sides.count_on++ < 2) sides.on[sides.count_on - 1] = k;
    if (sides.front && sides.behind) break;
  }
  return sides;
}

/// Whether two numbers are the ends of an edge of the face.
bool has_edge(const Solid_face& face, Solid_face::Number p, Solid_face::Number q) {
  const std::size_t size = face.numbers.size();
  for (std::size_t k = 0; k < size; ++k) {
    const auto from = face.numbers[k], to = face.numbers[k + 1 == size ? 0 : k + 1];
    if ((from == p && to == q) || (from == q && to == p)) return true;
  }
  return false;
}

/// Whether b, of which the corners are so to the plane of a, has no more than a point or a whole edge in common with a.
bool is_little(const Solid_face& a, const Solid_face& b, const Sides& sides) {
  if ((sides.front && sides.behind) || sides.count_on > 2) return false;
  if (sides.count_on < 2) return true;
  const auto p = b.numbers[sides.on[0]], q = b.numbers[sides.on[1]];
  return has_edge(b, p, q) && has_edge(a, p, q);
}

/// What b has in common with a, as far as it is inside a.
Contact cuts_into(const Solid_face& a, const Solid_face& b) {
  // 1. Where b meets a's plane.
  std::vector<Homogeneous> ends;
  const std::size_t size = b.corners.size();
  std::vector<Integer> heights;
  for (const Solid_point* p : b.corners) heights.push_back(height(a.plane, p->exact));
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t next = (k + 1) % size;
    if (sgn(heights[k]) == 0) ends.push_back(b.corners[k]->exact);
    else if (sgn(heights[k]) * sgn(heights[next]) < 0)
      ends.push_back(crossing(b.corners[k]->exact, heights[k], b.corners[next]->exact, heights[next]));
  }
  if (ends.empty()) return Contact::little;
  Homogeneous from = ends[0], to = ends[0];
  for (const Homogeneous& end : ends) {  // straight corners may make them more than two
    if (is_less(end, from)) from = end;
    if (is_less(to, end)) to = end;
  }
  if (!is_less(from, to)) return Contact::little;
  // 2. Of that, what a holds.
  const std::size_t corners = a.corners.size(), x = (a.axis + 1) % 3, y = (a.axis + 2) % 3;
  const int sense = sgn(a.plane[a.axis]);
  const auto turn = [&](std::size_t k, const Homogeneous& p) -> Integer {
    const Homogeneous &q = a.corners[k]->exact, &r = a.corners[(k + 1) % corners]->exact;
    const Integer value =
        q[x] * (r[y] * p[3] - p[y] * r[3]) - q[y] * (r[x] * p[3] - p[x] * r[3]) + q[3] * (r[x] * p[y] - p[x] * r[y]);
    return sense > 0 ? value : Integer(-value);
  };
  for (std::size_t k = 0; k < corners; ++k) {
    const Integer s = turn(k, from), t = turn(k, to);
    if (sgn(s) <= 0 && sgn(t) <= 0) return sgn(s) == 0 && sgn(t) == 0 ? Contact::edges : Contact::little;
    if (sgn(s) < 0) from = crossing(from, s, to, t);
    else if (sgn(t) < 0) to = crossing(from, s, to, t);
  }
  const Homogeneous middle = mean(from, to);
  for (std::size_t k = 0; k < corners; ++k)
    if (sgn(turn(k, middle)) <= 0) return Contact::edges;
  return Contact::crossed;
}

// ---- What two faces in one plane have in common

/// Whether all of b is beyond an edge of a, and if so, that they have no more in common than a point or a whole edge.
std::pair<bool, bool> is_beyond_an_edge(const Solid_face& a, const Solid_face& b) {
  const int sense = sgn(a.plane[a.axis]);
  const std::size_t size = a.corners.size();
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t next = k + 1 == size ? 0 : k + 1;
    std::size_t on = 0;
    bool beyond = true;
    for (std::size_t l = 0; l < b.corners.size() && beyond; ++l) {
      const int turn = turn_along(*a.corners[k], *a.corners[next], *b.corners[l], a.axis) * sense;
      beyond = turn <= 0;
      on += turn == 0;
    }
    if (!beyond) continue;
    const auto is_straight = [&](std::size_t corner) {  // the edge's line goes on there
      return turn_along(*a.corners[k], *a.corners[next], *a.corners[corner], a.axis) == 0;
    };
    const bool little = on < 2 || (on == 2 && has_edge(b, a.numbers[k], a.numbers[next]) &&
                                   !is_straight((k + size - 1) % size) && !is_straight((next + 1) % size));
    return {true, little};
  }
  return {false, false};
}

}  // namespace

Contact contact_of(const Solid_face& a, const Solid_face& b) {
  const auto equal = [&](int factor) {
    for (std::size_t k = 0; k < 4; ++k)
      if (mpz_cmpabs(a.plane[k].get_mpz_t(), b.plane[k].get_mpz_t()) != 0 ||
          sgn(a.plane[k]) != factor * sgn(b.plane[k]))
        return false;
    return true;
  };
  if (equal(1) || equal(-1)) {
    auto [apart, little] = is_beyond_an_edge(a, b);
    if (!apart) std::tie(apart, little) = is_beyond_an_edge(b, a);
    return !apart ? Contact::crossed : little ? Contact::little : Contact::edges;
  }
  // The smaller one first: few corners to a plane.
  const bool a_is_smaller = a.corners.size() < b.corners.size();
  const Solid_face &small = a_is_smaller ? a : b, &large = a_is_smaller ? b : a;
  if (is_little(large, small, sides_of(small, large)) || is_little(small, large, sides_of(large, small)))
    return Contact::little;
  const Contact in_large = cuts_into(large, small);
  return in_large == Contact::edges ? std::max(in_large, cuts_into(small, large)) : in_large;
}

}  // namespace sightline::certificate_check
