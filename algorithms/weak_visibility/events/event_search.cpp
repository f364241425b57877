#include <sightline/algorithms/weak_visibility/events/event_search.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace sightline {
namespace {

/// Points or planes, each once.
struct Numbered {
  std::map<Homogeneous, std::uint32_t, Less_entries> numbers;
  std::vector<Homogeneous> all;
  std::uint32_t operator()(Homogeneous h) {
    make_canonical(h);
    const auto [at, is_new] = numbers.try_emplace(h, static_cast<std::uint32_t>(all.size()));
    if (is_new) all.push_back(h);
    return at->second;
  }
};

/// A point that is not in a plane. Pre: the plane is not zero.
Homogeneous off_plane(const Homogeneous& plane) {
  Homogeneous x{0, 0, 0, 0};
  for (std::size_t k = 0; k < 4; ++k)
    if (sgn(plane[k]) != 0) {
      x[k] = 1;
      break;
    }
  return x;
}

/// The plane of two lines that meet; zero where they are one.
Homogeneous common_plane(const Exact_pluecker& a, const Exact_pluecker& b) {
  for (std::size_t k = 0; k < 4; ++k) {
    Homogeneous h{0, 0, 0, 0};
    h[k] = 1;
    const Homogeneous at = meet(h, b);
    if (all_zero(at)) continue;
    const Homogeneous plane = join(at, a);
    if (!all_zero(plane)) return plane;
  }
  return {0, 0, 0, 0};
}

/// first + s step
Homogeneous along(const Homogeneous& first, const Homogeneous& step, const Rational& s) {
  Homogeneous x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = first[k] * s.get_den() + step[k] * s.get_num();
  return x;
}

/// The side of the point first + s step of a plane.
Quadratic linear(const Homogeneous& plane, const Homogeneous& first, const Homogeneous& step) {
  return {{dot(plane, first), dot(plane, step), Integer(0)}};
}

/// The side of a point of a plane that turns about a line.
Quadratic linear_at(const Homogeneous& plane, const Homogeneous& turn, const Homogeneous& x) {
  return {{dot(plane, x), dot(turn, x), Integer(0)}};
}

/// The lines through ends of two edges.
std::array<Exact_pluecker, 4> extreme_lines(const Event_lines::Event_line& a, const Event_lines::Event_line& b) {
  return {join(a.hull[0], b.hull[0]), join(a.hull[0], b.hull[1]), join(a.hull[1], b.hull[0]),
          join(a.hull[1], b.hull[1])};
}

/// The side of a line that all lines through two edges have inside both; 0 where they differ or are all 0.
int common_side(const std::array<Exact_pluecker, 4>& extreme, const Exact_pluecker& line) {
  bool positive = false, negative = false;
  for (const Exact_pluecker& e : extreme) {
    const int s = sgn(side(e, line));
    positive |= s > 0;
    negative |= s < 0;
  }
  return positive == negative ? 0 : positive ? 1 : -1;
}

/// The parameters in (0, 1) where each of two pairs, ends[0] and ends[1], ends[2] and ends[3], has different signs.
std::vector<Parameter_range> changing(const std::array<Quadratic, 4>& ends) {
  std::array<int, 4> sure{};
  for (std::size_t k = 0; k < 4; ++k) {
    if (ends[k].is_zero()) return {};
    sure[k] = ends[k].certain_sign();
  }
  if (sure[0] * sure[1] > 0 || sure[2] * sure[3] > 0) return {};
  std::vector<Parameter_range> found;
  for (const Parameter_range& part : divided({Quadratic_root(0), Quadratic_root(1)}, ends)) {
    const Rational s = inner_rational(part);
    if (ends[0].sign(s) * ends[1].sign(s) < 0 && ends[2].sign(s) * ends[3].sign(s) < 0) found.push_back(part);
  }
  return found;
}

}  // namespace

Events_answer Event_search::run() {
  counters_->occluders += scene_->blockers().size();
  counters_->lines += scene_->lines().size();
  answer_.status = Weak_status::hidden;
  if (in_one_shadow()) ++counters_->in_shadow;
  else if (!pencils()) reguli();
  return answer_;
}

