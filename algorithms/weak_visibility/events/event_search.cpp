#include <sightline/algorithms/weak_visibility/events/event_search.h>

#include <algorithm>
#include <span>
#include <utility>

namespace sightline {
namespace {

/// The lines through ends of two edges.
std::array<Joined_line, 4> extreme_lines(const Event_lines::Event_line& a, const Event_lines::Event_line& b) {
  return {Joined_line(a.hull[0], b.hull[0]), Joined_line(a.hull[0], b.hull[1]), Joined_line(a.hull[1], b.hull[0]),
          Joined_line(a.hull[1], b.hull[1])};
}

/// The side of a line that all lines through two edges have inside both; 0 where they differ or are all 0.
int common_side(const std::array<Joined_line, 4>& extreme, const Event_lines::Event_line& line) {
  bool positive = false, negative = false;
  for (const Joined_line& e : extreme) {
    const int s = side(e, line);
    positive |= s > 0;
    negative |= s < 0;
    if (positive && negative) return 0;
  }
  return positive == negative ? 0 : positive ? 1 : -1;
}

}  // namespace

Events_answer Event_search::run() {
  counters_->occluders += scene_->blockers().size();
  counters_->lines += scene_->lines().size();
  counters_->untouched += scene_->untouched();
  answer_.status = Weak_status::hidden;
  if (in_one_shadow()) ++counters_->in_shadow;
  else if (!pencils()) reguli();
  return answer_;
}

bool Event_search::in_one_shadow() const {
  std::vector<Joined_line> extreme;
  for (const Filtered& p : scene_->source())
    for (const Filtered& q : scene_->target()) extreme.emplace_back(p, q);
  return std::any_of(scene_->blockers().begin(), scene_->blockers().end(), [&](const Blocker& blocker) {
    return std::all_of(blocker.literals.begin(), blocker.literals.end(), [&](const Literal& literal) {
      return std::all_of(extreme.begin(), extreme.end(), [&](const Joined_line& line) {
        return literal.sense * side(line, lines()[literal.line]) >= 0;
      });
    });
  });
}

bool Event_search::pencils() {
  if (!planes_.find([&] { return out_of_time(); })) return true;
  std::map<Homogeneous, Edge_planes::Planes, Less_entries> searched = planes_.vertices();
  for (const auto& [plane, flat] : planes_.flats())
    if (search_flat(plane, flat, searched)) return true;
  return std::any_of(searched.begin(), searched.end(),
                     [&](const auto& vertex) { return search_vertex(vertex.first, vertex.second); });
}

bool Event_search::search_flat(const Homogeneous& plane, const Edge_planes::Flat& flat,
                               std::map<Homogeneous, Edge_planes::Planes, Less_entries>& searched) {
  const Edge_planes::Section section = planes_.section_of(plane);
  if (!section.is_usable) {
    ++counters_->off_polygons;
    return out_of_time();
  }
  for (const Homogeneous& point : planes_.points_in(plane, flat, counters_->off_polygons)) {
    const auto vertex = searched.find(point);
    if (vertex != searched.end()) vertex->second.insert(plane);
    if (search_pencil(Event_kind::horizon, planes_.point(point), section)) return true;
  }
  return false;
}

bool Event_search::search_vertex(const Homogeneous& point, const Edge_planes::Planes& flats) {
  const Filtered vertex = planes_.point(point);
  if (out_of_time()) return true;
  if (planes_.leads_nowhere(vertex)) {
    ++counters_->off_edges;
    return false;
  }
  for (const Homogeneous& plane : planes_.planes_through(vertex, counters_->off_polygons))
    if (flats.count(plane) == 0 && search_pencil(Event_kind::edge_vertex, vertex, planes_.section_of(plane)))
      return true;
  return false;
}

bool Event_search::search_pencil(Event_kind kind, const Filtered& vertex, const Edge_planes::Section& section) {
  ++(kind == Event_kind::horizon ? counters_->horizon : counters_->edge_vertex);
  if (planes_.leads_nowhere(vertex)) {
    ++counters_->off_edges;
  } else if (!section.is_usable) {
    ++counters_->off_polygons;
  } else {
    const Event_pencil curve(kind, vertex, section.plane.exact, section.ends);
    if (!is_idle(curve) && search_curve(curve, {Quadratic_root(0), Quadratic_root(1)})) return true;
  }
  return out_of_budget();
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
      if (certain_side(a.near, b.near) == 0 && sgn(side(a.pluecker, b.pluecker)) == 0) continue;
      const std::array<Joined_line, 4> extreme = extreme_lines(a, b);
      usable[i][j] = can_pass(extreme, scene_->from()) && can_pass(extreme, scene_->to());
      if (!usable[i][j]) ++counters_->unpaired;
    }
  }
  for (std::size_t i = 0; i < real.size(); ++i)
    for (std::size_t j = i + 1; j < real.size(); ++j) {
      if (!usable[i][j]) continue;
      const std::array<Joined_line, 4> extreme = extreme_lines(lines()[real[i]], lines()[real[j]]);
      for (std::size_t k = j + 1; k < real.size(); ++k) {
        if (!usable[i][k] || !usable[j][k]) continue;
        ++counters_->triple;
        if (common_side(extreme, lines()[real[k]]) != 0) ++counters_->off_edges;
        else if (search_regulus({real[i], real[j], real[k]})) return true;
        if (out_of_budget()) return true;
      }
    }
  return false;
}

