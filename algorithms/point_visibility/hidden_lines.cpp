#include <sightline/algorithms/point_visibility/hidden_lines.h>

#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>

namespace sightline {

Edge_class classify(const Exact_view& view, const Scene_edge& edge) {
  if (edge.pieces.size() == 1) return Edge_class::boundary;
  const auto on_view = [&](std::uint32_t i) { return view.eye_side(i) == CGAL::POSITIVE; };
  const bool some = std::any_of(edge.pieces.begin(), edge.pieces.end(), on_view),
             all = std::all_of(edge.pieces.begin(), edge.pieces.end(), on_view);
  if (some && !all) return Edge_class::silhouette;
  return edge.pieces.size() == 2 && view.same_plane(edge.pieces[0], edge.pieces[1]) ? Edge_class::smooth
                                                                                    : Edge_class::crease;
}

Hidden_lines::Hidden_lines(const Exact_view& view, const Visible_surface<Exact_view>& surface)
    : view_(view), surface_(surface), predicates_(view.scene().predicates()), eye_(view.scene().locate(view.eye())) {
  const std::vector<Piece>& pieces = view.scene().pieces();
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    if (view.eye_side(i) != CGAL::ZERO) continue;
    Edge_on_plane& plane = edge_on_[pieces[i].support.id()];
    if (plane.pieces.empty()) {
      const std::array<Integer, 4> h = predicates_.coefficients(pieces[i].support);
      for (std::size_t k = 1; k < 3; ++k)
        if (abs(h[k]) > abs(h[plane.axis])) plane.axis = k;
    }
    std::vector<std::array<Integer, 3>> directions;
    for (const Piece_corner& corner : view.scene().corners(pieces[i]))
      directions.push_back(view.direction(view.ray(corner.point)));
    plane.pieces.push_back(i);
    plane.turns.push_back(turn_of(directions, plane.axis));
  }
  find_rims();
}

// Each angle is that of a vector whose numbers were rounded to 2^-52 of themselves, which turns it by less than that;
// atan2() adds 2^-51. What is left out is at least a million times as far away as both.
static constexpr double all_turns = 10, angle_error = 1e-9, pi = 3.14159265358979323846;

bool Hidden_lines::Turn::meets(const Turn& other) const {
  return std::fabs(std::remainder(middle - other.middle, 2 * pi)) <= half + other.half + angle_error;
}

Hidden_lines::Turn Hidden_lines::turn_of(const std::vector<std::array<Integer, 3>>& directions, std::size_t axis) {
  const auto angle = [&](const std::array<Integer, 3>& d) {
    std::array<long, 2> exponents{};
    const Integer &x = d[(axis + 1) % 3], &y = d[(axis + 2) % 3];
    const double to_x = mpz_get_d_2exp(&exponents[0], x.get_mpz_t()),
                 to_y = mpz_get_d_2exp(&exponents[1], y.get_mpz_t());
    const long apart = std::clamp(exponents[1] - exponents[0], -1000L, 1000L);
    return std::atan2(std::ldexp(to_y, static_cast<int>(std::max(apart, 0L))),
                      std::ldexp(to_x, static_cast<int>(std::max(-apart, 0L))));
  };
  const double first = angle(directions[0]);
  double least = 0, most = 0;
  for (const std::array<Integer, 3>& d : directions) {
    if (is_zero(d)) return {0, all_turns};  // the eye
    const double from_first = std::remainder(angle(d) - first, 2 * pi);
    least = std::min(least, from_first);
    most = std::max(most, from_first);
  }
  if (most - least > pi - angle_error) return {0, all_turns};  // the eye may be within
  return {first + (least + most) / 2, (most - least) / 2};
}

std::vector<Line_part> Hidden_lines::parts(std::uint32_t p, std::uint32_t q) const {
  const Exact_view::Plane along = view_.edge(p, q);
  if (along.size == 0) return {};
  const Arc arc{view_.ray(p), view_.ray(q)};
  Walk walk{along, arc, view_.direction(arc.from), view_.direction(arc.to), 1};
  return parts(walk);
}

