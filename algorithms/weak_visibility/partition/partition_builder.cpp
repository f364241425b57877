// The grid: rectangles of which all points are alike, and sectors of the others.

#include <sightline/algorithms/weak_visibility/partition/partition_builder.h>

#include <sightline/algorithms/weak_visibility/partition/seen_part.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sightline::partition_detail {

// Of so many edges of a piece the lines may all cross: a box has a few parts more.
constexpr std::size_t many_edges = 8;

Partition_builder::Partition_builder(const Occluders& occluders, const Near_polygon& piece, const Near_plane& plane,
                                     const std::vector<Weak_source>& sources, const Partition_options& options,
                                     Partition_counters& counters)
    : occluders_(&occluders), options_(&options), counters_(&counters), chart_(occluders.frame(), piece, plane) {
  const Near_frame& frame = occluders.frame();
  std::map<std::array<Integer, 6>, std::size_t, Less_entries> numbers;
  const auto add = [&](Border_curve curve) {
    const auto [at, is_new] = numbers.try_emplace(curve.curve.c, curves_.size());
    if (is_new) {
      curves_.push_back(std::move(curve));
      return at->second;
    }
    Border_curve& own = curves_[at->second];
    own.may_end_light |= curve.may_end_light;
    own.where.insert(own.where.end(), curve.where.begin(), curve.where.end());
    return at->second;
  };
  constexpr Plane_chart::Bounds everywhere{-1, 2, -1, 2};

  // 1. The sources, and where what is seen of them changes.
  for (std::size_t number = 0; number < sources.size(); ++number) {
    const Weak_source& source = sources[number];
    const Near_polygon receiver = clip(frame, piece, source.plane, true),
                       seen = clip(frame, source.polygon, plane, true);
    if (receiver.size() < 3 || seen.size() < 3) {
      ++never_seen_;
      continue;
    }
    const int at = side(plane, source.polygon);
    sources_.push_back({number,
                        {source.plane.exact, near(source.plane)},
                        at == 1,
                        Event_lines(occluders, receiver, plane, seen, source.plane, 1)});
    Border_search search(
        occluders, sources_.back().lines, chart_, [this] { return is_over(); }, counters.borders);
    for (Border_curve& curve : search.run()) add(std::move(curve));
    if (is_across(source.plane, piece))
      for (const Plane_curve& line : components(chart_.trace(source.plane.exact))) add({line, true, {everywhere}});
    // Its middle, and near its corners.
    std::vector<Filtered>& probes = probes_.emplace_back();
    const auto weighed = [&](std::size_t corner, unsigned long weight) {
      Homogeneous sum{0, 0, 0, 0};
      for (std::size_t i = 0; i < seen.size(); ++i) {
        // Homogeneous coordinates with equal w.
        Integer w = i == corner ? weight : 1;
        for (std::size_t j = 0; j < seen.size(); ++j)
          if (j != i) w *= seen[j].exact[3];
        for (std::size_t k = 0; k < 4; ++k) sum[k] += w * seen[i].exact[k];
      }
      const Near_point p = near_point(frame, sum);
      probes.push_back({p.exact, near(p)});
    };
    weighed(seen.size(), 1);
    for (std::size_t corner = 0; corner < seen.size() && corner < 4; ++corner) weighed(corner, 32);
  }

  // 2. The rim of the piece.
  std::vector<std::array<Rational, 2>> corners;
  for (const Near_point& corner : piece) corners.push_back(chart_.at(corner.exact));
  std::array<Rational, 2> middle{0, 0};
  for (const auto& p : corners)
    for (std::size_t k = 0; k < 2; ++k) middle[k] += p[k] / Rational(static_cast<long>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    const std::vector<Plane_curve> line = components(chart_.line(piece[i].exact, piece[next].exact));
    const std::size_t number = add({line.front(), false, {everywhere}});
    Plane_curve inwards = line.front();
    if (inwards.sign(middle[0], middle[1]) < 0)
      for (Integer& c : inwards.c) c = -c;
    rim_.push_back({std::move(inwards), number, {corners[i], corners[next]}});
    piece_area_ += (corners[i][0] * corners[next][1] - corners[next][0] * corners[i][1]) / 2;
  }
  piece_area_ = abs(piece_area_);
}

void Partition_builder::run(Light_partition& result) {
  Blockers blockers;
  for (const Seen_source& source : sources_) {
    std::vector<std::uint32_t>& all = blockers.emplace_back(source.lines.blockers().size());
    std::iota(all.begin(), all.end(), 0u);
  }
  std::vector<std::size_t> edges(rim_.size()), curves;
  std::iota(edges.begin(), edges.end(), std::size_t{0});
  const std::vector<std::size_t> lines = lines_of(edges);
  for (std::size_t k = 0; k < curves_.size(); ++k)
    if (!std::binary_search(lines.begin(), lines.end(), k)) curves.push_back(k);
  divide({0, 1, 0, 1}, blockers, curves, edges, 0);
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) join_leaf(leaf);
  join_sides(upright_sides_, true);
  join_sides(level_sides_, false);
  collect_cells(result);
  collect_borders(result);
}

