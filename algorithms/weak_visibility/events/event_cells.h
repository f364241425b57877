#pragma once
// The lines near an event line, as cells by the sides on which they pass the edges that the event line touches: all of
// them, and a way into each.

#include <sightline/algorithms/weak_visibility/events/event_lines.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <vector>

namespace sightline {

/// Lines near that through v and w: through v + a r + c n and w + b r + d n, small a, b, c, d. Pre: v, w, r, n
/// independent. The side of a line k is <v w, k> + a <r w, k> + b <v r, k> + c <n w, k> + d <v n, k> + (a d - b c) <r
/// n, k>.
struct Event_chart {
  Homogeneous v, w, r, n;
};

/// A way from the event line into a cell, which it is in for all small t > 0: (a, b, c, d) = t first + t^2 (0, 0,
/// second, 0).
struct Event_move {
  std::array<Rational, 4> first{0, 0, 0, 0};
  Rational second = 0;
};

/// The moved line. Exact: yes
Exact_pluecker moved(const Event_chart& chart, const Event_move& move, const Rational& t);

namespace event_cells_detail {

/// Numbers between the given ones and beyond them, in order.
std::vector<Rational> numbers_between(std::vector<Rational> at);

using Form = std::array<Integer, 3>;

/// Divided by a power of two and rounded, so that the largest entry has so many bits. Pre: not zero.
Form rounded(const Form& a, long bits);

/// A point at which forms have given signs, near the ray and a little to a side of it: of few bits, and of size one at
/// most, whatever the sizes of the forms. Pre: the signs are those on the ray, and where that is on a plane those
/// beside it.
std::array<Rational, 3> inner_point(const std::vector<Form>& forms, const std::vector<int>& signs, const Form& ray,
                                    const Form& beside);

/// Visits a point in each cell of planes through the origin of space, until a visit returns true. Each cell has an
/// edge, in which two planes meet; around it, planes that hold it make sectors. Pre: three of the forms are
/// independent. Cost: O(n^5), O(n^3) where no three planes meet in a line. Exact: yes
template <class Visit>
bool visit_cells(const std::vector<Form>& forms, Visit visit) {
  std::set<std::vector<int>> seen;
  std::vector<int> on(forms.size()), signs(forms.size());
  for (std::size_t i = 0; i < forms.size(); ++i)
    for (std::size_t j = i + 1; j < forms.size(); ++j) {
      const Form ray = cross(forms[i], forms[j]);
      if (is_zero(ray)) continue;
      std::vector<Form> around;  // half-planes, in the planes that hold the ray
      std::size_t first = forms.size();
      for (std::size_t k = 0; k < forms.size(); ++k) {
        on[k] = sgn(dot(forms[k], ray));
        if (on[k] != 0) continue;
        first = std::min(first, k);
        around.push_back(cross(forms[k], ray));
      }
      if (first < i) continue;                    // that ray has been seen
      std::vector<std::vector<Integer>> heights;  // of half-planes, over each plane that holds the ray
      for (const Form& half : around) {
        std::vector<Integer>& own = heights.emplace_back(forms.size());
        for (std::size_t k = 0; k < forms.size(); ++k)
          if (on[k] == 0) own[k] = dot(forms[k], half);
      }
      for (std::size_t a = 0; a < around.size(); ++a)
        for (std::size_t b = a + 1; b < around.size(); ++b)
          for (const int turn : {0, 1, 2, 3, 4, 5, 6, 7}) {
            const int of_a = turn & 1 ? -1 : 1, of_b = turn & 2 ? -1 : 1, of_ray = turn & 4 ? -1 : 1;
            for (std::size_t k = 0; k < forms.size(); ++k)
              signs[k] = on[k] != 0 ? of_ray * on[k] : sgn(Integer(of_a * heights[a][k] + of_b * heights[b][k]));
            if (std::find(signs.begin(), signs.end(), 0) != signs.end() || !seen.insert(signs).second) continue;
            Form forward, beside;
            for (std::size_t k = 0; k < 3; ++k) {
              forward[k] = of_ray * ray[k];
              beside[k] = of_a * around[a][k] + of_b * around[b][k];
            }
            if (visit(signs, inner_point(forms, signs, forward, beside))) return true;
          }
    }
  return false;
}

}  // namespace event_cells_detail

/// Visits all cells around a line of a ruled quadric, until a visit (signs of the touched lines, way into the cell)
/// returns true. `touched`: lines that the whole ruling meets, three of them independent. Pre: r, n are on another line
/// of the ruling, so that in this chart sides are linear forms. Exact: yes. Proof: P-73
template <class Visit>
bool visit_cells_at_regulus(const Event_chart& chart, const std::vector<const Exact_pluecker*>& touched, Visit visit) {
  using namespace event_cells_detail;
  const Exact_pluecker rw = join(chart.r, chart.w), vr = join(chart.v, chart.r), nw = join(chart.n, chart.w),
                       vn = join(chart.v, chart.n);
  std::vector<std::array<Integer, 4>> slopes;
  for (const Exact_pluecker* line : touched)
    slopes.push_back({side(rw, *line), side(vr, *line), side(nw, *line), side(vn, *line)});
  // Three coordinates, the fourth 0, in which three forms are independent: the forms have rank three.
  for (std::size_t dropped = 0; dropped < 4; ++dropped) {
    std::vector<Form> forms;
    std::array<std::size_t, 3> kept{};
    for (std::size_t k = 0, next = 0; k < 4; ++k)
      if (k != dropped) kept[next++] = k;
    for (const auto& slope : slopes) forms.push_back({slope[kept[0]], slope[kept[1]], slope[kept[2]]});
    if (sgn(dot(cross(forms[0], forms[1]), forms[2])) == 0) continue;
    return visit_cells(forms, [&](const std::vector<int>& signs, const std::array<Rational, 3>& point) {
      Event_move move;
      for (std::size_t k = 0; k < 3; ++k) move.first[kept[k]] = point[k];
      return visit(signs, move);
    });
  }
  throw std::logic_error("three skew lines with dependent slopes");
}

/// The same around a line of a pencil: those through v in a plane. `touched`: lines through v or in the plane. Pre: w
/// and r are in the plane, n is not; no touched line is the event line, no two through v have one plane with it unless
/// it is the pencil's, no two in the plane meet on it but in v. Exact: yes. Proof: P-73
template <class Visit>
bool visit_cells_at_pencil(const Event_chart& chart, const std::vector<const Exact_pluecker*>& touched, Visit visit) {
  using namespace event_cells_detail;
  const Exact_pluecker rw = join(chart.r, chart.w), nw = join(chart.n, chart.w), vn = join(chart.v, chart.n),
                       rn = join(chart.r, chart.n);
  // Sides are a_k a + c_k c + d_k d + e_k e, with e = a d - b c, where star lines (through v) have no d, flat ones (in
  // the plane) no a, and lines of the pencil neither.
  struct Slopes {
    Rational a, c, d, e;
  };
  std::vector<Slopes> slopes;
  std::vector<Rational> star, flat, pencil;
  for (const Exact_pluecker* line : touched) {
    const Slopes slope{Rational(side(rw, *line)), Rational(side(nw, *line)), Rational(side(vn, *line)),
                       Rational(side(rn, *line))};
    if (sgn(slope.a) != 0) star.push_back(Rational(-slope.c / slope.a));
    else if (sgn(slope.d) != 0) flat.push_back(Rational(-slope.c / slope.d));
    else pencil.push_back(Rational(-slope.e / slope.c));
    slopes.push_back(slope);
  }
  std::vector<int> signs(touched.size());
  // To first order: c = +-1, a and d between the places where signs change; e vanishes beside c.
  for (const int c : {1, -1})
    for (const Rational& a : numbers_between(star))
      for (const Rational& d : numbers_between(flat)) {
        for (std::size_t k = 0; k < signs.size(); ++k)
          signs[k] = c * sgn(Rational(slopes[k].a * a + slopes[k].c + slopes[k].d * d));
        if (visit(signs, Event_move{{Rational(c * a), Rational(0), Rational(c), Rational(c * d)}, Rational(0)}))
          return true;
      }
  // To second order, between lines of the pencil: a = +-t and d = +-t outweigh c, e = a d is as small as c.
  if (pencil.size() < 2) return false;
  for (const int a : {1, -1})
    for (const int d : {1, -1}) {
      const int e = a * d;
      std::vector<Rational> at;
      for (const Rational& x : pencil) at.push_back(Rational(e * x));
      for (const Rational& c : numbers_between(at)) {
        for (std::size_t k = 0; k < signs.size(); ++k) {
          const Slopes& slope = slopes[k];
          signs[k] = sgn(slope.a) != 0   ? a * sgn(slope.a)
                     : sgn(slope.d) != 0 ? d * sgn(slope.d)
                                         : sgn(Rational(slope.c * c + slope.e * e));
        }
        if (visit(signs, Event_move{{Rational(a), Rational(0), Rational(0), Rational(d)}, c})) return true;
      }
    }
  return false;
}

}  // namespace sightline