std::vector<Line_part> Hidden_lines::parts(const Crossing& crossing) const {
  for (const std::uint32_t piece : crossing.pieces)
    if (view_.eye_side(piece) == CGAL::ZERO) return {};
  Exact_view::Plane along = view_.crossing(crossing.pieces[0], crossing.pieces[1]);
  Predicate_counts counts;
  // A third face in the plane of eye and line may end the crossing by an edge in that plane.
  std::array<Crossing_end, 2> ends = crossing.ends;
  bool is_longer = false;
  for (std::size_t e = 0; e < 2; ++e)
    if (!has_ray(ends[e], along, counts)) {
      ends[e] = crossing.beyond[e];
      is_longer = true;
    }
  const auto& [p, q] = ends;
  std::array<Integer, 3> to_p = direction(p), to_q = direction(q);
  // The plane turns from p to q.
  const std::array<Integer, 3> normal = cross(to_p, to_q);
  if (sgn(dot(normal, view_.normal(along))) < 0) along = view_.opposite(along);
  const Arc arc{towards(p, along, to_p, counts), towards(q, along, to_q, counts)};
  for (Integer& x : to_p) x *= q.at[3];
  for (Integer& x : to_q) x *= p.at[3];
  Walk walk{along, arc, to_p, to_q, p.at[3] * q.at[3]};
  std::vector<Line_part> found = parts(walk);
  return is_longer ? between(found, ends, crossing.ends) : found;
}

std::vector<Line_part> Hidden_lines::parts(Walk& walk) const {
  for (std::size_t k = 0; k < surface_.cones.size(); ++k) clip(walk, k);
  hide_along_rims(walk);
  hide_behind_edge_on(walk);
  return in_order(walk);
}

std::array<Integer, 3> Hidden_lines::direction(const Crossing_end& end) const {
  return {Integer(eye_.w * end.at[0] - eye_.x * end.at[3]), Integer(eye_.w * end.at[1] - eye_.y * end.at[3]),
          Integer(eye_.w * end.at[2] - eye_.z * end.at[3])};
}

bool Hidden_lines::has_ray(const Crossing_end& end, const Exact_view::Plane& w, Predicate_counts& counts) const {
  return end.p == end.q || view_.side(w, end.p, counts) != CGAL::ZERO || view_.side(w, end.q, counts) != CGAL::ZERO;
}

std::vector<Line_part> Hidden_lines::between(const std::vector<Line_part>& parts,
                                             const std::array<Crossing_end, 2>& longer,
                                             const std::array<Crossing_end, 2>& ends) {
  const auto place = [](const Crossing_end& end, std::size_t axis) {
    Rational at(end.at[axis], end.at[3]);
    at.canonicalize();
    return at;
  };
  std::size_t axis = 0;
  while (place(ends[0], axis) == place(ends[1], axis)) ++axis;
  const Rational first = place(longer[0], axis), whole = place(longer[1], axis) - first,
                 from = (place(ends[0], axis) - first) / whole, length = (place(ends[1], axis) - first) / whole - from;
  std::vector<Line_part> found;
  for (const Line_part& part : parts) {
    const Rational low = std::max(Rational(0), Rational((part.from - from) / length)),
                   high = std::min(Rational(1), Rational((part.to - from) / length));
    if (low < high) found.push_back({low, high, part.hidden_by});
  }
  return found;
}

Hidden_lines::Ray Hidden_lines::towards(const Crossing_end& end, const Exact_view::Plane& w,
                                        const std::array<Integer, 3>& direction, Predicate_counts& counts) const {
  if (end.p == end.q) return view_.ray(end.p);
  const Ray r = view_.meet(w, view_.edge(end.p, end.q), counts);
  if (sgn(dot(view_.direction(r), direction)) > 0) return r;
  return view_.meet(view_.edge(end.p, end.q), w, counts);
}

std::array<std::optional<Hidden_lines::Arc>, 2> Hidden_lines::cut(Walk& walk, const Arc& arc,
                                                                  const Exact_view::Plane& w) const {
  const Sign from = view_.side(w, arc.from, walk.counts), to = view_.side(w, arc.to, walk.counts);
  if (from == CGAL::ZERO && to == CGAL::ZERO) return {arc, arc};
  if (from != CGAL::NEGATIVE && to != CGAL::NEGATIVE) return {arc, std::nullopt};
  if (from != CGAL::POSITIVE && to != CGAL::POSITIVE) return {std::nullopt, arc};
  // An arc turns around the normal of its plane, so it leaves the front of w along the product of the two normals.
  const Ray between =
      from == CGAL::POSITIVE ? view_.meet(walk.plane, w, walk.counts) : view_.meet(w, walk.plane, walk.counts);
  if (from == CGAL::POSITIVE) return {Arc{arc.from, between}, Arc{between, arc.to}};
  return {Arc{between, arc.to}, Arc{arc.from, between}};
}

