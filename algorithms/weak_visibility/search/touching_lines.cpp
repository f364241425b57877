#include <sightline/algorithms/weak_visibility/search/touching_lines.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sightline {
namespace {

constexpr double nearly = 1e-7;

/// A line that bounds a cell: of its path, or along an edge of its polygons.
struct Bound {
  Exact_pluecker exact;
  Pluecker near;
  int sign;  ///< of the path; 0: an edge
};

template <class Number>
std::array<Number, 6> dual(const std::array<Number, 6>& l) {
  return {l[3], l[4], l[5], l[0], l[1], l[2]};
}

void normalize(Pluecker& l) {
  double most = 0;
  for (const double x : l) most = std::max(most, std::fabs(x));
  if (most > 0)
    for (double& x : l) x /= most;
}

std::vector<Bound> bounds_of(const Line_cell& cell) {
  std::vector<Bound> bounds;
  for (const Line_cell::Row& row : cell.rows) {
    const Edge_lines::Edge_line& line = (*cell.lines)[row.literal.line];
    bounds.push_back({line.exact, line.near, row.literal.sign});
  }
  for (const Near_polygon* polygon : {&cell.domain->source, &cell.domain->target})
    for (std::size_t i = 0; i < polygon->size(); ++i) {
      const Near_point &a = (*polygon)[i], &b = (*polygon)[(i + 1) % polygon->size()];
      bounds.push_back({dual(pluecker_of_pair(b.exact, a.exact)), pluecker_of_edge(a.near, b.near), 0});
    }
  for (Bound& bound : bounds) normalize(bound.near);
  return bounds;
}

double magnitude(double x) { return std::fabs(x); }
Rational magnitude(const Rational& x) { return abs(x); }

/// A basis of what is orthogonal to four rows of six numbers; false where these are dependent.
template <class Number, class Is_zero>
bool orthogonal(std::array<std::array<Number, 6>, 4> rows, std::array<std::array<Number, 6>, 2>& basis,
                Is_zero is_zero) {
  std::array<std::size_t, 4> pivots{};
  std::array<bool, 6> used{};
  for (std::size_t r = 0; r < 4; ++r) {
    std::size_t best = 6;
    for (std::size_t c = 0; c < 6; ++c)
      if (!used[c] && (best == 6 || magnitude(rows[r][c]) > magnitude(rows[r][best]))) best = c;
    if (is_zero(rows[r][best])) return false;
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
    std::array<Number, 6>& v = basis[next++];
    v = {};
    v[c] = 1;
    for (std::size_t r = 0; r < 4; ++r) v[pivots[r]] = -rows[r][c];
  }
  return true;
}

/// Where a line meets a plane; last coordinate 0 where it is parallel.
template <class Number>
std::array<Number, 4> meet(const std::array<Number, 6>& l, const std::array<Number, 4>& h) {
  const std::array<Number, 3> n{h[0], h[1], h[2]}, d{l[0], l[1], l[2]}, m{l[3], l[4], l[5]};
  const std::array<Number, 3> x = cross(n, m);
  return {Number(x[0] - h[3] * d[0]), Number(x[1] - h[3] * d[1]), Number(x[2] - h[3] * d[2]), Number(dot(n, d))};
}

/// Lines that meet four bounds, in doubles.
struct Near_lines {
  std::array<Pluecker, 2> lines;
  std::size_t count = 0;
  bool twice = false;
};

double square(const Pluecker& a, const Pluecker& b) { return dot(a, dual(b)); }

Near_lines near_lines(const std::array<const Bound*, 4>& four) {
  Near_lines found;
  std::array<Pluecker, 4> rows;
  for (std::size_t k = 0; k < 4; ++k) rows[k] = dual(four[k]->near);
  std::array<Pluecker, 2> basis;
  const auto abs_zero = [](double x) { return std::fabs(x) < 1e-9; };
  if (!orthogonal(rows, basis, abs_zero)) return found;
  for (Pluecker& v : basis) normalize(v);
  const double a = square(basis[0], basis[0]), b = square(basis[0], basis[1]), c = square(basis[1], basis[1]);
  const auto add = [&](double s, double t) {
    Pluecker& l = found.lines[found.count++];
    for (std::size_t k = 0; k < 6; ++k) l[k] = s * basis[0][k] + t * basis[1][k];
    normalize(l);
  };
  if (std::fabs(a) + std::fabs(b) + std::fabs(c) < 1e-10) return found;
  const double discriminant = b * b - a * c;
  if (discriminant < -1e-9) return found;
  found.twice = discriminant < 1e-9;
  const double root = found.twice ? 0 : std::sqrt(discriminant), q = b > 0 ? -b - root : -b + root;
  // a s^2 + 2 b s t + c t^2 = 0.
  if (std::fabs(a) >= std::fabs(c)) {
    add(q, a);
    if (!found.twice) add(c, q);
  } else {
    add(c, q);
    if (!found.twice) add(q, a);
  }
  return found;
}

/// Whether a line is nearly in the closure of a cell.
bool touches(const Line_cell& cell, const std::vector<Bound>& bounds, const Pluecker& l, const Near_plane& s,
             const Near_plane& t) {
  const std::array<double, 4> p = meet(l, s.near), q = meet(l, t.near);
  if (std::fabs(p[3]) < 1e-9 || std::fabs(q[3]) < 1e-9) return false;
  const Triple from{p[0] / p[3], p[1] / p[3], p[2] / p[3]}, to{q[0] / q[3], q[1] / q[3], q[2] / q[3]};
  const auto inside = [](const Near_polygon& polygon, const Triple& x, const Near_plane& h) {
    int sign = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Triple &a = polygon[i].near, &b = polygon[(i + 1) % polygon.size()].near;
      const Triple along = minus(b, a), at = minus(x, a);
      const double turn = dot(cross(along, at), Triple{h.near[0], h.near[1], h.near[2]}) / size(along);
      const double reach = 1e-3 * size(along) + 1e-9;
      if (std::fabs(turn) <= nearly * reach + 1e-9) continue;
      const int own = turn > 0 ? 1 : -1;
      if (sign != 0 && own != sign) return false;
      sign = own;
    }
    return true;
  };
  if (!inside(cell.domain->source, from, s) || !inside(cell.domain->target, to, t)) return false;
  const Pluecker pair = pluecker_of_pair(from, to);
  for (const Bound& bound : bounds)
    if (bound.sign * dot(pair, bound.near) < -nearly) return false;
  return true;
}

