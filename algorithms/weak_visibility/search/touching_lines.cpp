#include <sightline/algorithms/weak_visibility/search/touching_lines.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace sightline {
namespace {

constexpr std::size_t most_bounds = 24, most_tries = 8;
// Of lines with entries up to 1, in doubles: what is taken for 0, and for a side that is passed.
constexpr double nothing = 1e-9, past = 1e-7;

template <class Number>
using Pluecker_in = std::array<Number, 6>;

/// A line that bounds a cell: direction, then moment.
struct Bound {
  Exact_pluecker exact;
  Pluecker near;
  int sign;  ///< of the path; 0: an edge of a polygon
};

/// Moment, then direction: its product with another line is 0 where they meet.
template <class Number>
Pluecker_in<Number> dual(const Pluecker_in<Number>& l) {
  return {l[3], l[4], l[5], l[0], l[1], l[2]};
}

template <class Number>
Number meeting(const Pluecker_in<Number>& a, const Pluecker_in<Number>& b) {
  Number sum = 0;
  for (std::size_t k = 0; k < 6; ++k) sum += a[k] * b[(k + 3) % 6];
  return sum;
}

double magnitude(double x) { return std::fabs(x); }
Rational magnitude(const Rational& x) { return abs(x); }

void normalize(Pluecker& l) {
  double most = 0;
  for (const double x : l) most = std::max(most, std::fabs(x));
  if (most > 0)
    for (double& x : l) x /= most;
}

/// Divides by the greatest common divisor.
void reduce(std::span<Integer> numbers) {
  Integer divisor = 0;
  for (const Integer& x : numbers) divisor = gcd(divisor, x);
  if (sgn(divisor) != 0)
    for (Integer& x : numbers) x /= divisor;
}

/// Those of the path, then the edges of the source, then those of the target.
std::vector<Bound> bounds_of(const Line_cell& cell) {
  std::vector<Bound> bounds;
  for (const Line_cell::Row& row : cell.rows) {
    const Edge_lines::Edge_line& line = (*cell.lines)[row.literal.line];
    bounds.push_back({line.exact(), line.near, row.literal.sign});
  }
  for (const Near_polygon* polygon : {&cell.domain->source, &cell.domain->target})
    for (std::size_t i = 0; i < polygon->size(); ++i) {
      const Near_point &a = (*polygon)[i], &b = (*polygon)[(i + 1) % polygon->size()];
      bounds.push_back({dual(pluecker_of_pair(b.exact, a.exact)), pluecker_of_edge(a.near, b.near), 0});
    }
  for (Bound& bound : bounds) normalize(bound.near);
  return bounds;
}

using Four = std::array<const Bound*, 4>;

/// Two lines that all lines which meet four others are combinations of, those on no quadric included. False where the
/// four are dependent.
template <class Number>
bool span_of_meeting(std::array<Pluecker_in<Number>, 4> rows, const Number& zero,
                     std::array<Pluecker_in<Number>, 2>& basis) {
  std::array<std::size_t, 4> pivots{};
  std::array<bool, 6> used{};
  for (std::size_t r = 0; r < 4; ++r) {
    std::size_t best = 6;
    for (std::size_t c = 0; c < 6; ++c)
      if (!used[c] && (best == 6 || magnitude(rows[r][c]) > magnitude(rows[r][best]))) best = c;
    if (magnitude(rows[r][best]) <= zero) return false;
    used[best] = true;
    pivots[r] = best;
    const Number inverse = 1 / rows[r][best];
    for (Number& x : rows[r]) x *= inverse;
    for (std::size_t k = 0; k < 4; ++k) {
      if (k == r) continue;
      const Number factor = rows[k][best];
      for (std::size_t c = 0; c < 6; ++c) rows[k][c] -= factor * rows[r][c];
    }
  }
  std::size_t next = 0;
  for (std::size_t c = 0; c < 6; ++c) {
    if (used[c]) continue;
    Pluecker_in<Number>& v = basis[next++];
    v = {};
    v[c] = 1;
    for (std::size_t r = 0; r < 4; ++r) v[pivots[r]] = -rows[r][c];
  }
  return true;
}

/// Where a line meets a plane, in homogeneous coordinates; the last one is 0 where they are parallel.
template <class Number>
std::array<Number, 4> meet(const Pluecker_in<Number>& l, const std::array<Number, 4>& h) {
  const std::array<Number, 3> n{h[0], h[1], h[2]}, d{l[0], l[1], l[2]}, m{l[3], l[4], l[5]};
  const std::array<Number, 3> x = cross(n, m);
  return {Number(x[0] - h[3] * d[0]), Number(x[1] - h[3] * d[1]), Number(x[2] - h[3] * d[2]), Number(dot(n, d))};
}

/// The lines that meet four bounds, in doubles: two, or one where they are nearly one.
std::vector<Pluecker> near_lines(const Four& four) {
  std::array<Pluecker, 4> rows;
  for (std::size_t k = 0; k < 4; ++k) rows[k] = dual(four[k]->near);
  std::array<Pluecker, 2> basis;
  if (!span_of_meeting(rows, nothing, basis)) return {};
  for (Pluecker& v : basis) normalize(v);
  // a s^2 + 2 b s t + c t^2 = 0.
  const double a = meeting(basis[0], basis[0]), b = meeting(basis[0], basis[1]), c = meeting(basis[1], basis[1]),
               discriminant = b * b - a * c;
  if (std::fabs(a) + std::fabs(b) + std::fabs(c) < nothing || discriminant < -nothing) return {};
  const double root = discriminant < nothing ? 0 : std::sqrt(discriminant), q = b > 0 ? -b - root : -b + root;
  std::vector<Pluecker> lines;
  const auto add = [&](double s, double t) {
    Pluecker& l = lines.emplace_back();
    for (std::size_t k = 0; k < 6; ++k) l[k] = s * basis[0][k] + t * basis[1][k];
    normalize(l);
  };
  const bool first = std::fabs(a) >= std::fabs(c);
  if (first || root > 0) add(q, a);
  if (!first || root > 0) add(c, q);
  return lines;
}

/// Whether a point is nearly in a convex polygon of that plane.
bool is_nearly_in(const Near_polygon& polygon, const Triple& x, const Near_plane& h) {
  int sign = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Triple &a = polygon[i].near, &b = polygon[(i + 1) % polygon.size()].near;
    const Triple along = minus(b, a);
    const double turn = dot(cross(along, minus(x, a)), Triple{h.near[0], h.near[1], h.near[2]}) / size(along);
    if (std::fabs(turn) <= nothing) continue;
    const int own = turn > 0 ? 1 : -1;
    if (sign == -own) return false;
    sign = own;
  }
  return true;
}

