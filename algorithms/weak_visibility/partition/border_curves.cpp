#include <sightline/algorithms/weak_visibility/partition/border_curves.h>

#include <algorithm>
#include <iterator>
#include <optional>

namespace sightline {
namespace {

/// The side of a plane on which all points surely are; 0 where doubles do not tell, or they are on both.
int sure_side(const Near<4>& plane, std::span<const Filtered> points) {
  int common = 0;
  for (const Filtered& point : points) {
    const int sure = certain_dot(plane, point.near);
    if (sure == 0 || sure == -common) return 0;
    common = sure;
  }
  return common;
}

/// The ends of the segment in which a plane meets a convex polygon; fewer where it does not, or only touches a corner.
std::vector<Filtered> section(const Near_frame& frame, const Filtered& plane, std::span<const Filtered> polygon) {
  std::vector<Homogeneous> ends;
  std::vector<int> sides;
  for (const Filtered& corner : polygon) sides.push_back(sign_of_dot(plane, corner));
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    const Homogeneous &a = polygon[i].exact, &b = polygon[next].exact;
    if (sides[i] == 0) ends.push_back(a);
    if (sides[i] * sides[next] >= 0) continue;
    const Integer at = abs(dot(plane.exact, a)), after = abs(dot(plane.exact, b));
    Homogeneous x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = after * a[k] + at * b[k];
    make_canonical(x);
    ends.push_back(x);
  }
  std::vector<Filtered> found;
  for (const Homogeneous& end : ends) found.push_back({end, near(frame, end)});
  return found;
}

std::array<Near<6>, 4> lines_through_ends(const Event_lines::Event_line& a, const Event_lines::Event_line& b) {
  return {join(a.hull[0].near, b.hull[0].near), join(a.hull[0].near, b.hull[1].near),
          join(a.hull[1].near, b.hull[0].near), join(a.hull[1].near, b.hull[1].near)};
}

}  // namespace

Border_search::Border_search(const Occluders& occluders, const Event_lines& lines, const Plane_chart& chart,
                             const std::function<bool()>& out_of_time, Border_counters& counters)
    : occluders_(&occluders),
      lines_(&lines),
      chart_(&chart),
      out_of_time_(out_of_time),
      counters_(&counters),
      courses_(deepest + 1, std::vector<signed char>(lines.lines().size())) {}

std::vector<Border_curve> Border_search::run() {
  counters_->lines += lines().size();
  edges_in_the_plane();
  lines_between_points_in_the_plane();
  planes();
  reguli();
  std::vector<Border_curve> curves;
  for (auto& [key, curve] : found_) curves.push_back(std::move(curve));
  counters_->curves += curves.size();
  return curves;
}

void Border_search::add(const Plane_curve& curve, bool may_end_light, const std::vector<Plane_chart::Bounds>& where) {
  for (const Plane_curve& part : components(curve)) {
    Border_curve& own = found_[part.c];
    own.curve = part;
    own.may_end_light |= may_end_light;
    own.where.insert(own.where.end(), where.begin(), where.end());
  }
}

void Border_search::edges_in_the_plane() {
  for (const Event_line& line : lines()) {
    if (!line.real || !line.in_source) continue;
    const std::array<Rational, 2> a = chart_->at(line.hull[0].exact), b = chart_->at(line.hull[1].exact);
    constexpr double slack = 0x1p-40;
    const double x[2] = {a[0].get_d(), b[0].get_d()}, y[2] = {a[1].get_d(), b[1].get_d()};
    const Plane_chart::Bounds where{std::min(x[0], x[1]) - slack, std::max(x[0], x[1]) + slack,
                                    std::min(y[0], y[1]) - slack, std::max(y[0], y[1]) + slack};
    add(chart_->line(line.hull[0].exact, line.hull[1].exact), true, {where});
  }
}

void Border_search::lines_between_points_in_the_plane() {
  // Lines that lie in the plane themselves reach the source only if that has a point in it.
  const auto in_plane = [&](const Filtered& p) { return sign_of_dot(lines_->source_plane(), p) == 0; };
  if (std::none_of(lines_->target().begin(), lines_->target().end(), in_plane)) return;
  Points points;
  for (const Event_line& line : lines()) {
    if (!line.real) continue;
    if (line.in_source) {
      for (const Filtered& end : line.hull) points.insert(end.exact);
      continue;
    }
    Homogeneous at = meet(lines_->source_plane().exact, line.pluecker);
    if (all_zero(at) || !Event_lines::in_hull(line, at)) continue;
    make_canonical(at);
    points.insert(std::move(at));
  }
  for (auto p = points.begin(); p != points.end(); ++p)
    for (auto q = std::next(p); q != points.end(); ++q) add(chart_->line(*p, *q), true, {{-1, 2, -1, 2}});
}

