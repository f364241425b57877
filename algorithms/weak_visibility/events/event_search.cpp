#include <sightline/algorithms/weak_visibility/events/event_search.h>

#include <algorithm>
#include <set>
#include <span>
#include <stdexcept>
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

/// The side of a plane on which all points surely are; 0 where doubles do not tell, or they are on both.
int common_side(const Near<4>& plane, std::span<const Filtered> points) {
  int common = 0;
  for (const Filtered& point : points) {
    const int sure = certain_dot(plane, point.near);
    if (sure == 0 || sure == -common) return 0;
    common = sure;
  }
  return common;
}

}  // namespace

Events_answer Event_search::run() {
  counters_->occluders += scene_->blockers().size();
  counters_->lines += scene_->lines().size();
  counters_->untouched += scene_->untouched();
  answer_.status = Weak_status::hidden;
  for (std::uint32_t b = 0; b < scene_->blockers().size(); ++b) all_blockers_.push_back(b);
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
  Flats flats;
  Vertices vertices;
  if (!find_vertices(flats, vertices)) return true;
  for (const auto& [plane, flat] : flats)
    if (search_flat(plane, flat, vertices)) return true;
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](const auto& vertex) { return search_vertex(vertex.first, vertex.second); });
}

bool Event_search::find_vertices(Flats& flats, Vertices& vertices) {
  for (std::uint32_t i = 0; i < lines().size(); ++i) {
    if (out_of_time()) return false;
    for (std::uint32_t j = i + 1; j < lines().size(); ++j) {
      const Event_line &a = lines()[i], &b = lines()[j];
      if (!a.real || !b.real || (a.in_source && b.in_source) || certain_side(a.near, b.near) != 0 ||
          sgn(side(a.pluecker, b.pluecker)) != 0)
        continue;
      const Homogeneous& off = (all_zero(join(b.hull[0].exact, a.pluecker)) ? b.hull[1] : b.hull[0]).exact;
      Homogeneous plane = join(off, a.pluecker);
      make_canonical(plane);
      Flat& flat = flats[plane];
      for (const std::uint32_t edge : {i, j})
        if (std::find(flat.edges.begin(), flat.edges.end(), edge) == flat.edges.end()) flat.edges.push_back(edge);
      if (a.in_source || b.in_source) continue;
      Homogeneous at = meet(join(off_plane(plane), a.pluecker), b.pluecker);
      if (!Event_lines::in_hull(a, at) || !Event_lines::in_hull(b, at)) continue;
      make_canonical(at);
      vertices[at].insert(plane);
      flat.points.insert(std::move(at));
    }
  }
  return true;
}

bool Event_search::search_flat(const Homogeneous& plane, const Flat& flat, Vertices& vertices) {
  const Section section = section_of(plane);
  if (!section.is_usable) {
    ++counters_->off_polygons;
    return out_of_time();
  }
  // Points in which two of its edges meet, and those of other edges.
  std::set<Homogeneous, Less_entries> points = flat.points;
  for (const Event_line& line : lines()) {
    if (!line.real || line.in_source || common_side(section.plane.near, line.hull) != 0) continue;
    Homogeneous at = meet(plane, line.pluecker);
    if (all_zero(at) || !Event_lines::in_hull(line, at)) continue;
    make_canonical(at);
    if (points.count(at) != 0) continue;
    const Filtered point{at, near(occluders_->frame(), at)};
    if (std::any_of(flat.edges.begin(), flat.edges.end(),
                    [&](std::uint32_t edge) { return may_pass(point, lines()[edge]); }))
      points.insert(std::move(at));
    else ++counters_->off_polygons;
  }
  for (const Homogeneous& point : points) {
    const auto vertex = vertices.find(point);
    if (vertex != vertices.end()) vertex->second.insert(plane);
    if (search_pencil(Event_kind::horizon, {point, near(occluders_->frame(), point)}, section)) return true;
  }
  return false;
}

