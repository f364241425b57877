// To be read from top to bottom: numbers near others, sides and turns, then what two faces have in common.

#include <sightline/algorithms/verify/solid_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace sightline::certificate_check {

// ---- Numbers near others. Proof: P-116

Near operator/(Near a, Near b) {
  constexpr double small = 0x1p-500, large = 0x1p500;
  const double value = a.value / b.value, size = std::fabs(value), least = std::fabs(b.value) * (1 - 0x1p-50) - b.error;
  if (!(least > small && least > b.error && size < large)) return {0, std::numeric_limits<double>::infinity()};
  return {value, (a.error / least + size * (b.error / least) + size * Near::rounding + small) * Near::of_errors};
}

namespace {

Near near(const Rational& x) {
  constexpr double least = 0x1p-150, most = 0x1p150;        // so that products of a few do not overflow
  const double value = x.get_d(), size = std::fabs(value);  // truncated
  if (sgn(x) == 0) return {0, 0};
  if (!(least <= size && size <= most)) return {0, std::numeric_limits<double>::infinity()};
  return {value, size * Near::rounding};
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
    if (Integer_vector normal = cross(first, minus(corners[i]->exact, corners[0]->exact)); !is_zero(normal))
      return primitive(std::move(normal));
  return {};
}

Polygon points_of(const std::vector<const Solid_point*>& corners) {
  Polygon points;
  for (const Solid_point* p : corners) {
    Exact_point& q = points.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] = Rational(p->exact[k], p->exact[3]);
      q[k].canonicalize();
    }
  }
  return points;
}

Near_point near_cross(const Near_point& a, const Near_point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The scalar product, by fewer steps than of three products.
Near near_dot(const Near_point& a, const Near_point& b) {
  Near sum;
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double term = a[k].value * b[k].value;
    sum.value += term;
    size += std::fabs(term);
    sum.error += std::fabs(a[k].value) * b[k].error + a[k].error * (std::fabs(b[k].value) + b[k].error);
  }
  sum.error = (sum.error + size * (4 * Near::rounding) + Near::of_underflow) * Near::of_errors;
  return sum;
}

Near_point difference(const Near_point& a, const Near_point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Twice the area that is turned around.
Near near_turn(const Near_point& p, const Near_point& q, const Near_point& r, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  return (q[x] - p[x]) * (r[y] - p[y]) - (q[y] - p[y]) * (r[x] - p[x]);
}

}  // namespace

Solid_point::Solid_point(const Exact_point& p) : exact(homogeneous(p)), near{} {
  for (std::size_t k = 0; k < 3; ++k) near[k] = certificate_check::near(p[k]);
}

int turn_along(const Solid_point& p, const Solid_point& q, const Solid_point& r, std::size_t axis) {
  if (&r == &p || &r == &q) return 0;
  const int near = turn_along(p.near, q.near, r.near, axis);
  return near != 0 ? near : sign_of_determinant(p.exact, q.exact, r.exact, (axis + 1) % 3, (axis + 2) % 3);
}

int turn_along(const Near_point& p, const Near_point& q, const Near_point& r, std::size_t axis) {
  return near_turn(p, q, r, axis).sign();
}

namespace {

/// The plane of the first three of a polygon's corners, canonical, where machine numbers suffice: they are on one grid,
/// and near each other beside its step. Nothing is said where they do not, nor of corners on one line.
std::optional<Homogeneous> small_plane(const std::vector<const Solid_point*>& corners) {
  constexpr long near = 1L << 30;  // products of differences, and differences of these, are below 2^61
  if (corners.size() < 3) return std::nullopt;
  const Homogeneous& p = corners[0]->exact;
  for (const Integer& n : p)
    if (!n.fits_slong_p()) return std::nullopt;
  std::array<std::array<long, 3>, 2> arms{};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const Integer& n = corners[i + 1]->exact[k];
      if (!n.fits_slong_p() || (k == 3 && n != p[3])) return std::nullopt;
      if (k == 3) continue;
      const __int128 arm = __int128{n.get_si()} - p[k].get_si();
      if (arm <= -near || arm >= near) return std::nullopt;
      arms[i][k] = static_cast<long>(arm);
    }
  std::array<long, 3> normal = cross(arms[0], arms[1]);
  const long divisor = std::gcd(std::gcd(normal[0], normal[1]), normal[2]);
  if (divisor == 0) return std::nullopt;
  // normal . x = normal . p / w, in lowest terms once `normal` is.
  __int128 offset = 0;
  for (std::size_t k = 0; k < 3; ++k) offset -= __int128{normal[k] /= divisor} * p[k].get_si();
  const long w = p[3].get_si(), common = std::gcd(static_cast<long>(offset % w), w);
  offset /= common;
  if (offset != static_cast<long>(offset)) return std::nullopt;
  Homogeneous plane{normal[0], normal[1], normal[2], static_cast<long>(offset)};
  for (std::size_t k = 0; k < 3; ++k) plane[k] *= w / common;
  return plane;
}