bool Event_search::in_one_shadow() const {
  return std::any_of(scene_->blockers().begin(), scene_->blockers().end(), [&](const Blocker& blocker) {
    for (const Near_point& p : scene_->source())
      for (const Near_point& q : scene_->target()) {
        const Exact_pluecker line = join(p.exact, q.exact);
        for (const Literal& literal : blocker.literals)
          if (literal.sense * sgn(side(line, lines()[literal.line].pluecker)) < 0) return false;
      }
    return true;
  });
}

bool Event_search::pencils() {
  Numbered points, planes;
  std::map<std::array<std::uint32_t, 2>, Event_kind> found;
  const auto add = [&](std::uint32_t point, std::uint32_t plane, Event_kind kind) {
    found.try_emplace({point, plane}, kind);
  };
  // 1. Planes of two edges, and vertices where two edges meet.
  std::set<std::uint32_t> vertices, faces;
  for (std::size_t i = 0; i < lines().size(); ++i) {
    if (out_of_time()) return true;
    for (std::size_t j = i + 1; j < lines().size(); ++j) {
      const Event_line &a = lines()[i], &b = lines()[j];
      if (!a.real || !b.real || (a.in_source && b.in_source) || sgn(side(a.pluecker, b.pluecker)) != 0) continue;
      const Homogeneous& off = all_zero(join(b.hull[0], a.pluecker)) ? b.hull[1] : b.hull[0];
      const Homogeneous common = join(off, a.pluecker);
      const std::uint32_t plane = planes(common);
      faces.insert(plane);
      if (a.in_source || b.in_source) continue;
      const Homogeneous at = meet(join(off_plane(common), a.pluecker), b.pluecker);
      if (!Event_lines::in_hull(a, at) || !Event_lines::in_hull(b, at)) continue;
      const std::uint32_t point = points(at);
      vertices.insert(point);
      add(point, plane, Event_kind::horizon);
    }
  }
  // 2. Where such a plane meets another edge.
  for (const std::uint32_t plane : faces) {
    if (out_of_time()) return true;
    for (const Event_line& line : lines()) {
      if (!line.real || line.in_source) continue;
      const Homogeneous at = meet(planes.all[plane], line.pluecker);
      if (!all_zero(at) && Event_lines::in_hull(line, at)) add(points(at), plane, Event_kind::horizon);
    }
  }
  // 3. Planes through such a vertex and an edge.
  for (const std::uint32_t point : vertices) {
    if (out_of_time()) return true;
    for (const Event_line& line : lines()) {
      if (!line.real) continue;
      const Homogeneous plane = join(points.all[point], line.pluecker);
      if (!all_zero(plane)) add(point, planes(plane), Event_kind::edge_vertex);
    }
  }
  // 4. The lines through the point, in the plane.
  for (const auto& [pencil, kind] : found) {
    ++(kind == Event_kind::horizon ? counters_->horizon : counters_->edge_vertex);
    if (search_pencil(points.all[pencil[0]], planes.all[pencil[1]], kind) || out_of_budget()) return true;
  }
  return false;
}