// ---- Lines: planes with edges and vertices

void Border_search::planes() {
  struct Flat {
    std::vector<std::uint32_t> edges;
    Points points;
  };
  std::map<Homogeneous, Flat, Less_entries> flats;
  Points vertices;
  for (std::uint32_t i = 0; i < lines().size(); ++i) {
    if (out_of_time()) return;
    for (std::uint32_t j = i + 1; j < lines().size(); ++j) {
      const Event_line &a = lines()[i], &b = lines()[j];
      if (!a.real || !b.real || a.in_source || b.in_source || certain_side(a.near, b.near) != 0 ||
          sgn(side(a.pluecker, b.pluecker)) != 0)
        continue;
      const Homogeneous& off = (all_zero(join(b.hull[0].exact, a.pluecker)) ? b.hull[1] : b.hull[0]).exact;
      Homogeneous plane = join(off, a.pluecker);
      make_canonical(plane);
      Flat& flat = flats[plane];
      for (const std::uint32_t edge : {i, j})
        if (std::find(flat.edges.begin(), flat.edges.end(), edge) == flat.edges.end()) flat.edges.push_back(edge);
      Homogeneous at = meet(join(off_plane(plane), a.pluecker), b.pluecker);
      if (!Event_lines::in_hull(a, at) || !Event_lines::in_hull(b, at)) continue;
      make_canonical(at);
      vertices.insert(at);
      flat.points.insert(std::move(at));
    }
  }
  std::map<Homogeneous, Points, Less_entries> all;
  // 1. Of two edges: with points in which others meet the plane.
  for (const auto& [plane, flat] : flats) {
    const Filtered filtered{plane, near(near_plane(occluders_->frame(), plane))};
    Points& points = all[plane];
    points = flat.points;
    for (const Event_line& line : lines()) {
      if (!line.real || line.in_source || sure_side(filtered.near, line.hull) != 0) continue;
      Homogeneous at = meet(plane, line.pluecker);
      if (all_zero(at) || !Event_lines::in_hull(line, at)) continue;
      make_canonical(at);
      const Near<4> near_at = near(occluders_->frame(), at);
      if (std::any_of(flat.edges.begin(), flat.edges.end(), [&, &of = flat](std::uint32_t edge) {
            const std::array<Near<6>, 2> between{join(near_at, lines()[edge].hull[0].near),
                                                 join(near_at, lines()[edge].hull[1].near)};
            return may_pass(between);
          }))
        points.insert(std::move(at));
    }
  }
  // 2. Of a vertex and an edge.
  for (const Homogeneous& vertex : vertices) {
    if (out_of_time()) return;
    const Near<4> near_vertex = near(occluders_->frame(), vertex);
    for (const Event_line& line : lines()) {
      if (!line.real || line.in_source) continue;
      const std::array<Near<6>, 2> between{join(near_vertex, line.hull[0].near), join(near_vertex, line.hull[1].near)};
      const Near<4> near_plane = join(near_vertex, line.near);
      if (sure_side(near_plane, lines_->target()) != 0 || sure_side(near_plane, lines_->source()) != 0 ||
          !may_pass(between))
        continue;
      Homogeneous plane = join(vertex, line.pluecker);
      if (all_zero(plane)) continue;
      make_canonical(plane);
      all[plane].insert(vertex);
    }
  }
  counters_->planes += all.size();
  for (const auto& [plane, points] : all) {
    if (out_of_time()) return;
    pencils(plane, points);
  }
}

void Border_search::pencils(const Homogeneous& plane, const Points& vertices) {
  const Filtered filtered{plane, near(near_plane(occluders_->frame(), plane))};
  bool in_front = false, behind = false, touches = false;
  for (const Filtered& corner : lines_->target()) {
    const int at = sign_of_dot(filtered, corner);
    (at > 0 ? in_front : at < 0 ? behind : touches) = true;
  }
  if ((!in_front || !behind) && !touches) return;
  const std::vector<Filtered> ends = section(occluders_->frame(), filtered, lines_->source());
  if (ends.size() != 2) return;
  const std::array<Filtered, 2> segment{ends[0], ends[1]};
  std::vector<Plane_chart::Bounds> where;
  for (const Homogeneous& vertex : vertices) {
    ++counters_->pencils;
    const Filtered at{vertex, near(occluders_->frame(), vertex)};
    // Not in the receiver's plane or behind it, nor beyond the source's.
    if (sign_of_dot(lines_->source_plane(), at) <= 0 || sign_of_dot(lines_->target_plane(), at) * lines_->beside() < 0)
      continue;
    const Event_pencil curve(Event_kind::edge_vertex, at, plane, segment);
    const std::vector<Plane_chart::Bounds> of_vertex = parts(curve);
    if (of_vertex.empty()) ++counters_->idle;
    where.insert(where.end(), of_vertex.begin(), of_vertex.end());
  }
  if (!where.empty()) add(chart_->trace(plane), !in_front || !behind, where);
}