bool Event_search::can_pass(const std::array<Joined_line, 4>& extreme, const std::vector<Literal>& literals) const {
  bool positive = false, negative = false;
  for (const Literal& literal : literals) {
    const int s = literal.sense * common_side(extreme, lines()[literal.line]);
    positive |= s > 0;
    negative |= s < 0;
  }
  return !(positive && negative);
}

bool Event_search::search_regulus(const std::array<std::uint32_t, 3>& edges) {
  const Event_regulus curve(lines(), edges);
  if (is_idle(curve)) return false;
  const std::vector<Parameter_range> touching = curve.touching();
  if (touching.empty()) ++counters_->off_edges;
  return std::any_of(touching.begin(), touching.end(),
                     [&](const Parameter_range& range) { return search_curve(curve, range); });
}

// ---- Along an event

bool Event_search::is_idle(const Event_curve& curve) {
  const auto together = [&](std::span<const std::uint32_t> blockers, int turn, Curve_halves::Courses courses) {
    return cover_.holds(blockers, [&](const Literal& literal) {
      const int own = courses[literal.line];
      return own == 1 || own == -1 ? own * literal.sense * turn : 0;
    });
  };
  switch (halves_.search(
      curve, [](const Near_part&) { return false; }, together)) {
    case Curve_halves::Idle::no: return false;
    case Curve_halves::Idle::off_edges: ++counters_->off_edges; return true;
    case Curve_halves::Idle::off_polygons: ++counters_->off_polygons; return true;
    case Curve_halves::Idle::covered: ++counters_->covered; return true;
  }
  return false;
}

const Quadratic& Event_search::polynomial(const Event_curve& curve, std::uint32_t line) {
  if (known_[line] != 1) {
    for (std::size_t k = 0; k < 3; ++k) polynomials_[line].c[k] = side(curve.lines()[k], lines()[line].pluecker);
    known_[line] = 1;
  }
  return polynomials_[line];
}

int Event_search::course(const Event_curve& curve, std::uint32_t line) {
  signed char& known = courses_[line];
  if (known != unknown) return known;
  if (const std::optional<int> near = curve.near().course(lines()[line].near))
    return known = static_cast<signed char>(*near);
  const Quadratic& f = polynomial(curve, line);
  return known = static_cast<signed char>(f.is_zero() ? touched : f.certain_sign());
}

int Event_search::common_sign(const Event_curve& curve, const std::vector<Literal>& literals, const Rational& s) {
  bool positive = false, negative = false;
  for (const Literal& literal : literals) {
    const int own = sign(curve, literal.line, s) * literal.sense;
    positive |= own > 0;
    negative |= own < 0;
  }
  return positive == negative ? 0 : positive ? 1 : -1;
}