struct Touching {
  std::array<Integer, 4> from, to;
  std::vector<const Bound*> met;
};

/// The exact line near one that meets four bounds, where it is rational and touches the cell.
std::optional<Touching> exact_line(const Line_cell& cell, const std::vector<Bound>& bounds,
                                   const std::array<const Bound*, 4>& four, const Near_plane& s, const Near_plane& t) {
  std::array<std::array<Rational, 6>, 4> rows;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t x = 0; x < 6; ++x) rows[k][x] = four[k]->exact[(x + 3) % 6];
  std::array<std::array<Rational, 6>, 2> basis;
  if (!orthogonal(rows, basis, [](const Rational& x) { return sgn(x) == 0; })) return {};
  const auto times = [](const std::array<Rational, 6>& u, const std::array<Rational, 6>& v) {
    Rational sum;
    for (std::size_t k = 0; k < 6; ++k) sum += u[k] * v[(k + 3) % 6];
    return sum;
  };
  const Rational a = times(basis[0], basis[0]), b = times(basis[0], basis[1]), c = times(basis[1], basis[1]);
  if (sgn(a) == 0 && sgn(b) == 0 && sgn(c) == 0) return {};
  const Rational discriminant = b * b - a * c;
  if (sgn(discriminant) < 0 || mpz_perfect_square_p(discriminant.get_num_mpz_t()) == 0 ||
      mpz_perfect_square_p(discriminant.get_den_mpz_t()) == 0)
    return {};
  const Rational root(sqrt(discriminant.get_num()), sqrt(discriminant.get_den()));
  std::vector<std::array<Rational, 2>> solutions;
  for (const int sign : {1, -1}) {
    if (sign < 0 && sgn(root) == 0) break;
    if (sgn(a) != 0) solutions.push_back({Rational(-b + sign * root), a});
    else if (sign > 0) solutions.push_back({Rational(1), Rational(0)});
    else solutions.push_back({Rational(-c), Rational(2 * b)});
  }
  for (const auto& [u, v] : solutions) {
    std::array<Rational, 6> l;
    Integer common = 1;
    for (std::size_t k = 0; k < 6; ++k) {
      l[k] = u * basis[0][k] + v * basis[1][k];
      common = lcm(common, l[k].get_den());
    }
    Exact_pluecker line;
    for (std::size_t k = 0; k < 6; ++k) line[k] = l[k].get_num() * (common / l[k].get_den());
    Touching found{meet(line, s.exact), meet(line, t.exact), {}};
    bool good = true;
    for (auto* x : {&found.from, &found.to}) {
      if (sgn((*x)[3]) == 0) good = false;
      const Integer divisor = gcd(gcd((*x)[0], (*x)[1]), gcd((*x)[2], (*x)[3]));
      if (sgn(divisor) == 0) {
        good = false;
        continue;
      }
      for (Integer& y : *x) y /= sgn((*x)[3]) < 0 ? Integer(-divisor) : divisor;
    }
    if (!good) continue;
    const Exact_pluecker pair = pluecker_of_pair(found.from, found.to);
    std::array<int, 3> positive{}, negative{};
    for (std::size_t k = 0; k < bounds.size() && good; ++k) {
      const int sign = sgn(dot(pair, bounds[k].exact));
      const std::size_t kind = k < cell.rows.size() ? 0 : k < cell.rows.size() + cell.domain->source.size() ? 1 : 2;
      if (kind == 0 && sign * bounds[k].sign < 0) good = false;
      if (sign > 0) ++positive[kind];
      if (sign < 0) ++negative[kind];
      if (sign == 0) found.met.push_back(&bounds[k]);
    }
    for (const std::size_t kind : {1u, 2u})
      if ((positive[kind] == 0) == (negative[kind] == 0)) good = false;
    if (good) return found;
  }
  return {};
}