/// The same of any corners, from the first one that is not straight; zero where there is none.
Homogeneous plane_of_corners(const std::vector<const Solid_point*>& corners) {
  if (auto plane = small_plane(corners)) return *std::move(plane);
  Homogeneous plane;
  Integer_vector across = normal_of(corners);
  if (is_zero(across)) return plane;
  const Homogeneous& p = corners[0]->exact;
  for (std::size_t k = 0; k < 3; ++k) mpz_submul(plane[3].get_mpz_t(), across[k].get_mpz_t(), p[k].get_mpz_t());
  Integer common = gcd(plane[3], p[3]);
  plane[3] /= common;
  common = p[3] / common;
  for (std::size_t k = 0; k < 3; ++k) plane[k] = across[k] * common;
  return plane;
}

}  // namespace

Solid_face::Solid_face(std::vector<Number> of, const std::vector<Solid_point>& points)
    : numbers(std::move(of)), normal{} {
  corners.reserve(numbers.size());
  for (const Number number : numbers) corners.push_back(&points[number]);
  plane = plane_of_corners(corners);
  for (std::size_t k = 1; k < 3; ++k)
    if (mpz_cmpabs(plane[k].get_mpz_t(), plane[axis].get_mpz_t()) > 0) axis = k;
  if (!has_plane()) return;
  const std::size_t size = corners.size();
  const Near_point& origin = corners[0]->near;
  normal = near_cross(difference(corners[size / 3]->near, origin), difference(corners[2 * size / 3]->near, origin));
}

Near Solid_face::height(const Near_point& p) const { return near_dot(normal, difference(p, corners[0]->near)); }

int Solid_face::side(const Solid_point& p) const {
  const int near = height(p.near).sign();
  return near != 0 ? near : certificate_check::side(plane, p.exact);
}

Near_point Solid_face::lifted(Near_point p) const {
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  const Near_point& origin = corners[0]->near;
  p[axis] = origin[axis] - (normal[x] * (p[x] - origin[x]) + normal[y] * (p[y] - origin[y])) / normal[axis];
  return p;
}

Outward_box Solid_face::box() const {
  Outward_box box;
  for (const Solid_point* p : corners)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [value, error] = p->near[k];
      if (!std::isfinite(error)) return Outward_box(points_of(corners));
      box.low[k] = std::min(box.low[k], value - 2 * error);
      box.high[k] = std::max(box.high[k], value + 2 * error);
    }
  return box;
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

bool has_corner(const Solid_face& face, Solid_face::Number number) {
  return std::find(face.numbers.begin(), face.numbers.end(), number) != face.numbers.end();
}
/// Whether a corner of another face is known to be on the plane, as it is a corner of a face there.
bool is_known_on(const Solid_face& plane_of, const Solid_face& face, std::size_t corner) {
  const auto& planes = face.corners[corner]->planes;
  return has_corner(plane_of, face.numbers[corner]) ||
         std::find(planes.begin(), planes.end(), plane_of.plane_number) != planes.end();
}
int side_of(const Solid_face& plane_of, const Solid_face& face, std::size_t corner) {
  if (has_corner(plane_of, face.numbers[corner])) return 0;
  const int near = plane_of.side(face.corners[corner]->near);
  return near != 0 || is_known_on(plane_of, face, corner) ? near : plane_of.side(*face.corners[corner]);
}

/// How the corners of one face are to the plane of another.
struct Sides {
  bool front = false, behind = false;
  std::size_t count_on = 0;
  std::array<std::size_t, 2> on{};  // places of the first two
  bool both() const { return front && behind; }
};