int Event_search::sign(const Event_curve& curve, std::uint32_t line, const Rational& s) {
  const int all = course(curve, line);
  return all == touched ? 0 : all != 0 ? all : polynomial(curve, line).sign(s);
}

void Event_search::append_polynomials(const Event_curve& curve, const std::vector<Literal>& literals,
                                      std::vector<Quadratic>& found) {
  for (const Literal& literal : literals)
    if (course(curve, literal.line) == 0) found.push_back(polynomial(curve, literal.line));
}

bool Event_search::never_passes(const Event_curve& curve, const std::vector<Literal>& literals) {
  bool positive = false, negative = false;
  for (const Literal& literal : literals) {
    const int all = course(curve, literal.line);
    if (all == touched) continue;
    positive |= literal.sense * all > 0;
    negative |= literal.sense * all < 0;
  }
  return positive && negative;
}

std::vector<Event_search::Active> Event_search::parts_between(const Event_curve& curve, const Parameter_range& range) {
  std::vector<Quadratic> ends;
  append_polynomials(curve, scene_->from(), ends);
  append_polynomials(curve, scene_->to(), ends);
  std::vector<Active> active;
  for (const Parameter_range& part : divided(range, ends)) {
    const Rational s = ends.empty() ? Rational(0) : inner_rational(part);
    const int turn = common_sign(curve, scene_->from(), s);
    if (turn != 0 && turn == common_sign(curve, scene_->to(), s)) active.push_back({Active_subranges(part), turn});
  }
  return active;
}

bool Event_search::search_curve(const Event_curve& curve, const Parameter_range& range) {
  std::fill(known_.begin(), known_.end(), char{0});
  std::fill(courses_.begin(), courses_.end(), unknown);
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
    if (out_of_time()) return true;
    if (std::any_of(blocker.literals.begin(), blocker.literals.end(),
                    [&](const Literal& literal) { return course(curve, literal.line) == touched; })) {
      grazed.push_back(&blocker);
      continue;
    }
    crossed.push_back(&blocker);
    subtract(curve, blocker, active);
    if (active.empty()) {
      ++counters_->covered;
      return false;
    }
  }
  std::vector<Quadratic> ends = curve.ends(lines());
  for (const Blocker* blocker : grazed) append_polynomials(curve, blocker->literals, ends);
  for (const Active& part : active)
    for (const Parameter_range& left : part.left.ranges()) {
      if (options_->surfaces) keep_surface(curve, left);
      if (answer_.status != Weak_status::visible && look_beside(curve, left, part.turn, ends, crossed, grazed) &&
          !options_->surfaces)
        return true;
    }
  return false;
}

void Event_search::subtract(const Event_curve& curve, const Blocker& blocker, std::vector<Active>& active) {
  for (Active& part : active) {
    bool passes = true, covers = true;
    for (const Literal& literal : blocker.literals) {
      const int own = course(curve, literal.line) * literal.sense * part.turn;
      passes &= own >= 0;
      covers &= own > 0;
      if (!passes) break;
    }
    if (!passes) continue;
    if (covers) {
      part.turn = 0;
      continue;
    }
    std::vector<Quadratic> polynomials;
    append_polynomials(curve, blocker.literals, polynomials);
    subtract_where(part.left, polynomials,
                   [&](const Rational& s) { return common_sign(curve, blocker.literals, s) == part.turn; });
  }
  std::erase_if(active, [](const Active& part) { return part.turn == 0 || part.left.empty(); });
}