void Hidden_lines::clip(Walk& walk, std::size_t cone) const {
  Arc arc = walk.arc;
  for (const Exact_view::Plane& side : surface_.cones[cone].sides) {
    const auto parts = cut(walk, arc, side);
    if (!parts[0]) return;
    arc = *parts[0];
  }
  walk.within.push_back({parameter(walk, arc.from), parameter(walk, arc.to), nothing});
  descend(walk, surface_.roots[cone], arc);
}

void Hidden_lines::descend(Walk& walk, std::int32_t root, const Arc& whole) const {
  std::vector<std::pair<std::int32_t, Arc>> left{{root, whole}};
  while (!left.empty()) {
    const auto [at, arc] = left.back();
    left.pop_back();
    if (at >= 0) {
      const auto& node = surface_.nodes[static_cast<std::size_t>(at)];
      const auto halves = cut(walk, arc, node.plane);
      if (halves[1]) left.emplace_back(node.behind, *halves[1]);
      if (halves[0]) left.emplace_back(node.front, *halves[0]);
    } else if (const std::uint32_t piece = surface_.parts[static_cast<std::size_t>(~at)].piece; piece != nothing) {
      hide(walk, arc, piece);
    }
  }
}

void Hidden_lines::hide(Walk& walk, const Arc& arc, std::uint32_t piece) const {
  const Sign at_p = beyond(walk, piece, walk.arc.from, walk.to_p), at_q = beyond(walk, piece, walk.arc.to, walk.to_q);
  if (at_p != CGAL::POSITIVE && at_q != CGAL::POSITIVE) return;
  Line_part part{parameter(walk, arc.from), parameter(walk, arc.to), piece};
  if (at_p == CGAL::NEGATIVE || at_q == CGAL::NEGATIVE) {  // the line pierces the plane
    const Integer height_p = height(walk, piece, walk.to_p);
    Rational at(height_p, height_p - height(walk, piece, walk.to_q));
    at.canonicalize();
    if (at_p == CGAL::POSITIVE) part.to = std::min(part.to, at);
    else part.from = std::max(part.from, at);
  }
  if (part.from < part.to) walk.hidden.push_back(std::move(part));
}

Sign Hidden_lines::beyond(Walk& walk, std::uint32_t piece, const Ray& end, const std::array<Integer, 3>& to_end) const {
  if (end.point != Exact_view::no_point) return view_.beyond(piece, end.point, walk.counts);
  ++walk.counts.gmp;
  return static_cast<Sign>(-sgn(height(walk, piece, to_end)) * view_.eye_side(piece));
}

bool Hidden_lines::is_on(Walk& walk, std::uint32_t piece, const Ray& end, const std::array<Integer, 3>& to_end) const {
  if (end.point != Exact_view::no_point) return view_.side(piece, end.point, walk.counts) == CGAL::ZERO;
  return height(walk, piece, to_end) == 0;
}

Integer Hidden_lines::height(const Walk& walk, std::uint32_t piece, const std::array<Integer, 3>& to_end) const {
  const std::array<Integer, 4> h = predicates_.coefficients(view_.scene().pieces()[piece].support);
  const Integer at_eye = h[0] * eye_.x + h[1] * eye_.y + h[2] * eye_.z + h[3] * eye_.w;
  return Integer(h[0] * to_end[0] + h[1] * to_end[1] + h[2] * to_end[2] + at_eye * walk.scale);
}

Rational Hidden_lines::parameter(const Walk& walk, const Ray& r) const {
  if (r.point != Exact_view::no_point && r.point == walk.arc.from.point) return 0;
  if (r.point != Exact_view::no_point && r.point == walk.arc.to.point) return 1;
  const std::array<Integer, 3> d = view_.direction(r);
  const std::array<Integer, 3>&p = walk.to_p, &q = walk.to_q;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Integer at_p = p[i] * d[j] - p[j] * d[i], at_q = q[i] * d[j] - q[j] * d[i];
    if (at_p == at_q) continue;
    Rational s(at_p, at_p - at_q);
    s.canonicalize();
    return s;
  }
  return 0;  // not reached: the line does not run towards the eye
}

bool Hidden_lines::is_rim(std::size_t cone, std::size_t side) const {
  const auto ray = [](const auto& of, std::size_t k) -> const Ray& { return of.rays[k % of.rays.size()]; };
  const auto same = [](const Ray& a, const Ray& b) {
    return a.p == b.p && a.q == b.q && a.point == b.point && a.flipped == b.flipped;
  };
  const auto& own = surface_.cones[cone];
  for (std::size_t c = 0; c < surface_.cones.size(); ++c)
    for (std::size_t k = 0; c != cone && k < surface_.cones[c].rays.size(); ++k)
      if (same(ray(surface_.cones[c], k), ray(own, side + 1)) && same(ray(surface_.cones[c], k + 1), ray(own, side)))
        return false;
  return true;
}

