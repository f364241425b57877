#include <sightline/algorithms/point_visibility/hidden_lines.h>

#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <span>
#include <utility>

namespace sightline {

std::vector<Scene_edge> scene_edges(const Scene& scene) {
  std::vector<std::array<std::uint32_t, 3>> sides;  // p, q, piece
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    const std::span<const Piece_corner> corners = scene.corners(scene.pieces()[i]);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [p, q] = std::minmax(corners[k].point, corners[k + 1 == corners.size() ? 0 : k + 1].point);
      sides.push_back({p, q, i});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<Scene_edge> edges;
  for (std::size_t k = 0; k < sides.size();) {
    Scene_edge edge{sides[k][0], sides[k][1], {}};
    for (; k < sides.size() && sides[k][0] == edge.p && sides[k][1] == edge.q; ++k) edge.pieces.push_back(sides[k][2]);
    const auto face = [&](std::uint32_t i) { return scene.pieces()[i].face; };
    if (edge.pieces.size() != 2 || face(edge.pieces[0]) != face(edge.pieces[1])) edges.push_back(std::move(edge));
  }
  return edges;
}

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
    : view_(view), surface_(surface), predicates_(view.scene().predicates()) {
  const std::vector<Piece>& pieces = view.scene().pieces();
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    if (view.eye_side(i) == CGAL::ZERO) edge_on_[pieces[i].support.id()].push_back(i);
}

std::vector<Line_part> Hidden_lines::parts(std::uint32_t p, std::uint32_t q) const {
  const Exact_view::Plane along = view_.edge(p, q);
  if (along.size == 0) return {};
  Walk walk{p, q, along, view_.direction(view_.ray(p)), view_.direction(view_.ray(q)), {}, {}, {}};
  for (std::size_t k = 0; k < surface_.cones.size(); ++k) clip(walk, k);
  hide_behind_edge_on(walk);
  return in_order(walk);
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
  Arc arc{view_.ray(walk.p), view_.ray(walk.q)};
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
  const Sign at_p = view_.beyond(piece, walk.p, walk.counts), at_q = view_.beyond(piece, walk.q, walk.counts);
  if (at_p != CGAL::POSITIVE && at_q != CGAL::POSITIVE) return;
  Line_part part{parameter(walk, arc.from), parameter(walk, arc.to), piece};
  if (at_p == CGAL::NEGATIVE || at_q == CGAL::NEGATIVE) {  // the edge pierces the plane
    const Rational height_p = height(piece, walk.p), at = height_p / (height_p - height(piece, walk.q));
    if (at_p == CGAL::POSITIVE) part.to = std::min(part.to, at);
    else part.from = std::max(part.from, at);
  }
  if (part.from < part.to) walk.hidden.push_back(std::move(part));
}

Rational Hidden_lines::height(std::uint32_t piece, std::uint32_t point) const {
  const std::array<Integer, 4> h = predicates_.coefficients(view_.scene().pieces()[piece].support);
  const Grid_points& points = view_.scene().points();
  return Rational(h[0] * points.integer(point, 0) + h[1] * points.integer(point, 1) + h[2] * points.integer(point, 2) +
                  h[3]);
}

Rational Hidden_lines::parameter(const Walk& walk, const Ray& r) const {
  if (r.point == walk.p) return 0;
  if (r.point == walk.q) return 1;
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
  return 0;  // not reached: the edge does not run towards the eye
}

void Hidden_lines::hide_behind_edge_on(Walk& walk) const {
  for (const auto& [plane, pieces] : edge_on_) {
    if (view_.side(pieces[0], walk.p, walk.counts) != CGAL::ZERO ||
        view_.side(pieces[0], walk.q, walk.counts) != CGAL::ZERO)
      continue;
    for (const std::uint32_t piece : pieces) hide_behind_edge_on(walk, piece);
  }
}

void Hidden_lines::hide_behind_edge_on(Walk& walk, std::uint32_t piece) const {
  using Flat = std::array<Rational, 2>;
  const std::array<Integer, 3>&p = walk.to_p, &q = walk.to_q;
  std::size_t k = 0;  // an axis along which the plane does not vanish
  while (p[(k + 1) % 3] * q[(k + 2) % 3] == p[(k + 2) % 3] * q[(k + 1) % 3]) ++k;
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const Integer whole = p[i] * q[j] - p[j] * q[i];
  std::vector<Flat> polygon;
  for (const Piece_corner& corner : view_.scene().corners(view_.scene().pieces()[piece])) {
    const std::array<Integer, 3> c = view_.direction(view_.ray(corner.point));
    Flat at{Rational(c[i] * q[j] - c[j] * q[i], whole), Rational(p[i] * c[j] - p[j] * c[i], whole)};
    at[0].canonicalize();
    at[1].canonicalize();
    polygon.push_back(at);
  }
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
  // What is left is convex: it spans the directions between those of its corners, and is in front of the edge unless
  // all of it is on the edge.
  Line_part part{1, 0, piece};
  bool in_front = false;
  for (const Flat& at : polygon) {
    const Rational sum = at[0] + at[1];
    if (sum == 0) continue;
    in_front = in_front || sum < 1;
    part.from = std::min(part.from, Rational(at[1] / sum));
    part.to = std::max(part.to, Rational(at[1] / sum));
  }
  const bool around_eye =
      std::any_of(polygon.begin(), polygon.end(), [](const Flat& at) { return at[0] == 0 && at[1] == 0; });
  if ((in_front || around_eye) && part.from < part.to) walk.hidden.push_back(std::move(part));
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

std::vector<Drawn_edge> hidden_lines(const Exact_view& view, const Visible_surface<Exact_view>& surface, int threads) {
  std::vector<Drawn_edge> drawn;
  for (Scene_edge& edge : scene_edges(view.scene())) {
    const Edge_class kind = classify(view, edge);
    drawn.push_back({std::move(edge), kind, {}});
  }
  const Hidden_lines lines(view, surface);
  run_with_threads(threads, [&] {
    parallel_for(drawn.size(), [&](std::size_t i) { drawn[i].parts = lines.parts(drawn[i].edge.p, drawn[i].edge.q); });
  });
  return drawn;
}

}  // namespace sightline