std::array<Integer, 4> plane_of(const std::array<Integer, 4>& a, const std::array<Integer, 4>& b,
                                const std::array<Integer, 4>& c) {
  const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) {
    return Integer(a[i] * (b[j] * c[k] - b[k] * c[j]) - a[j] * (b[i] * c[k] - b[k] * c[i]) +
                   a[k] * (b[i] * c[j] - b[j] * c[i]));
  };
  std::array<Integer, 4> h{minor(1, 2, 3), Integer(-minor(0, 2, 3)), minor(0, 1, 3), Integer(-minor(0, 1, 2))};
  const Integer divisor = gcd(gcd(h[0], h[1]), gcd(h[2], h[3]));
  if (sgn(divisor) != 0)
    for (Integer& x : h) x /= divisor;
  return h;
}

/// The plane of two lines that meet: through two points of the one and a point of the other.
std::array<Integer, 4> plane_through(const Touching& touching, const Exact_pluecker& line) {
  // Where the other line meets the planes of coordinates, and at infinity.
  std::array<Integer, 4> plane{};
  for (std::size_t k = 0; k < 4; ++k) {
    std::array<Integer, 4> h{};
    h[k] = 1;
    plane = plane_of(touching.from, touching.to, meet(line, h));
    if (sgn(plane[0]) != 0 || sgn(plane[1]) != 0 || sgn(plane[2]) != 0) break;
  }
  return plane;
}

std::array<Integer, 4> middle_of(const Near_polygon& polygon) {
  Integer common = 1;
  for (const Near_point& p : polygon) common = lcm(common, p.exact[3]);
  std::array<Integer, 4> sum{};
  for (const Near_point& p : polygon)
    for (std::size_t k = 0; k < 4; ++k) sum[k] += p.exact[k] * (common / p.exact[3]);
  return sum;
}

}  // namespace

std::optional<Cell_cut> plane_at_touching_line(const Line_cell& cell, const Near_plane& source_plane,
                                               const Near_plane& target_plane, bool between) {
  const std::vector<Bound> bounds = bounds_of(cell);
  const std::size_t n = bounds.size();
  if (n > 24) return {};
  std::vector<Pluecker> seen;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k)
        for (std::size_t m = k + 1; m < n; ++m) {
          const std::array<const Bound*, 4> four{&bounds[i], &bounds[j], &bounds[k], &bounds[m]};
          const Near_lines lines = near_lines(four);
          for (std::size_t r = 0; r < lines.count; ++r) {
            const Pluecker& line = lines.lines[r];
            if (!touches(cell, bounds, line, source_plane, target_plane)) continue;
            if (std::any_of(seen.begin(), seen.end(), [&](const Pluecker& other) {
                  double same = 0, opposite = 0;
                  for (std::size_t x = 0; x < 6; ++x) {
                    same = std::max(same, std::fabs(line[x] - other[x]));
                    opposite = std::max(opposite, std::fabs(line[x] + other[x]));
                  }
                  return std::min(same, opposite) < 1e-9;
                }))
              continue;
            const auto touching = exact_line(cell, bounds, four, source_plane, target_plane);
            if (!touching) continue;
            seen.push_back(line);
            const auto cut_by = [&](const std::array<Integer, 4>& h) -> std::optional<Cell_cut> {
              if (sgn(h[0]) == 0 && sgn(h[1]) == 0 && sgn(h[2]) == 0) return {};
              const Near_plane plane = near_plane(*cell.frame, h);
              for (const bool source : {true, false})
                if (is_across(plane, source ? cell.domain->source : cell.domain->target))
                  return Cell_cut{source, plane};
              return {};
            };
            for (const Bound* met : touching->met)
              if (auto cut = cut_by(plane_through(*touching, met->exact))) return cut;
            if (between)
              for (const bool source : {true, false})
                if (auto cut = cut_by(plane_of(touching->from, touching->to,
                                               middle_of(source ? cell.domain->source : cell.domain->target))))
                  return cut;
          }
        }
  return {};
}

}  // namespace sightline