void Hidden_lines::find_rims() {
  const Scene& scene = view_.scene();
  Predicate_counts counts;
  for (std::size_t c = 0; c < surface_.cones.size(); ++c)
    for (std::size_t k = 0; k < surface_.cones[c].sides.size(); ++k) {
      if (!is_rim(c, k)) continue;
      Rim& rim = rims_.emplace_back(Rim{surface_.cones[c].sides[k], {}});
      for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
        bool in_front = true, behind = true;
        for (const Piece_corner& corner : scene.corners(scene.pieces()[i])) {
          const Sign s = view_.side(rim.plane, corner.point, counts);
          in_front = in_front && s == CGAL::POSITIVE;
          behind = behind && s == CGAL::NEGATIVE;
          if (!in_front && !behind) break;
        }
        if (!in_front && !behind) rim.pieces.push_back(i);
      }
    }
}

void Hidden_lines::hide_along_rims(Walk& walk) const {
  if (walk.within.empty()) return;
  for (const Rim& rim : rims_)
    if (view_.side(rim.plane, walk.arc.from, walk.counts) == CGAL::ZERO &&
        view_.side(rim.plane, walk.arc.to, walk.counts) == CGAL::ZERO)
      for (const std::uint32_t piece : rim.pieces) hide_behind(walk, piece);
}

void Hidden_lines::hide_behind_edge_on(Walk& walk) const {
  if (walk.within.empty()) return;
  for (const auto& [id, plane] : edge_on_) {
    const std::uint32_t first = plane.pieces[0];
    if (!is_on(walk, first, walk.arc.from, walk.to_p) || !is_on(walk, first, walk.arc.to, walk.to_q)) continue;
    const Turn turn = turn_of({walk.to_p, walk.to_q}, plane.axis);
    for (std::size_t k = 0; k < plane.pieces.size(); ++k)
      if (plane.turns[k].meets(turn)) hide_behind(walk, plane.pieces[k]);
  }
}

std::vector<Hidden_lines::Flat> Hidden_lines::section(const Walk& walk, std::uint32_t piece) const {
  const std::array<Integer, 3>&p = walk.to_p, &q = walk.to_q, normal = cross(p, q);
  const std::size_t k = normal[0] != 0 ? 0 : normal[1] != 0 ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
  std::vector<Integer> heights;
  std::vector<Flat> flats;  // along the k-axis, where a corner is not in the plane
  for (const Piece_corner& corner : view_.scene().corners(view_.scene().pieces()[piece])) {
    std::array<Integer, 3> c = view_.direction(view_.ray(corner.point));
    for (Integer& x : c) x *= walk.scale;
    heights.push_back(dot(normal, c));
    Flat& at = flats.emplace_back(
        Flat{Rational(c[i] * q[j] - c[j] * q[i], normal[k]), Rational(p[i] * c[j] - p[j] * c[i], normal[k])});
    at[0].canonicalize();
    at[1].canonicalize();
  }
  std::vector<Flat> common;
  for (std::size_t n = 0; n < flats.size(); ++n) {
    const std::size_t next = n + 1 == flats.size() ? 0 : n + 1;
    if (heights[n] == 0) common.push_back(flats[n]);
    if (sgn(heights[n]) * sgn(heights[next]) >= 0) continue;
    Rational t(heights[n], heights[n] - heights[next]);
    t.canonicalize();
    common.push_back({Rational(flats[n][0] + t * (flats[next][0] - flats[n][0])),
                      Rational(flats[n][1] + t * (flats[next][1] - flats[n][1]))});
  }
  return common;
}