bool nearly_touches(const Line_cell& cell, const std::vector<Bound>& bounds, const Pluecker& l, const Near_plane& s,
                    const Near_plane& t) {
  const std::array<double, 4> p = meet(l, s.near), q = meet(l, t.near);
  if (std::fabs(p[3]) < nothing || std::fabs(q[3]) < nothing) return false;
  const Triple from{p[0] / p[3], p[1] / p[3], p[2] / p[3]}, to{q[0] / q[3], q[1] / q[3], q[2] / q[3]};
  if (!is_nearly_in(cell.domain->source, from, s) || !is_nearly_in(cell.domain->target, to, t)) return false;
  const Pluecker pair = pluecker_of_pair(from, to);
  return std::none_of(bounds.begin(), bounds.end(),
                      [&](const Bound& bound) { return bound.sign * dot(pair, bound.near) < -past; });
}

/// The rational lines that meet four bounds.
std::vector<Exact_pluecker> rational_lines(const Four& four) {
  std::array<Pluecker_in<Rational>, 4> rows;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t x = 0; x < 6; ++x) rows[k][x] = four[k]->exact[(x + 3) % 6];
  std::array<Pluecker_in<Rational>, 2> basis;
  if (!span_of_meeting(rows, Rational(0), basis)) return {};
  const Rational a = meeting(basis[0], basis[0]), b = meeting(basis[0], basis[1]), c = meeting(basis[1], basis[1]),
                 discriminant = b * b - a * c;
  if (sgn(a) == 0 && sgn(b) == 0 && sgn(c) == 0) return {};
  if (sgn(discriminant) < 0 || mpz_perfect_square_p(discriminant.get_num_mpz_t()) == 0 ||
      mpz_perfect_square_p(discriminant.get_den_mpz_t()) == 0)
    return {};
  const Rational root(sqrt(discriminant.get_num()), sqrt(discriminant.get_den()));
  std::vector<std::array<Rational, 2>> solutions;
  if (sgn(a) == 0) solutions.push_back({Rational(1), Rational(0)});
  else solutions.push_back({Rational(root - b), a});
  if (sgn(root) != 0) {
    if (sgn(a) == 0) solutions.push_back({Rational(-c), Rational(2 * b)});
    else solutions.push_back({Rational(-root - b), a});
  }
  std::vector<Exact_pluecker> lines;
  for (const auto& [u, v] : solutions) {
    Pluecker_in<Rational> l;
    for (std::size_t k = 0; k < 6; ++k) l[k] = u * basis[0][k] + v * basis[1][k];
    reduce(lines.emplace_back(Over_common(l).whole));
  }
  return lines;
}

