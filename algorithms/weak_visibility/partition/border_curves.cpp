#include <sightline/algorithms/weak_visibility/partition/border_curves.h>

#include <algorithm>
#include <iterator>
#include <optional>

namespace sightline {
namespace {

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
      halves_(lines, deepest) {}

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
  for (auto p = points.begin(); p != points.end(); ++p) {
    if (out_of_time()) return;
    for (auto q = std::next(p); q != points.end(); ++q) add(chart_->line(*p, *q), true, {{-1, 2, -1, 2}});
  }
}

// ---- Lines: planes with edges and vertices

void Border_search::planes() {
  Edge_planes planes(occluders_->frame(), *lines_, false);
  if (!planes.find([&] { return out_of_time(); })) return;
  std::map<Homogeneous, Points, Less_entries> all;
  std::size_t dropped = 0;
  for (const auto& [plane, flat] : planes.flats()) {
    if (out_of_time()) return;
    all[plane] = planes.points_in(plane, flat, dropped);
  }
  for (const auto& [vertex, flats] : planes.vertices()) {
    if (out_of_time()) return;
    for (const Homogeneous& plane : planes.planes_through(planes.point(vertex), dropped)) all[plane].insert(vertex);
  }
  counters_->planes += all.size();
  for (const auto& [plane, points] : all) {
    if (out_of_time()) return;
    pencils(planes, plane, points);
  }
}

void Border_search::pencils(const Edge_planes& planes, const Homogeneous& plane, const Points& vertices) {
  const Edge_planes::Section section = planes.section_of(plane);
  if (!section.is_usable) return;
  std::vector<Plane_chart::Bounds> where;
  for (const Homogeneous& vertex : vertices) {
    ++counters_->pencils;
    const Filtered at = planes.point(vertex);
    if (planes.leads_nowhere(at)) continue;
    const std::vector<Plane_chart::Bounds> of_vertex =
        parts(Event_pencil(Event_kind::edge_vertex, at, plane, section.ends));
    if (of_vertex.empty()) ++counters_->idle;
    where.insert(where.end(), of_vertex.begin(), of_vertex.end());
  }
  if (!where.empty()) add(chart_->trace(plane), !section.crosses_target, where);
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
        std::vector<Plane_chart::Bounds> where;
        // Not where all lines through two of them are surely on one side of the third.
        if (certain_side(*usable[i][j], lines()[real[k]].near) == 0)
          where = parts(Event_regulus(lines(), {real[i], real[j], real[k]}));
        if (where.empty()) {
          ++counters_->idle;
          continue;
        }
        add(chart_->trace(lines()[real[i]].pluecker, lines()[real[j]].pluecker, lines()[real[k]].pluecker), false,
            where);
      }
    }
}

std::vector<Plane_chart::Bounds> Border_search::parts(const Event_curve& curve) {
  std::vector<Plane_chart::Bounds> found;
  halves_.search(curve, [&](const Near_part& part) {
    found.push_back(chart_->bounds(part.lines));
    return true;
  });
  return found;
}

}  // namespace sightline
