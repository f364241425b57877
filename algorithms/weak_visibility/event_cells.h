#pragma once
// The lines near an event line, as cells by the sides on which they pass the edges that the event line touches: all of them, and a way into each.

#include <sightline/algorithms/weak_visibility/event_lines.h>

#include <set>

namespace sightline {

/// Lines near that through v and w: through v + a r + c n and w + b r + d n, small a, b, c, d. Pre: v, w, r, n independent.
/// The side of a line k is <v w, k> + a <r w, k> + b <v r, k> + c <n w, k> + d <v n, k> + (a d - b c) <r n, k>.
struct Event_chart {
  Homogeneous v, w, r, n;
};

/// A way from the event line into a cell, which it is in for all small t > 0: (a, b, c, d) = t first + t^2 (0, 0, second, 0).
struct Event_move {
  std::array<Rational, 4> first{0, 0, 0, 0};
  Rational second = 0;
};

/// The moved line. Exact: yes
inline Exact_six moved(const Event_chart& chart, const Event_move& move, const Rational& t) {
  std::array<Rational, 4> by;
  Integer common = 1;
  for (std::size_t k = 0; k < 4; ++k) {
    by[k] = t * move.first[k];
    if (k == 2) by[k] += t * t * move.second;
    common = lcm(common, by[k].get_den());
  }
  const auto point = [&](const Homogeneous& from, const Rational& along_r, const Rational& along_n) {
    const Integer by_r = Rational(along_r * common).get_num(), by_n = Rational(along_n * common).get_num();
    Homogeneous x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = common * from[k] + by_r * chart.r[k] + by_n * chart.n[k];
    return x;
  };
  return join(point(chart.v, by[0], by[2]), point(chart.w, by[1], by[3]));
}

namespace event_cells_detail {

/// Numbers between the given ones and beyond them, in order.
inline std::vector<Rational> numbers_between(std::vector<Rational> at) {
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  if (at.empty()) return {Rational(0)};
  std::vector<Rational> between{Rational(at.front() - 1)};
  for (std::size_t k = 0; k + 1 < at.size(); ++k) between.push_back(Rational((at[k] + at[k + 1]) / 2));
  between.push_back(Rational(at.back() + 1));
  return between;
}

using Form = std::array<Rational, 3>;
inline Form cross(const Form& a, const Form& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
inline Rational dot(const Form& a, const Form& b) { return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); }

/// Visits a point in each cell of planes through the origin of space, until a visit returns true. Each cell has an edge, in which two planes meet; around
/// it, planes that hold it make sectors. Pre: three of the forms are independent. Cost: O(n^5). Exact: yes
template <class Visit>
bool visit_cells(const std::vector<Form>& forms, Visit visit) {
  std::set<std::vector<int>> seen;
  for (std::size_t i = 0; i < forms.size(); ++i)
    for (std::size_t j = i + 1; j < forms.size(); ++j) {
      const Form ray = cross(forms[i], forms[j]);
      if (sgn(ray[0]) == 0 && sgn(ray[1]) == 0 && sgn(ray[2]) == 0) continue;
      std::vector<Form> around;
      for (const Form& form : forms)
        if (sgn(dot(form, ray)) == 0) around.push_back(cross(form, ray));
      for (std::size_t a = 0; a < around.size(); ++a)
        for (std::size_t b = a + 1; b < around.size(); ++b)
          for (const int turn : {0, 1, 2, 3, 4, 5, 6, 7}) {
            Form beside;
            for (std::size_t k = 0; k < 3; ++k) beside[k] = (turn & 1 ? -1 : 1) * around[a][k] + (turn & 2 ? -1 : 1) * around[b][k];
            std::vector<int> signs;
            for (const Form& form : forms) {
              const int on = sgn(dot(form, ray)) * (turn & 4 ? -1 : 1);
              signs.push_back(on != 0 ? on : sgn(dot(form, beside)));
            }
            if (std::find(signs.begin(), signs.end(), 0) != signs.end() || !seen.insert(signs).second) continue;
            Form point;
            for (Rational part = 1;; part /= 2) {
              bool inside = true;
              for (std::size_t k = 0; k < 3; ++k) point[k] = (turn & 4 ? -1 : 1) * ray[k] + part * beside[k];
              for (std::size_t k = 0; k < forms.size() && inside; ++k) inside = sgn(dot(forms[k], point)) == signs[k];
              if (inside) break;
            }
            if (visit(signs, point)) return true;
          }
    }
  return false;
}

}  // namespace event_cells_detail

/// Visits all cells around a line of a ruled quadric, until a visit (signs of the touched lines, way into the cell) returns true. `touched`: lines that the whole
/// ruling meets, three of them independent. Pre: r, n are on another line of the ruling, so that in this chart sides are linear forms. Exact: yes. Proof: P-73
template <class Visit>
bool visit_cells_at_regulus(const Event_chart& chart, const std::vector<const Exact_six*>& touched, Visit visit) {
  using namespace event_cells_detail;
  const Exact_six rw = join(chart.r, chart.w), vr = join(chart.v, chart.r), nw = join(chart.n, chart.w), vn = join(chart.v, chart.n);
  std::vector<std::array<Integer, 4>> slopes;
  for (const Exact_six* line : touched) slopes.push_back({side(rw, *line), side(vr, *line), side(nw, *line), side(vn, *line)});
  // Three coordinates, the fourth 0, in which three forms are independent: the forms have rank three.
  for (std::size_t dropped = 0; dropped < 4; ++dropped) {
    std::vector<Form> forms;
    std::array<std::size_t, 3> kept{};
    for (std::size_t k = 0, next = 0; k < 4; ++k)
      if (k != dropped) kept[next++] = k;
    for (const auto& slope : slopes) forms.push_back({Rational(slope[kept[0]]), Rational(slope[kept[1]]), Rational(slope[kept[2]])});
    if (sgn(dot(cross(forms[0], forms[1]), forms[2])) == 0) continue;
    return visit_cells(forms, [&](const std::vector<int>& signs, const Form& point) {
      Event_move move;
      for (std::size_t k = 0; k < 3; ++k) move.first[kept[k]] = point[k];
      return visit(signs, move);
    });
  }
  throw std::logic_error("three skew lines with dependent slopes");
}

/// The same around a line of a pencil: those through v in a plane. `touched`: lines through v or in the plane. Pre: w and r are in the plane, n is not; no touched
/// line is the event line, no two through v have one plane with it unless it is the pencil's, no two in the plane meet on it but in v. Exact: yes. Proof: P-73
template <class Visit>
bool visit_cells_at_pencil(const Event_chart& chart, const std::vector<const Exact_six*>& touched, Visit visit) {
  using namespace event_cells_detail;
  const Exact_six rw = join(chart.r, chart.w), nw = join(chart.n, chart.w), vn = join(chart.v, chart.n), rn = join(chart.r, chart.n);
  // Sides are a_k a + c_k c + d_k d + e_k e, with e = a d - b c, where star lines (through v) have no d, flat ones (in the plane) no a, and lines of the pencil neither.
  struct Slopes {
    Rational a, c, d, e;
  };
  std::vector<Slopes> slopes;
  std::vector<Rational> star, flat, pencil;
  for (const Exact_six* line : touched) {
    const Slopes slope{Rational(side(rw, *line)), Rational(side(nw, *line)), Rational(side(vn, *line)), Rational(side(rn, *line))};
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
        for (std::size_t k = 0; k < signs.size(); ++k) signs[k] = c * sgn(Rational(slopes[k].a * a + slopes[k].c + slopes[k].d * d));
        if (visit(signs, Event_move{{Rational(c * a), Rational(0), Rational(c), Rational(c * d)}, Rational(0)})) return true;
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
          signs[k] = sgn(slope.a) != 0 ? a * sgn(slope.a) : sgn(slope.d) != 0 ? d * sgn(slope.d) : sgn(Rational(slope.c * c + slope.e * e));
        }
        if (visit(signs, Event_move{{Rational(a), Rational(0), Rational(0), Rational(d)}, c})) return true;
      }
    }
  return false;
}

}  // namespace sightline