bool Event_search::search_vertex(const Homogeneous& point, const Planes& flats) {
  const Filtered vertex{point, near(occluders_->frame(), point)};
  if (out_of_time()) return true;
  if (leads_nowhere(vertex)) {
    ++counters_->off_edges;
    return false;
  }
  Planes planes;
  for (const Event_line& line : lines()) {
    if (!line.real) continue;
    const Near<4> near_plane = join(vertex.near, line.near);
    if (common_side(near_plane, scene_->target()) != 0 || common_side(near_plane, scene_->source()) != 0 ||
        !may_pass(vertex, line)) {
      ++counters_->off_polygons;
      continue;
    }
    Homogeneous plane = join(point, line.pluecker);
    if (all_zero(plane)) continue;
    make_canonical(plane);
    if (flats.count(plane) == 0) planes.insert(std::move(plane));
  }
  return std::any_of(planes.begin(), planes.end(), [&](const Homogeneous& plane) {
    return search_pencil(Event_kind::edge_vertex, vertex, section_of(plane));
  });
}

bool Event_search::leads_nowhere(const Filtered& vertex) const {
  // In the plane of the source, or behind.
  return sign_of_dot(scene_->source_plane(), vertex) <= 0 ||
         sign_of_dot(scene_->target_plane(), vertex) * scene_->beside() < 0;
}

bool Event_search::search_pencil(Event_kind kind, const Filtered& vertex, const Section& section) {
  ++(kind == Event_kind::horizon ? counters_->horizon : counters_->edge_vertex);
  if (leads_nowhere(vertex)) {
    ++counters_->off_edges;
  } else if (!section.is_usable) {
    ++counters_->off_polygons;
  } else {
    const Event_pencil curve(kind, vertex, section.plane.exact, section.ends);
    if (!is_idle(curve) && search_curve(curve, {Quadratic_root(0), Quadratic_root(1)})) return true;
  }
  return out_of_budget();
}

bool Event_search::may_pass(const Filtered& vertex, const Event_line& line) const {
  const std::array<Near<6>, 2> between{join(vertex.near, line.hull[0].near), join(vertex.near, line.hull[1].near)};
  return scene_->may_pass(between, scene_->from()) && scene_->may_pass(between, scene_->to());
}