/// A line with what it touches; nothing where it is not in the closure of the cell, or in the plane of a polygon.
std::optional<Touching_line> touching(const Line_cell& cell, const std::vector<Bound>& bounds,
                                      const Exact_pluecker& line, const Near_plane& s, const Near_plane& t) {
  Touching_line found{meet(line, s.exact), meet(line, t.exact), {}};
  for (std::array<Integer, 4>* x : {&found.from, &found.to}) {
    if (sgn((*x)[3]) == 0) return {};
    if (sgn((*x)[3]) < 0)
      for (Integer& y : *x) y = -y;
    reduce(*x);
  }
  const Exact_pluecker pair = pluecker_of_pair(found.from, found.to);
  const std::size_t source = cell.rows.size(), target = source + cell.domain->source.size();
  std::array<bool, 2> positive{}, negative{};  // of edges of the source, of the target
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    const int sign = sgn(dot(pair, bounds[k].exact));
    if (sign * bounds[k].sign < 0) return {};
    if (sign == 0) found.met.push_back(bounds[k].exact);
    if (k < source) continue;
    (sign > 0 ? positive : negative)[k < target ? 0 : 1] |= sign != 0;
  }
  if (positive[0] == negative[0] || positive[1] == negative[1]) return {};
  return found;
}

/// The plane of a touching line and a point; zero where the point is on the line.
std::array<Integer, 4> plane_through(const Touching_line& line, const std::array<Integer, 4>& x) {
  const std::array<Integer, 4>&a = line.from, &b = line.to;
  const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) {
    return Integer(a[i] * (b[j] * x[k] - b[k] * x[j]) - a[j] * (b[i] * x[k] - b[k] * x[i]) +
                   a[k] * (b[i] * x[j] - b[j] * x[i]));
  };
  std::array<Integer, 4> h{minor(1, 2, 3), Integer(-minor(0, 2, 3)), minor(0, 1, 3), Integer(-minor(0, 1, 2))};
  reduce(h);
  return h;
}

bool is_plane(const std::array<Integer, 4>& h) { return sgn(h[0]) != 0 || sgn(h[1]) != 0 || sgn(h[2]) != 0; }

/// The plane of a touching line and one that it meets: through a point of that on a plane of coordinates, or at
/// infinity.
std::array<Integer, 4> plane_of(const Touching_line& line, const Exact_pluecker& met) {
  std::array<Integer, 4> plane{};
  for (std::size_t k = 0; k < 4 && !is_plane(plane); ++k) {
    std::array<Integer, 4> h{};
    h[k] = 1;
    plane = plane_through(line, meet(met, h));
  }
  return plane;
}

}  // namespace

std::vector<Touching_line> touching_lines(const Line_cell& cell, const Near_plane& source_plane,
                                          const Near_plane& target_plane) {
  const std::vector<Bound> bounds = bounds_of(cell);
  const std::size_t n = bounds.size();
  std::vector<Touching_line> found;
  if (n > most_bounds) return found;
  // Lines by doubles, each with how often fours that seem to meet it were solved exactly; where edges are ulps from
  // meeting one line there are thousands of those.
  struct Seen {
    Pluecker line;
    std::size_t tries;
  };
  std::vector<Seen> seen;
  const auto is_worth_it = [&](const Pluecker& line) {
    for (Seen& other : seen) {
      double same = 0, opposite = 0;
      for (std::size_t x = 0; x < 6; ++x) {
        same = std::max(same, std::fabs(line[x] - other.line[x]));
        opposite = std::max(opposite, std::fabs(line[x] + other.line[x]));
      }
      if (std::min(same, opposite) < nothing) return other.tries++ < most_tries;
    }
    seen.push_back({line, 1});
    return true;
  };
  const auto look = [&](const Four& four) {
    const std::vector<Pluecker> near = near_lines(four);
    if (std::none_of(near.begin(), near.end(), [&](const Pluecker& line) {
          return nearly_touches(cell, bounds, line, source_plane, target_plane) && is_worth_it(line);
        }))
      return;
    for (const Exact_pluecker& line : rational_lines(four))
      if (std::optional<Touching_line> touched = touching(cell, bounds, line, source_plane, target_plane);
          touched && std::none_of(found.begin(), found.end(), [&](const Touching_line& other) {
            return other.from == touched->from && other.to == touched->to;
          }))
        found.push_back(std::move(*touched));
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k)
        for (std::size_t m = k + 1; m < n; ++m) look({&bounds[i], &bounds[j], &bounds[k], &bounds[m]});
  return found;
}

std::optional<Cell_cut> sector_plane(const Line_cell& cell, const Near_plane& source_plane,
                                     const Near_plane& target_plane) {
  for (const Touching_line& line : touching_lines(cell, source_plane, target_plane))
    for (const Exact_pluecker& met : line.met) {
      const std::array<Integer, 4> h = plane_of(line, met);
      if (!is_plane(h)) continue;
      const Near_plane plane = near_plane(*cell.frame, h);
      if (is_across(plane, cell.domain->source)) return Cell_cut{true, plane};
      if (is_across(plane, cell.domain->target)) return Cell_cut{false, plane};
    }
  return {};
}

}  // namespace sightline