bool Event_search::search_pencil(const Homogeneous& vertex, const Homogeneous& plane, Event_kind kind) {
  // Lines in the plane of source or target, or through a point behind, lead nowhere.
  if (sgn(dot(scene_->source_plane(), vertex)) <= 0 ||
      sgn(dot(scene_->target_plane(), vertex)) * scene_->beside() < 0) {
    ++counters_->off_edges;
    return false;
  }
  const std::array<Homogeneous, 2> ends = section(plane);
  const Homogeneous &first = ends[0], &last = ends[1];
  if (all_zero(join(first, last))) {
    ++counters_->off_polygons;
    return false;
  }
  Curve curve;
  curve.kind = kind;
  const Homogeneous step{last[0] - first[0], last[1] - first[1], last[2] - first[2], last[3] - first[3]};
  curve.l = {join(vertex, first), join(vertex, step), Exact_pluecker{0, 0, 0, 0, 0, 0}};
  // Where the event line is a touched line, or in the plane of two of them, or meets them in one point.
  const Homogeneous beyond = off_plane(plane);
  std::vector<const Event_line*> star, flat;
  for (const Event_line& line : lines()) {
    const bool through = all_zero(join(vertex, line.pluecker)), within = all_zero(meet(plane, line.pluecker));
    if (through) star.push_back(&line);
    if (within) flat.push_back(&line);
    if (through && within) curve.ends.push_back(linear(join(beyond, line.pluecker), first, step));
  }
  for (std::size_t i = 0; i < star.size(); ++i)
    for (std::size_t j = i + 1; j < star.size(); ++j)
      curve.ends.push_back(linear(common_plane(star[i]->pluecker, star[j]->pluecker), first, step));
  for (std::size_t i = 0; i < flat.size(); ++i)
    for (std::size_t j = i + 1; j < flat.size(); ++j) {
      const Homogeneous at = meet(join(beyond, flat[i]->pluecker), flat[j]->pluecker);
      const Exact_pluecker up = join(at, beyond);
      curve.ends.push_back({{side(curve.l[0], up), side(curve.l[1], up), Integer(0)}});
    }
  curve.chart = [&](const Rational& s) { return Event_chart{vertex, along(first, step, s), last, beyond}; };
  return search_curve(curve, {Quadratic_root(0), Quadratic_root(1)});
}

std::array<Homogeneous, 2> Event_search::section(const Homogeneous& plane) const {
  std::vector<Homogeneous> ends;
  const Near_polygon& source = scene_->source();
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Homogeneous &a = source[i].exact, &b = source[(i + 1) % source.size()].exact;
    const Integer at = dot(plane, a), after = dot(plane, b);
    if (sgn(at) == 0) ends.push_back(a);
    if (sgn(at) * sgn(after) >= 0) continue;
    Homogeneous x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = abs(after) * a[k] + abs(at) * b[k];
    make_canonical(x);
    ends.push_back(x);
  }
  if (ends.size() == 2) return {ends[0], ends[1]};
  return {source[0].exact, source[0].exact};
}

bool Event_search::reguli() {
  std::vector<std::uint32_t> real;
  for (std::uint32_t k = 0; k < lines().size(); ++k)
    if (lines()[k].real) real.push_back(k);
  // Which pairs are skew, and touched by some line from the source to the target.
  std::vector<std::vector<char>> usable(real.size(), std::vector<char>(real.size()));
  for (std::size_t i = 0; i < real.size(); ++i) {
    if (out_of_time()) return true;
    for (std::size_t j = i + 1; j < real.size(); ++j) {
      const Event_line &a = lines()[real[i]], &b = lines()[real[j]];
      if (sgn(side(a.pluecker, b.pluecker)) == 0) continue;
      const std::array<Exact_pluecker, 4> extreme = extreme_lines(a, b);
      usable[i][j] = can_pass(extreme, scene_->from()) && can_pass(extreme, scene_->to());
    }
  }
  for (std::size_t i = 0; i < real.size(); ++i)
    for (std::size_t j = i + 1; j < real.size(); ++j) {
      if (!usable[i][j]) continue;
      const std::array<Exact_pluecker, 4> extreme = extreme_lines(lines()[real[i]], lines()[real[j]]);
      for (std::size_t k = j + 1; k < real.size(); ++k) {
        if (!usable[i][k] || !usable[j][k]) continue;
        ++counters_->triple;
        if (common_side(extreme, lines()[real[k]].pluecker) != 0) ++counters_->off_edges;
        else if (search_regulus({real[i], real[j], real[k]})) return true;
        if (out_of_budget()) return true;
      }
    }
  return false;
}

bool Event_search::can_pass(const std::array<Exact_pluecker, 4>& extreme, const std::vector<Literal>& literals) const {
  bool positive = false, negative = false;
  for (const Literal& literal : literals) {
    const int s = literal.sense * common_side(extreme, lines()[literal.line].pluecker);
    positive |= s > 0;
    negative |= s < 0;
  }
  return !(positive && negative);
}