void Hidden_lines::hide_behind(Walk& walk, std::uint32_t piece) const {
  std::vector<Flat> polygon = section(walk, piece);
  // Clipped to x >= 0, y >= 0, x + y <= 1.
  for (int side = 0; side < 3; ++side) {
    const auto value = [&](const Flat& at) -> Rational {
      return side == 2 ? Rational(1 - at[0] - at[1]) : at[static_cast<std::size_t>(side)];
    };
    std::vector<Flat> kept;
    for (std::size_t n = 0; n < polygon.size(); ++n) {
      const Flat &a = polygon[n], &b = polygon[n + 1 == polygon.size() ? 0 : n + 1];
      const Rational at_a = value(a), at_b = value(b);
      if (at_a >= 0) kept.push_back(a);
      if (sgn(at_a) * sgn(at_b) < 0) {
        const Rational t = at_a / (at_a - at_b);
        kept.push_back({Rational(a[0] + t * (b[0] - a[0])), Rational(a[1] + t * (b[1] - a[1]))});
      }
    }
    polygon = std::move(kept);
  }
  // What is left is convex: it spans the directions between those of its corners, and is in front of the line unless
  // all of it is on the line.
  Line_part part{1, 0, piece};
  bool in_front = false;
  for (const Flat& at : polygon) {
    const Rational sum = at[0] + at[1];
    in_front = in_front || sum < 1;
    if (sum == 0) continue;  // the eye
    part.from = std::min(part.from, Rational(at[1] / sum));
    part.to = std::max(part.to, Rational(at[1] / sum));
  }
  if (in_front && part.from < part.to) walk.hidden.push_back(std::move(part));
}

std::vector<Line_part> Hidden_lines::in_order(Walk& walk) {
  const auto by_place = [](const Line_part& a, const Line_part& b) {
    return a.from != b.from ? a.from < b.from : a.to != b.to ? b.to < a.to : a.hidden_by < b.hidden_by;
  };
  std::sort(walk.within.begin(), walk.within.end(), by_place);
  std::sort(walk.hidden.begin(), walk.hidden.end(), by_place);
  std::vector<Line_part> parts;
  const auto add = [&](const Rational& from, const Rational& to, std::uint32_t by) {
    if (!(from < to)) return;
    if (!parts.empty() && parts.back().to == from && parts.back().hidden_by == by) parts.back().to = to;
    else parts.push_back({from, to, by});
  };
  Rational at = 0;  // all before is done
  for (const Line_part& range : walk.within) {
    at = std::max(at, range.from);
    for (const Line_part& hidden : walk.hidden) {
      if (hidden.to <= at || hidden.from >= range.to) continue;
      add(at, hidden.from, nothing);
      at = std::max(at, hidden.from);
      const Rational end = std::min(hidden.to, range.to);
      add(at, end, hidden.hidden_by);
      at = std::max(at, end);
    }
    add(at, range.to, nothing);
    at = std::max(at, range.to);
  }
  return parts;
}

/// Of `work` for each of so many lines.
static void for_each_line(std::size_t count, int threads, const Line_progress& progress,
                          const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> done{0};
  run_with_threads(threads, [&] {
    parallel_for(count, [&](std::size_t i) {
      if (progress) progress(done, count);
      work(i);
      ++done;
    });
  });
}

std::vector<Drawn_edge> hidden_lines(const Exact_view& view, const Visible_surface<Exact_view>& surface, int threads,
                                     const Line_progress& progress) {
  std::vector<Drawn_edge> drawn;
  for (Scene_edge& edge : scene_edges(view.scene())) {
    const Edge_class kind = classify(view, edge);
    drawn.push_back({std::move(edge), kind, {}});
  }
  const Hidden_lines lines(view, surface);
  for_each_line(drawn.size(), threads, progress,
                [&](std::size_t i) { drawn[i].parts = lines.parts(drawn[i].edge.p, drawn[i].edge.q); });
  return drawn;
}

std::vector<Drawn_crossing> visible_crossings(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                              const Piece_boxes& boxes, int threads, const Line_progress& progress) {
  std::vector<bool> seen(view.scene().pieces().size(), false);  // all that is visible of crossings is on these. P-65
  for (const auto& part : surface.parts)
    if (part.piece != surface.nothing) seen[part.piece] = true;
  const std::vector<Crossing> all = crossings_on(seen, view.scene(), boxes, [&] {
    if (progress) progress(0, 1);
  });
  std::vector<std::vector<Line_part>> parts(all.size());
  const Hidden_lines lines(view, surface);
  for_each_line(all.size(), threads, progress, [&](std::size_t i) { parts[i] = lines.parts(all[i]); });
  std::vector<Drawn_crossing> drawn;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Exact_point p = view.scene().position(all[i].ends[0].at), q = view.scene().position(all[i].ends[1].at);
    const auto point = [&](const Rational& s) {
      return Exact_point{Rational(p[0] + s * (q[0] - p[0])), Rational(p[1] + s * (q[1] - p[1])),
                         Rational(p[2] + s * (q[2] - p[2]))};
    };
    for (const Line_part& part : parts[i])
      if (part.hidden_by == Line_part::nothing) drawn.push_back({all[i].faces, {point(part.from), point(part.to)}});
  }
  return drawn;
}

}  // namespace sightline
