#pragma once
// Cells of lines beside an event line: their signs are those of the line that is moved there, and lines near by have no
// others.

#include "support.h"

#include <sightline/algorithms/weak_visibility/events/event_cells.h>

namespace fuzz {

/// A chart with the lines that its event line touches, as the visits want them.
struct Touching {
  Event_chart chart;
  std::vector<Exact_pluecker> lines;
};

inline Homogeneous combined(const std::array<Homogeneous, 4>& points, const std::array<long, 4>& by) {
  Homogeneous x{0, 0, 0, 0};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 4; ++i) x[i] += by[k] * points[k][i];
  return x;
}

/// Lines that a whole ruling of a quadric meets, or a whole pencil: those through its vertex, those in its plane, those
/// with both. Empty where the bytes make none.
inline Touching touching_in(Bytes& from, bool at_regulus) {
  std::array<Homogeneous, 4> points;
  for (Homogeneous& x : points)
    for (Integer& c : x) c = from.integer(6);
  const Exact_pluecker first = join(points[0], points[1]), other = join(points[2], points[3]);
  if (sgn(side(first, other)) == 0) return {};  // dependent
  Touching touching{{points[0], points[1], points[2], points[3]}, {}};
  const std::size_t count = 3 + from.below(4);
  std::set<std::array<long, 3>> known;  // a kind of line, and where it differs from others of its kind: a quotient
  for (std::size_t k = 0; k < count; ++k) {
    const long kind = at_regulus ? 0 : static_cast<long>(from.below(3)), m = static_cast<long>(from.below(16)) - 8,
               c = 1 + static_cast<long>(from.below(4)), free = static_cast<long>(from.below(16)) - 8;
    const long common = std::gcd(m, c);
    if (!known.insert({kind, m / common, c / common}).second) continue;
    const auto line = [&](const std::array<long, 4>& a, const std::array<long, 4>& b) {
      return from.below(2) == 0 ? join(combined(points, a), combined(points, b))
                                : join(combined(points, b), combined(points, a));
    };
    touching.lines.push_back(at_regulus  ? line({c, m, 0, 0}, {0, 0, c, m})
                             : kind == 0 ? line({1, 0, 0, 0}, {0, free, m, c})  // through v
                             : kind == 1 ? line({m, c, 0, 0}, {free, 0, 1, 0})  // in the plane of v, w, r
                                         : line({1, 0, 0, 0}, {0, m, c, 0}));   // both
  }
  return at_regulus && touching.lines.size() < 3 ? Touching{} : touching;
}

inline void event_cells(std::string_view bytes) {
  Bytes from(bytes);
  const bool at_regulus = from.below(2) == 0;
  const Touching touching = touching_in(from, at_regulus);
  if (touching.lines.empty()) return;
  std::vector<const Exact_pluecker*> touched;
  for (const Exact_pluecker& line : touching.lines) touched.push_back(&line);
  const auto signs_of = [&](const Event_move& move, const Rational& t) {
    const Exact_pluecker near = moved(touching.chart, move, t);
    std::vector<int> signs;
    for (const Exact_pluecker& line : touching.lines) signs.push_back(sgn(side(near, line)));
    return signs;
  };
  const Rational t(Integer(1), Integer(1) << 100);  // slopes and quotients have less than 30 bits

  // 1. The cells that are said to be there.
  std::set<std::vector<int>> said;
  const auto visit = [&](const std::vector<int>& signs, const Event_move& move) {
    said.insert(signs);
    require(signs == signs_of(move, t), "the way into a cell leads there");
    for (const Rational& x : move.first) require(!at_regulus || abs(x) <= 1, "a move is of size one at most");
    return false;
  };
  if (at_regulus) visit_cells_at_regulus(touching.chart, touched, visit);
  else visit_cells_at_pencil(touching.chart, touched, visit);

  // 2. Those that other lines near by are in.
  for (int k = 0; k < 60; ++k) {
    Event_move move;
    for (Rational& x : move.first) {
      x = Rational(from.integer(10), Integer(1) << (from.below(3) == 0 ? 100 + from.byte() % 8 : from.byte() % 16));
      x.canonicalize();
    }
    const std::vector<int> signs = signs_of(move, t);
    if (std::find(signs.begin(), signs.end(), 0) == signs.end())
      require(said.count(signs) == 1, "each cell near the line is visited");
  }
}

}  // namespace fuzz