// ---- Conics: three skew edges

void Border_search::reguli() {
  std::vector<std::uint32_t> real;
  for (std::uint32_t k = 0; k < lines().size(); ++k)
    if (lines()[k].real && !lines()[k].in_source) real.push_back(k);
  // Which pairs are skew, and touched by some line between the polygons.
  std::vector<std::vector<std::optional<std::array<Near<6>, 4>>>> usable(real.size());
  for (std::size_t i = 0; i < real.size(); ++i) {
    if (out_of_time()) return;
    usable[i].resize(real.size());
    for (std::size_t j = i + 1; j < real.size(); ++j) {
      const Event_line &a = lines()[real[i]], &b = lines()[real[j]];
      if (certain_side(a.near, b.near) == 0 && sgn(side(a.pluecker, b.pluecker)) == 0) continue;
      const std::array<Near<6>, 4> through = lines_through_ends(a, b);
      if (may_pass(through)) usable[i][j] = through;
    }
  }
  for (std::size_t i = 0; i < real.size(); ++i)
    for (std::size_t j = i + 1; j < real.size(); ++j) {
      if (!usable[i][j]) continue;
      if (out_of_time()) return;
      for (std::size_t k = j + 1; k < real.size(); ++k) {
        if (!usable[i][k] || !usable[j][k]) continue;
        ++counters_->triples;
        int common = 0;  // on which side of the third all lines through the others surely are
        for (const Near<6>& line : *usable[i][j]) {
          const int sure = certain_side(line, lines()[real[k]].near);
          if (sure == 0 || sure == -common) {
            common = 0;
            break;
          }
          common = sure;
        }
        std::vector<Plane_chart::Bounds> where;
        if (common == 0) where = parts(Event_regulus(lines(), {real[i], real[j], real[k]}));
        if (where.empty()) {
          ++counters_->idle;
          continue;
        }
        add(chart_->trace(lines()[real[i]].pluecker, lines()[real[j]].pluecker, lines()[real[k]].pluecker), false,
            where);
      }
    }
}

// ---- What of a curve of lines may matter, in doubles

int Border_search::course(const Near_part& part, std::uint32_t line, int depth) {
  signed char& known = courses_[static_cast<std::size_t>(depth)][line];
  if (known == unset) known = static_cast<signed char>(part.course(lines()[line].near).value_or(0));
  return known;
}

std::vector<Plane_chart::Bounds> Border_search::parts(const Event_curve& curve) {
  std::vector<Plane_chart::Bounds> found;
  std::vector<std::uint32_t> blockers(lines_->blockers().size());
  for (std::uint32_t b = 0; b < blockers.size(); ++b) blockers[b] = b;
  std::fill(courses_[0].begin(), courses_[0].end(), unset);
  collect(curve, curve.near(), blockers, 0, found);
  return found;
}

void Border_search::collect(const Event_curve& curve, const Near_part& part, std::span<const std::uint32_t> blockers,
                            int depth, std::vector<Plane_chart::Bounds>& found) {
  if (curve.is_off(part)) return;
  // 1. The direction in which its lines go from one polygon to the other, if any do.
  int turn = 0;
  for (const std::vector<Literal>* literals : {&lines_->from(), &lines_->to()}) {
    bool positive = false, negative = false;
    for (const Literal& literal : *literals) {
      const int own = course(part, literal.line, depth);
      positive |= own * literal.sense > 0;
      negative |= own * literal.sense < 0;
    }
    const int own = positive ? 1 : negative ? -1 : 0;
    if ((positive && negative) || own * turn < 0) return;
    if (own != 0) turn = own;
  }
  // 2. Pieces that block all of it, or some.
  std::vector<std::uint32_t> some;
  for (const std::uint32_t b : blockers) {
    bool all = turn != 0, any = true;
    for (const Literal& literal : lines_->blockers()[b].literals) {
      const int own = course(part, literal.line, depth);
      all &= own == literal.sense * turn;
      any &= turn == 0 || own != -literal.sense * turn;
      if (!any) break;
    }
    if (any && all) return;
    if (any) some.push_back(b);
  }
  // 3. By halves.
  if (depth == deepest) {
    found.push_back(chart_->bounds(part.lines));
    return;
  }
  const std::vector<signed char>& known = courses_[static_cast<std::size_t>(depth)];
  for (const Near_part& one : part.halves()) {
    std::transform(known.begin(), known.end(), courses_[static_cast<std::size_t>(depth) + 1].begin(),
                   [](signed char own) { return own == 1 || own == -1 ? own : unset; });
    collect(curve, one, some, depth + 1, found);
  }
}

}  // namespace sightline