bool Event_search::search_regulus(const std::array<std::uint32_t, 3>& edges) {
  const Event_line &a = lines()[edges[0]], &b = lines()[edges[1]], &c = lines()[edges[2]];
  Curve curve;
  curve.kind = Event_kind::triple;
  // The point x(s) of the first edge; its planes with the others meet in the event line (Plantinga's Eq. 1).
  const Homogeneous& first = a.hull[0];
  const Homogeneous step{a.hull[1][0] - first[0], a.hull[1][1] - first[1], a.hull[1][2] - first[2],
                         a.hull[1][3] - first[3]};
  const Homogeneous b0 = join(first, b.pluecker), b1 = join(step, b.pluecker), c0 = join(first, c.pluecker),
                    c1 = join(step, c.pluecker);
  // It touches the second edge where its ends are on both sides of the plane with the third; and so on.
  const std::array<Quadratic, 4> ends{linear_at(c0, c1, b.hull[0]), linear_at(c0, c1, b.hull[1]),
                                      linear_at(b0, b1, c.hull[0]), linear_at(b0, b1, c.hull[1])};
  const std::vector<Parameter_range> touching = changing(ends);
  if (touching.empty()) {
    ++counters_->off_edges;
    return false;
  }
  curve.l = {meet(b0, c0), meet(b0, c1), meet(b1, c1)};
  const Exact_pluecker other = meet(b1, c0);
  for (std::size_t k = 0; k < 6; ++k) curve.l[1][k] += other[k];
  curve.edges = edges;
  curve.chart = [&](const Rational& s) {
    const auto on_second = [&](const Rational& at) { return meet(along(c0, c1, at), b.pluecker); };
    const Rational beside = s + 1;  // any other line of the ruling
    return Event_chart{along(first, step, s), on_second(s), along(first, step, beside), on_second(beside)};
  };
  for (const Parameter_range& range : touching)
    if (search_curve(curve, range)) return true;
  return false;
}

const Quadratic& Event_search::polynomial(const Curve& curve, std::uint32_t line) {
  if (known_[line] != 1) {
    for (std::size_t k = 0; k < 3; ++k) polynomials_[line].c[k] = side(curve.l[k], lines()[line].pluecker);
    known_[line] = 1;
  }
  return polynomials_[line];
}

int Event_search::common_sign(const Curve& curve, const std::vector<Literal>& literals, const Rational& s) {
  bool positive = false, negative = false;
  for (const Literal& literal : literals) {
    const Quadratic& f = polynomial(curve, literal.line);
    if (f.is_zero()) continue;
    const int sign = literal.sense * f.sign(s);
    positive |= sign > 0;
    negative |= sign < 0;
  }
  return positive == negative ? 0 : positive ? 1 : -1;
}

std::vector<Quadratic> Event_search::polynomials(const Curve& curve, const std::vector<Literal>& literals) {
  std::vector<Quadratic> all;
  for (const Literal& literal : literals) all.push_back(polynomial(curve, literal.line));
  return all;
}

bool Event_search::never_passes(const Curve& curve, const std::vector<Literal>& literals) {
  bool positive = false, negative = false;
  for (const Literal& literal : literals) {
    const Quadratic& f = polynomial(curve, literal.line);
    if (f.is_zero()) continue;
    const int sign = literal.sense * f.certain_sign();
    positive |= sign > 0;
    negative |= sign < 0;
  }
  return positive && negative;
}

std::vector<Event_search::Active> Event_search::parts_between(const Curve& curve, const Parameter_range& range) {
  std::vector<Quadratic> ends = polynomials(curve, scene_->from());
  const std::vector<Quadratic> at_target = polynomials(curve, scene_->to());
  ends.insert(ends.end(), at_target.begin(), at_target.end());
  std::vector<Active> active;
  for (const Parameter_range& part : divided(range, ends)) {
    const Rational s = inner_rational(part);
    const int turn = common_sign(curve, scene_->from(), s);
    if (turn != 0 && turn == common_sign(curve, scene_->to(), s)) active.push_back({Active_subranges(part), turn});
  }
  return active;
}