// ---- The grid

void Partition_builder::divide(const Chart_box& box, const Blockers& given,
                               const std::vector<std::size_t>& given_curves,
                               const std::vector<std::size_t>& given_edges, int depth) {
  constexpr std::size_t few = 4;
  constexpr int deepest = 16;
  ++counters_->boxes;
  const std::array<std::array<double, 2>, 4> at{
      {{box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}}};
  const double share = (box.x1 - box.x0) * (box.y1 - box.y0);
  const auto leave = [&] {
    done_ += share;
    if (options_->progress) options_->progress(done_);
  };

  // 1. Edges of the piece that cross it.
  std::vector<std::size_t> edges;
  for (const std::size_t edge : given_edges) {
    bool in = false, out = false;
    for (const auto& [x, y] : at) {
      const int sign = rim_[edge].inwards.sign(exact(x), exact(y));
      in |= sign > 0;
      out |= sign < 0;
    }
    if (!in) return leave();
    if (out) edges.push_back(edge);
  }
  const std::vector<std::size_t> rim = lines_of(edges);
  if (is_over()) {
    arrange(box, edges, rim, given, Light::undecided);
    return leave();
  }

  // 2. What is seen alike from all of it.
  std::array<Filtered, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const Near_point p = near_point(occluders_->frame(), chart_.point(exact(at[k][0]), exact(at[k][1])));
    corners[k] = {p.exact, near(p)};
  }
  Blockers blockers = given;
  const std::optional<Light> known = alike(corners, blockers);
  bool some_seen = false, some_hidden = false;
  if (!known && !options_->all_borders) probe(corners, blockers, some_seen, some_hidden);
  const bool is_penumbra = some_seen && some_hidden;
  if (known || is_penumbra) {
    ++counters_->alike;
    arrange(box, edges, rim, blockers, known ? *known : Light::penumbra);
    return leave();
  }

  // 3. Curves through it.
  std::vector<std::size_t> curves;
  for (const std::size_t k : given_curves) {
    const Border_curve& curve = curves_[k];
    if (some_seen && !curve.may_end_light) continue;
    const bool near = std::any_of(curve.where.begin(), curve.where.end(), [&](const Plane_chart::Bounds& b) {
      return b.x0 <= box.x1 && b.x1 >= box.x0 && b.y0 <= box.y1 && b.y1 >= box.y0;
    });
    if (near && may_meet(curve.curve, box)) curves.push_back(k);
  }
  // The lines of many edges cross in too many places, unless they are alone.
  const bool are_many = curves.size() > few || (!curves.empty() && edges.size() > many_edges);
  if (are_many && depth < deepest) {
    Chart_box first = box, second = box;
    const bool upright = box.x1 - box.x0 >= box.y1 - box.y0;
    const double low = upright ? box.x0 : box.y0, high = upright ? box.x1 : box.y1;
    // No curve runs along where it is cut.
    double at_cut = low + (high - low) / 2;
    const auto runs_along = [&](std::size_t k) {
      const std::array<Integer, 6>& c = curves_[k].curve.c;
      const Integer &slope = c[upright ? 1 : 2], &other = c[upright ? 2 : 1];
      return curves_[k].curve.is_line() && sgn(other) == 0 && slope * exact(at_cut) + c[0] == 0;
    };
    while (std::any_of(given_curves.begin(), given_curves.end(), runs_along) ||
           std::any_of(rim.begin(), rim.end(), runs_along))
      at_cut = low + (at_cut - low) * 0.75;
    (upright ? first.x1 : first.y1) = at_cut;
    (upright ? second.x0 : second.y0) = at_cut;
    divide(first, blockers, curves, edges, depth + 1);
    divide(second, blockers, curves, edges, depth + 1);
    return;
  }
  curves.insert(curves.end(), rim.begin(), rim.end());
  std::sort(curves.begin(), curves.end());
  ++counters_->arrangements;
  arrange(box, edges, curves, blockers, std::nullopt);
  leave();
}