bool Event_search::look_beside(const Event_curve& curve, const Parameter_range& active, int turn,
                               std::span<const Quadratic> ends, const std::vector<const Blocker*>& crossed,
                               const std::vector<const Blocker*>& grazed) {
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

bool Event_search::is_past(const Event_curve& curve, const Blocker& blocker, const Rational& s, int turn) {
  return std::any_of(blocker.literals.begin(), blocker.literals.end(),
                     [&](const Literal& literal) { return literal.sense * turn * sign(curve, literal.line, s) < 0; });
}

bool Event_search::look_around(const Event_curve& curve, const Rational& s, int turn,
                               const std::vector<const Blocker*>& grazed) {
  std::vector<const Exact_pluecker*> met;
  std::vector<std::uint32_t> place(lines().size(), none);
  const auto touch = [&](std::uint32_t line) {
    if (place[line] == none && course(curve, line) == touched) {
      place[line] = static_cast<std::uint32_t>(met.size());
      met.push_back(&lines()[line].pluecker);
    }
  };
  for (const std::uint32_t edge : curve.edges()) touch(edge);  // independent, so first
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
  return curve.kind() == Event_kind::triple ? visit_cells_at_regulus(chart, met, visit)
                                            : visit_cells_at_pencil(chart, met, visit);
}

int Event_search::orientation(const Event_chart& chart, const Event_curve& curve, const Rational& s) {
  const Exact_pluecker line = join(chart.v, chart.w);
  const auto entry = std::find_if(line.begin(), line.end(), [](const Integer& x) { return sgn(x) != 0; });
  const auto k = static_cast<std::size_t>(entry - line.begin());
  return sgn(line[k]) * Quadratic{{curve.lines()[0][k], curve.lines()[1][k], curve.lines()[2][k]}}.sign(s);
}

void Event_search::confirm(const Event_chart& chart, const Event_move& move) {
  // Sides are polynomials of the step with coefficients of a few times as many bits: its least root is beyond these.
  std::size_t longest = bit_length(move.second.get_den());
  for (const Homogeneous* point : {&chart.v, &chart.w, &chart.r, &chart.n})
    for (const Integer& coordinate : *point) longest = std::max<std::size_t>(longest, bit_length(coordinate));
  for (const Rational& by : move.first) longest = std::max<std::size_t>(longest, bit_length(by.get_den()));
  for (unsigned long bits = 1; bits <= 8192 + 64 * longest; bits *= 2) {
    const Exact_pluecker line = moved(chart, move, Rational(Integer(1), Integer(Integer(1) << bits)));
    Homogeneous p = meet(scene_->source_plane().exact, line), q = meet(scene_->target_plane().exact, line);
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
    if (sgn(dot(scene_->source_plane().exact, q)) <= 0) continue;
    answer_.sightline = {near_point(occluders_->frame(), p), near_point(occluders_->frame(), q)};
    if (occluders_->blocker(answer_.sightline[0], answer_.sightline[1], scene_->near_source_plane(),
                            scene_->near_target_plane()))
      continue;
    answer_.status = Weak_status::visible;
    ++counters_->confirmed;
    return;
  }
  answer_.status = Weak_status::undecided;  // never, by P-73
  ++counters_->refuted;
}

void Event_search::keep_surface(const Event_curve& curve, const Parameter_range& range) {
  constexpr long rows = 8;
  // 1. Fractions within the range, of as many bits as it needs.
  if (!(range.low < range.high)) return;
  unsigned long bits = 60;
  Integer low, high;
  for (;; bits *= 2) {
    low = range.low.bits(bits) + 2;
    high = range.high.bits(bits) - 1;
    if (high - low >= rows) break;
  }

  // 2. Lines there.
  Surface surface{curve.kind(), {}};
  for (long k = 0; k <= rows; ++k) {
    Rational s(low * rows + (high - low) * k, Integer(rows) << bits);
    s.canonicalize();
    const Event_chart chart = curve.chart(s);
    const Exact_pluecker line = join(chart.v, chart.w);
    Homogeneous p = meet(scene_->source_plane().exact, line), q = meet(scene_->target_plane().exact, line);
    if (sgn(p[3]) != 0 && sgn(q[3]) != 0) surface.rulings.push_back({p, q});
  }
  if (surface.rulings.size() > 1) surfaces_.push_back(std::move(surface));
}

bool Event_search::ends_if(bool out) {
  if (out && answer_.status != Weak_status::visible) answer_.status = Weak_status::undecided;
  return out;
}

}  // namespace sightline