bool Event_search::search_curve(const Curve& curve, const Parameter_range& range) {
  std::fill(known_.begin(), known_.end(), char{0});
  if (never_passes(curve, scene_->from()) || never_passes(curve, scene_->to())) {
    ++counters_->off_polygons;
    return false;
  }
  std::vector<Active> active = parts_between(curve, range);
  if (active.empty()) {
    ++counters_->off_polygons;
    return false;
  }
  // Pieces that lines do not touch everywhere block some of them, large ones first.
  std::vector<const Blocker*> crossed, grazed;
  for (const Blocker& blocker : scene_->blockers()) {
    const bool touched = std::any_of(blocker.literals.begin(), blocker.literals.end(),
                                     [&](const Literal& literal) { return polynomial(curve, literal.line).is_zero(); });
    (touched ? grazed : crossed).push_back(&blocker);
  }
  for (const Blocker* blocker : crossed) {
    if (out_of_time()) return true;
    subtract(curve, *blocker, active);
    if (active.empty()) {
      ++counters_->covered;
      return false;
    }
  }
  for (const Active& part : active)
    for (const Parameter_range& left : part.left.ranges()) {
      if (options_->surfaces) keep_surface(curve, left);
      if (answer_.status != Weak_status::visible && look_beside(curve, left, part.turn, crossed, grazed) &&
          !options_->surfaces)
        return true;
    }
  return false;
}

void Event_search::subtract(const Curve& curve, const Blocker& blocker, std::vector<Active>& active) {
  for (Active& part : active) {
    const auto fails = [&](const Literal& literal) {
      return polynomial(curve, literal.line).certain_sign() * literal.sense * part.turn < 0;
    };
    if (std::any_of(blocker.literals.begin(), blocker.literals.end(), fails)) continue;
    subtract_where(part.left, polynomials(curve, blocker.literals),
                   [&](const Rational& s) { return common_sign(curve, blocker.literals, s) == part.turn; });
  }
  std::erase_if(active, [](const Active& part) { return part.left.empty(); });
}

bool Event_search::look_beside(const Curve& curve, const Parameter_range& active, int turn,
                               const std::vector<const Blocker*>& crossed, const std::vector<const Blocker*>& grazed) {
  std::vector<Quadratic> ends = curve.ends;
  for (const Blocker* blocker : grazed)
    for (const Literal& literal : blocker->literals) ends.push_back(polynomial(curve, literal.line));
  for (const Parameter_range& part : divided(active, ends)) {
    if (out_of_time()) return true;
    ++counters_->subranges;
    // Not one of the lines that touch a piece for an instant.
    Rational s;
    for (unsigned long attempt = 0;; ++attempt) {
      s = inner_rational(part, attempt);
      if (std::all_of(crossed.begin(), crossed.end(),
                      [&](const Blocker* blocker) { return is_past(curve, *blocker, s, turn); }))
        break;
    }
    if (look_around(curve, s, turn, grazed)) return true;
  }
  return false;
}

bool Event_search::is_past(const Curve& curve, const Blocker& blocker, const Rational& s, int turn) {
  return std::any_of(blocker.literals.begin(), blocker.literals.end(), [&](const Literal& literal) {
    return literal.sense * turn * polynomial(curve, literal.line).sign(s) < 0;
  });
}