std::optional<Light> Partition_builder::alike(const std::array<Filtered, 4>& corners, Blockers& blockers) const {
  std::size_t all = 0, none = never_seen_;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const Seen_source& source = sources_[s];
    bool in_front = true, behind = true;
    for (const Filtered& corner : corners) {
      const int at = sign_of_dot(source.plane, corner);
      in_front &= at >= 0;
      behind &= at <= 0;
    }
    if (behind) {
      ++none;
      blockers[s].clear();
      continue;
    }
    std::vector<Joined_line> extreme;
    for (const Filtered& p : corners)
      for (const Filtered& q : source.lines.target()) extreme.emplace_back(p, q);
    bool covered = false;
    std::vector<std::uint32_t> some;
    for (const std::uint32_t b : blockers[s]) {
      bool any = true, covers = true;
      for (const Event_lines::Literal& literal : source.lines.blockers()[b].literals) {
        bool holds = false, fails = false;
        for (const Joined_line& line : extreme) {
          const int at = literal.sense * side(line, source.lines.lines()[literal.line]);
          holds |= at > 0;
          fails |= at < 0;
          if (holds && fails) break;
        }
        any &= holds;
        covers &= !fails;
        if (!any) break;
      }
      if (any) some.push_back(b);
      covered |= any && covers;
      if (covered) break;
    }
    if (covered) {
      ++none;
      continue;
    }
    blockers[s] = std::move(some);
    if (blockers[s].empty() && in_front) ++all;
  }
  const std::size_t count = sources_.size() + never_seen_;
  if (none == count) return Light::umbra;
  if (options_->all_borders ? all == count : all + none == count)
    return all == count && std::all_of(sources_.begin(), sources_.end(), [](const auto& s) { return s.whole; })
               ? Light::lit
               : Light::penumbra;
  return std::nullopt;
}

void Partition_builder::probe(const std::array<Filtered, 4>& corners, const Blockers& blockers, bool& some_seen,
                              bool& some_hidden) const {
  some_hidden = never_seen_ > 0;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const Event_lines& lines = sources_[s].lines;
    some_hidden |= !sources_[s].whole;
    const bool in_front = std::all_of(corners.begin(), corners.end(), [&](const Filtered& corner) {
      return certain_dot(sources_[s].plane.near, corner.near) > 0;
    });
    for (const Filtered& q : probes_[s]) {
      if (some_seen && some_hidden) return;
      std::array<Near<6>, 4> from;
      for (std::size_t k = 0; k < 4; ++k) from[k] = join(corners[k].near, q.near);
      bool seen = in_front;
      for (const std::uint32_t b : blockers[s]) {
        bool past = false, hidden = true;
        for (const Event_lines::Literal& literal : lines.blockers()[b].literals) {
          const int common = literal.sense * certain_side(from, lines.lines()[literal.line].near);
          past |= common < 0;
          hidden &= common > 0;
          if (past) break;
        }
        seen &= past;
        some_hidden |= hidden && !past;
      }
      some_seen |= seen;
    }
  }
}

void Partition_builder::arrange(const Chart_box& box, const std::vector<std::size_t>& edges,
                                const std::vector<std::size_t>& curves, const Blockers& blockers,
                                std::optional<Light> known) {
  std::vector<Plane_curve> own;
  for (const std::size_t k : curves) own.push_back(curves_[k].curve);
  const bool is_open = known == Light::undecided;
  const bool is_outline = edges.size() > many_edges && curves.size() == edges.size();  // their lines, and no others
  Curve_arrangement arrangement = is_outline
                                      ? outline(box, edges, curves, own)
                                      : Curve_arrangement(
                                            own, box, is_open ? std::function<bool()>() : [this] { return is_over(); });
  if (arrangement.ended()) return arrange(box, edges, lines_of(edges), blockers, Light::undecided);
  Leaf& leaf = leaves_.emplace_back(Leaf{std::move(arrangement), curves, {}, box});
  // Of an outline those of a slab tell whether a sector is inside, where there are any.
  std::map<std::size_t, std::size_t> edge_of;
  if (is_outline)
    for (const std::size_t edge : edges) edge_of[rim_[edge].curve] = edge;
  for (const Curve_arrangement::Slab& slab : leaf.arrangement.slabs()) {
    leaf.first.push_back(sectors_.size());
    std::vector<std::size_t> telling;
    if (is_outline)
      for (const Curve_arrangement::Arc& arc : slab.arcs) telling.push_back(edge_of[curves[arc.curve]]);
    for (const Rational& y : slab.y) {
      Sector sector{true, Light::undecided, 0, slab.x, y, 0};
      sector.inside = is_inside(telling.empty() ? edges : telling, sector.x, sector.y);
      if (sector.inside && known && (!options_->all_borders || is_open)) sector.light = *known;
      else if (sector.inside && !is_over()) {
        leave_planes(sector, own, box, blockers);
        classify(sector, blockers);
      }
      sectors_.push_back(std::move(sector));
    }
  }
}

std::vector<std::size_t> Partition_builder::lines_of(const std::vector<std::size_t>& edges) const {
  std::vector<std::size_t> lines;
  for (const std::size_t edge : edges) lines.push_back(rim_[edge].curve);
  std::sort(lines.begin(), lines.end());
  return lines;
}