Event_search::Section Event_search::section_of(const Homogeneous& plane) const {
  Section found{{plane, near(near_plane(occluders_->frame(), plane))}, false, {}};
  // Where it only touches the target in a corner, that may be the point of a pencil.
  bool in_front = false, behind = false, touches = false;
  for (const Filtered& corner : scene_->target()) {
    const int at = sign_of_dot(found.plane, corner);
    (at > 0 ? in_front : at < 0 ? behind : touches) = true;
  }
  if ((!in_front || !behind) && !touches) return found;
  // The segment in which it meets the source.
  std::vector<Homogeneous> ends;
  const std::span<const Filtered> source = scene_->source();
  std::vector<int> sides;
  for (const Filtered& corner : source) sides.push_back(sign_of_dot(found.plane, corner));
  for (std::size_t i = 0; i < source.size(); ++i) {
    const std::size_t next = (i + 1) % source.size();
    const Homogeneous &a = source[i].exact, &b = source[next].exact;
    if (sides[i] == 0) ends.push_back(a);
    if (sides[i] * sides[next] >= 0) continue;
    const Integer at = abs(dot(plane, a)), after = abs(dot(plane, b));
    Homogeneous x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = after * a[k] + at * b[k];
    make_canonical(x);
    ends.push_back(x);
  }
  found.is_usable = ends.size() == 2;
  if (found.is_usable)
    for (std::size_t k = 0; k < 2; ++k) found.ends[k] = {ends[k], near(occluders_->frame(), ends[k])};
  return found;
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

int Event_search::course(const Near_part& part, std::uint32_t line, int depth) {
  signed char& known = near_courses_[static_cast<std::size_t>(depth)][line];
  if (known == unset) known = static_cast<signed char>(part.course(lines()[line].near).value_or(unknown));
  return known;
}

bool Event_search::is_idle(const Event_curve& curve) {
  std::fill(near_courses_[0].begin(), near_courses_[0].end(), unset);
  switch (idle(curve, curve.near(), all_blockers_, 0)) {
    case Idle::no: return false;
    case Idle::off_edges: ++counters_->off_edges; return true;
    case Idle::off_polygons: ++counters_->off_polygons; return true;
    case Idle::covered: ++counters_->covered; return true;
  }
  return false;
}

Event_search::Idle Event_search::idle(const Event_curve& curve, const Near_part& part,
                                      std::span<const std::uint32_t> blockers, int depth) {
  if (curve.is_off(part)) return Idle::off_edges;
  // The direction in which its lines go from the source to the target, if any do.
  int turn = 0;
  for (const std::vector<Literal>* literals : {&scene_->from(), &scene_->to()}) {
    bool positive = false, negative = false;
    for (const Literal& literal : *literals) {
      const int own = course(part, literal.line, depth);
      if (own == unknown) continue;
      positive |= own * literal.sense > 0;
      negative |= own * literal.sense < 0;
    }
    if (positive && negative) return Idle::off_polygons;
    const int own = positive ? 1 : negative ? -1 : 0;
    if (own * turn < 0) return Idle::off_polygons;
    if (own != 0) turn = own;
  }
  // Pieces that block all of it, or some.
  std::vector<std::uint32_t> some;
  for (const std::uint32_t b : blockers) {
    bool all = turn != 0, any = true;
    for (const Literal& literal : scene_->blockers()[b].literals) {
      const int own = course(part, literal.line, depth);
      all &= own == literal.sense * turn;
      any &= turn == 0 || own != -literal.sense * turn;
      if (!any) break;
    }
    if (any && all) return Idle::covered;
    if (any) some.push_back(b);
  }
  if (turn != 0 && are_covered_together(some, turn, depth)) return Idle::covered;
  if (depth == deepest) return Idle::no;
  Idle reason = Idle::no;
  const std::vector<signed char>& known = near_courses_[static_cast<std::size_t>(depth)];
  for (const Near_part& one : part.halves()) {
    std::transform(known.begin(), known.end(), near_courses_[static_cast<std::size_t>(depth) + 1].begin(),
                   [](signed char own) { return own == 1 || own == -1 ? own : unset; });
    const Idle own = idle(curve, one, some, depth + 1);
    if (own == Idle::no) return Idle::no;
    reason = std::max(reason, own);
  }
  return reason;
}

bool Event_search::are_covered_together(std::span<const std::uint32_t> blockers, int turn, int depth) {
  const std::vector<signed char>& known = near_courses_[static_cast<std::size_t>(depth)];
  return cover_.holds(blockers, [&](const Literal& literal) {
    const int own = known[literal.line];
    return own == 1 || own == -1 ? own * literal.sense * turn : 0;
  });
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
  for (std::size_t k = 0; k < 6; ++k)
    if (sgn(line[k]) != 0)
      return sgn(line[k]) * Quadratic{{curve.lines()[0][k], curve.lines()[1][k], curve.lines()[2][k]}}.sign(s);
  throw std::logic_error("a chart of no line");
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
  answer_.status = Weak_status::undecided;  // pieces that near_shaft left out
  ++counters_->refuted;
}

void Event_search::keep_surface(const Event_curve& curve, const Parameter_range& range) {
  constexpr long rows = 8;
  Surface surface{curve.kind(), {}};
  const Rational low(range.low.bits(60) + 2, Integer(1) << 60), high(range.high.bits(60) - 1, Integer(1) << 60);
  for (long k = 0; k <= rows && low < high; ++k) {
    const Event_chart chart = curve.chart(Rational(low + (high - low) * k / rows));
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