bool Event_search::look_around(const Curve& curve, const Rational& s, int turn,
                               const std::vector<const Blocker*>& grazed) {
  std::vector<const Exact_pluecker*> touched;
  std::vector<std::uint32_t> place(lines().size(), none);
  const auto touch = [&](std::uint32_t line) {
    if (place[line] == none && polynomial(curve, line).is_zero()) {
      place[line] = static_cast<std::uint32_t>(touched.size());
      touched.push_back(&lines()[line].pluecker);
    }
  };
  if (curve.kind == Event_kind::triple)
    for (const std::uint32_t edge : curve.edges) touch(edge);  // independent, so first
  for (std::uint32_t line = 0; line < lines().size(); ++line) touch(line);
  // What must hold of the sides of touched lines, and what must not.
  const Event_chart chart = curve.chart(s);
  const int same = orientation(chart, curve, s);
  std::vector<Literal> needed;
  std::vector<std::vector<Literal>> blocked;
  const auto append_touched = [&](const std::vector<Literal>& literals, std::vector<Literal>& found) {
    for (const Literal& literal : literals)
      if (place[literal.line] != none) found.push_back({place[literal.line], literal.sense * turn * same});
  };
  append_touched(scene_->from(), needed);
  append_touched(scene_->to(), needed);
  for (const Blocker* blocker : grazed)
    if (!is_past(curve, *blocker, s, turn)) append_touched(blocker->literals, blocked.emplace_back());
  const auto visit = [&](const std::vector<int>& signs, const Event_move& move) {
    ++counters_->cells;
    if (out_of_time()) return true;
    const auto holds = [&](const Literal& literal) { return signs[literal.line] == literal.sense; };
    if (!std::all_of(needed.begin(), needed.end(), holds)) return false;
    if (std::any_of(blocked.begin(), blocked.end(),
                    [&](const std::vector<Literal>& all) { return std::all_of(all.begin(), all.end(), holds); }))
      return false;
    confirm(chart, move);
    return true;
  };
  return curve.kind == Event_kind::triple ? visit_cells_at_regulus(chart, touched, visit)
                                          : visit_cells_at_pencil(chart, touched, visit);
}

int Event_search::orientation(const Event_chart& chart, const Curve& curve, const Rational& s) {
  const Exact_pluecker line = join(chart.v, chart.w);
  for (std::size_t k = 0; k < 6; ++k)
    if (sgn(line[k]) != 0) return sgn(line[k]) * Quadratic{{curve.l[0][k], curve.l[1][k], curve.l[2][k]}}.sign(s);
  throw std::logic_error("a chart of no line");
}

void Event_search::confirm(const Event_chart& chart, const Event_move& move) {
  for (unsigned long bits = 1; bits <= 8192; bits *= 2) {
    const Exact_pluecker line = moved(chart, move, Rational(Integer(1), Integer(Integer(1) << bits)));
    Homogeneous p = meet(scene_->source_plane(), line), q = meet(scene_->target_plane(), line);
    if (sgn(p[3]) == 0 || sgn(q[3]) == 0) continue;
    make_canonical(p);
    make_canonical(q);
    const Exact_pluecker directed = join(p, q);
    const auto holds = [&](const Literal& literal) {
      return literal.sense * sgn(side(directed, lines()[literal.line].pluecker)) > 0;
    };
    if (!std::all_of(scene_->from().begin(), scene_->from().end(), holds) ||
        !std::all_of(scene_->to().begin(), scene_->to().end(), holds))
      continue;
    if (sgn(dot(scene_->source_plane(), q)) <= 0) continue;
    answer_.sightline = {near_point(occluders_->frame(), p), near_point(occluders_->frame(), q)};
    if (occluders_->blocker(answer_.sightline[0], answer_.sightline[1], scene_->near_source_plane(),
                            scene_->near_target_plane()))
      continue;
    answer_.status = Weak_status::visible;
    ++counters_->confirmed;
    return;
  }
  answer_.status = Weak_status::undecided;  // pieces that near_shaft left out
  ++counters_->refuted;
}

void Event_search::keep_surface(const Curve& curve, const Parameter_range& range) {
  constexpr long rows = 8;
  Surface surface{curve.kind, {}};
  const Rational low(range.low.bits(60) + 2, Integer(1) << 60), high(range.high.bits(60) - 1, Integer(1) << 60);
  for (long k = 0; k <= rows && low < high; ++k) {
    const Event_chart chart = curve.chart(Rational(low + (high - low) * k / rows));
    const Exact_pluecker line = join(chart.v, chart.w);
    Homogeneous p = meet(scene_->source_plane(), line), q = meet(scene_->target_plane(), line);
    if (sgn(p[3]) != 0 && sgn(q[3]) != 0) surface.rulings.push_back({p, q});
  }
  if (surface.rulings.size() > 1) surfaces_.push_back(std::move(surface));
}

bool Event_search::ends_if(bool out) {
  if (out && answer_.status != Weak_status::visible) answer_.status = Weak_status::undecided;
  return out;
}

}  // namespace sightline