Curve_arrangement Partition_builder::outline(const Chart_box& box, const std::vector<std::size_t>& edges,
                                             const std::vector<std::size_t>& curves,
                                             const std::vector<Plane_curve>& own) const {
  const std::array<std::array<Rational, 2>, 2> low_high{
      {{exact(box.x0), exact(box.y0)}, {exact(box.x1), exact(box.y1)}}};
  std::vector<Stretch> stretches;
  std::vector<Rational> uprights;
  for (const std::size_t edge : edges) {
    // The part of it in the box: from + t (to - from).
    const auto& [p, q] = rim_[edge].ends;
    Rational from = 0, to = 1;
    for (std::size_t k = 0; k < 2; ++k) {
      const Rational step = q[k] - p[k];
      if (sgn(step) == 0) {
        if (p[k] <= low_high[0][k] || p[k] >= low_high[1][k]) to = 0;
        continue;
      }
      const Rational at_low = (low_high[0][k] - p[k]) / step, at_high = (low_high[1][k] - p[k]) / step;
      from = std::max(from, std::min(at_low, at_high));
      to = std::min(to, std::max(at_low, at_high));
    }
    if (from >= to) continue;
    const Rational a = p[0] + from * (q[0] - p[0]), b = p[0] + to * (q[0] - p[0]);
    const auto curve =
        static_cast<std::uint32_t>(std::lower_bound(curves.begin(), curves.end(), rim_[edge].curve) - curves.begin());
    if (a == b) uprights.push_back(a);
    else stretches.push_back({curve, std::min(a, b), std::max(a, b)});
  }
  return {own, box, stretches, uprights};
}

bool Partition_builder::is_inside(const std::vector<std::size_t>& edges, const Rational& x, const Rational& y) const {
  return std::all_of(edges.begin(), edges.end(), [&](std::size_t edge) { return rim_[edge].inwards.sign(x, y) > 0; });
}

bool Partition_builder::is_in_a_plane(const Homogeneous& point, const Blockers& blockers) const {
  for (std::size_t s = 0; s < sources_.size(); ++s)
    for (const std::uint32_t b : blockers[s])
      if (sgn(dot(occluders_->plane(sources_[s].lines.blockers()[b].piece).exact, point)) == 0) return true;
  return false;
}

void Partition_builder::leave_planes(Sector& sector, const std::vector<Plane_curve>& curves, const Chart_box& box,
                                     const Blockers& blockers) const {
  if (!is_in_a_plane(chart_.point(sector.x, sector.y), blockers)) return;
  const auto value = [](const Plane_curve& f, const Rational& x, const Rational& y) {
    return Rational(f.c[0] + f.c[1] * x + f.c[2] * y + f.c[3] * x * x + f.c[4] * x * y + f.c[5] * y * y);
  };
  for (unsigned long n = 1;; ++n) {
    // Ever nearer, in ever other directions, until the way there meets no curve.
    const Rational step(Integer(1), Integer(1) << (10 + n)),
        x = sector.x + step, y = sector.y + step * Rational(static_cast<long>(n % 7), 3);
    const bool is_near = std::all_of(curves.begin(), curves.end(), [&](const Plane_curve& f) {
      const Rational from = value(f, sector.x, sector.y), to = value(f, x, y),
                     middle = 2 * value(f, (sector.x + x) / 2, (sector.y + y) / 2) - (from + to) / 2;
      return sgn(from) == sgn(to) && sgn(from) == sgn(middle);
    });
    if (!is_near || x >= exact(box.x1) || y >= exact(box.y1) || is_in_a_plane(chart_.point(x, y), blockers)) continue;
    sector.x = x;
    sector.y = y;
    return;
  }
}

void Partition_builder::classify(Sector& sector, const Blockers& blockers) {
  ++counters_->sectors;
  const Homogeneous point = chart_.point(sector.x, sector.y);
  std::size_t all = 0, none = never_seen_;
  std::vector<std::vector<std::uint32_t>> outline(sources_.size());
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const Seen_source& source = sources_[s];
    if (sgn(dot(source.plane.exact, point)) <= 0) {
      ++none;
      continue;
    }
    const Seen_part part(source.lines, point, blockers[s]);
    none += part.seen() == Seen_share::none;
    all += part.seen() == Seen_share::all && source.whole;
    if (options_->all_borders) outline[s] = part.outline();
  }
  const std::size_t count = sources_.size() + never_seen_;
  sector.light = all == count ? Light::lit : none == count ? Light::umbra : Light::penumbra;
  if (options_->all_borders) sector.outline = outlines_.try_emplace(std::move(outline), outlines_.size()).first->second;
}

}  // namespace sightline::partition_detail