Sides sides_of(const Solid_face& corners_of, const Solid_face& plane_of) {
  Sides sides;
  for (std::size_t k = 0; k < corners_of.numbers.size(); ++k) {
    const int side = side_of(plane_of, corners_of, k);
    sides.front |= side > 0;
    sides.behind |= side < 0;
    if (side == 0 && sides.count_on++ < 2) sides.on[sides.count_on - 1] = k;
    if (sides.both()) break;
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
  if (sides.both() || sides.count_on > 2) return false;
  if (sides.count_on < 2) return true;
  const auto p = b.numbers[sides.on[0]], q = b.numbers[sides.on[1]];
  return has_edge(b, p, q) && has_edge(a, p, q);
}

/// The turn from the edge that begins at one corner of a to a corner of b, as seen against a's axis, and then from a's
/// front: zero at the edge's own ends.
Near turn_at_edge(const Solid_face& a, std::size_t edge, const Solid_face& b, std::size_t corner) {
  const std::size_t next = edge + 1 == a.corners.size() ? 0 : edge + 1;
  if (b.numbers[corner] == a.numbers[edge] || b.numbers[corner] == a.numbers[next]) return {0, 0};
  const Near turn = near_turn(a.corners[edge]->near, a.corners[next]->near, b.corners[corner]->near, a.axis);
  return sgn(a.plane[a.axis]) > 0 ? turn : Near{-turn.value, turn.error};
}
/// Known not to be positive.
bool is_outside(Near turn) { return turn.value <= -turn.error; }

/// Whether doubles tell that b, which has corners strictly on both sides of a's plane, has nothing inside a.
bool passes_by(const Solid_face& a, const Solid_face& b) {
  // 1. The two ends of b's stretch in a's plane: between corners, or at one corner, with weights.
  struct End {
    std::array<std::size_t, 2> corners;
    std::array<Near, 2> weights;
  };
  std::array<End, 2> ends;
  std::size_t count = 0;
  const auto is_full = [&] { return count == ends.size(); };
  const std::size_t size = b.corners.size();
  const auto height_of = [&](std::size_t k, bool& known) {
    known = is_known_on(a, b, k);
    return known ? Near{} : a.height(b.corners[k]->near);
  };
  bool was_on = false, is_on = false;
  Near last = height_of(size - 1, was_on);
  for (std::size_t k = 0; k < size; ++k) {
    const Near here = height_of(k, is_on);
    if (!is_on && here.sign() == 0) return false;
    if (is_on || (!was_on && here.sign() != last.sign())) {
      if (is_full()) return false;
      const auto size_of = [](Near x) { return Near{std::fabs(x.value), x.error}; };
      if (is_on) ends[count++] = {{k, k}, {Near{1, 0}, Near{}}};
      else ends[count++] = {{k == 0 ? size - 1 : k - 1, k}, {size_of(here), size_of(last)}};
    }
    last = here;
    was_on = is_on;
  }
  if (!is_full()) return false;
  // 2. An edge that both are beyond, or on the line of.
  const auto is_beyond = [&](std::size_t edge, const End& end) {
    const Near turn = turn_at_edge(a, edge, b, end.corners[0]);
    if (end.corners[0] == end.corners[1]) return is_outside(turn);
    const Near other = turn_at_edge(a, edge, b, end.corners[1]);
    return (is_outside(turn) && is_outside(other)) || is_outside(turn * end.weights[0] + other * end.weights[1]);
  };
  for (std::size_t edge = 0; edge < a.corners.size(); ++edge)
    if (is_beyond(edge, ends[0]) && is_beyond(edge, ends[1])) return true;
  return false;
}

/// Whether two corners of b in a's plane are beyond an edge of a, or on its line.
bool are_beyond_an_edge(const Solid_face& a, const Solid_face& b, const std::array<std::size_t, 2>& corners) {
  const std::size_t size = a.corners.size();
  const auto all = [&](const auto& is_beyond) { return std::all_of(corners.begin(), corners.end(), is_beyond); };
  for (std::size_t k = 0; k < size; ++k)
    if (all([&](std::size_t corner) { return is_outside(turn_at_edge(a, k, b, corner)); })) return true;
  const int sense = sgn(a.plane[a.axis]);
  for (std::size_t k = 0; k < size; ++k)
    if (all([&](std::size_t corner) {
          return turn_along(*a.corners[k], *a.corners[k + 1 == size ? 0 : k + 1], *b.corners[corner], a.axis) * sense <=
                 0;
        }))
      return true;
  return false;
}

/// The sign of a coordinate of p less that of q.
int order_along(const Solid_point& p, const Solid_point& q, std::size_t k) {
  if (&p == &q) return 0;
  const int near = (p.near[k] - q.near[k]).sign();
  return near != 0 ? near : cmp(Integer(p.exact[k] * q.exact[3]), Integer(q.exact[k] * p.exact[3]));
}

/// Whether edges on one line have more in common than a point.
bool overlap_on_a_line(std::array<const Solid_point*, 2> one, std::array<const Solid_point*, 2> other) {
  std::size_t k = 0;
  while (k < 2 && order_along(*one[0], *one[1], k) == 0) ++k;
  if (order_along(*one[0], *one[1], k) > 0) std::swap(one[0], one[1]);
  if (order_along(*other[0], *other[1], k) > 0) std::swap(other[0], other[1]);
  return order_along(*one[0], *other[1], k) < 0 && order_along(*other[0], *one[1], k) < 0;
}

/// What faces in different planes have in common where that is told by few signs. Proof: P-115
std::optional<Contact> simple_contact(const Solid_face& a, const Sides& of_a, const Solid_face& b, const Sides& of_b) {
  // 1. Each is on one side of the other's plane: edges on the line of both planes.
  if (!of_a.both() && !of_b.both()) {
    if (of_a.count_on != 2 || of_b.count_on != 2) return std::nullopt;
    const auto ends = [](const Solid_face& face, const Sides& sides) {
      return std::array{face.corners[sides.on[0]], face.corners[sides.on[1]]};
    };
    return overlap_on_a_line(ends(a, of_a), ends(b, of_b)) ? Contact::edges : Contact::little;
  }
  // 2. One passes the other's plane with its inside, to which the other has only an edge: that is not inside.
  if (of_a.both() != of_b.both()) {
    const auto& [across, along, sides] = of_a.both() ? std::tie(a, b, of_b) : std::tie(b, a, of_a);
    if (sides.count_on == 2 && are_beyond_an_edge(across, along, sides.on)) return Contact::little;
    return std::nullopt;
  }
  // 3. Both do: the insides of what they have of that line are apart.
  if (passes_by(a, b) || passes_by(b, a)) return Contact::little;
  return std::nullopt;
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

bool is_in_plane_of(const Solid_face& a, const Solid_face& b) {
  const auto equal = [&](int factor) {
    for (std::size_t k = 0; k < 4; ++k)
      if (mpz_cmpabs(a.plane[k].get_mpz_t(), b.plane[k].get_mpz_t()) != 0 ||
          sgn(a.plane[k]) != factor * sgn(b.plane[k]))
        return false;
    return true;
  };
  return equal(1) || equal(-1);
}

Contact contact_of(const Solid_face& a, const Solid_face& b) {
  const bool is_told = a.plane_number != Solid_face::no_number && b.plane_number != Solid_face::no_number;
  if (is_told ? a.plane_number == b.plane_number : is_in_plane_of(a, b)) {
    auto [apart, little] = is_beyond_an_edge(a, b);
    if (!apart) std::tie(apart, little) = is_beyond_an_edge(b, a);
    return !apart ? Contact::crossed : little ? Contact::little : Contact::edges;
  }
  // The smaller one first: few corners to a plane.
  const bool a_is_smaller = a.corners.size() < b.corners.size();
  const Solid_face &small = a_is_smaller ? a : b, &large = a_is_smaller ? b : a;
  const Sides of_small = sides_of(small, large);
  if (is_little(large, small, of_small)) return Contact::little;
  const Sides of_large = sides_of(large, small);
  if (is_little(small, large, of_large)) return Contact::little;
  if (const auto simple = simple_contact(small, of_small, large, of_large)) return *simple;
  const Contact in_large = cuts_into(large, small);
  return in_large == Contact::edges ? std::max(in_large, cuts_into(small, large)) : in_large;
}

}  // namespace sightline::certificate_check
