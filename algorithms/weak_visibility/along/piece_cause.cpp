#include <sightline/algorithms/weak_visibility/along/piece_cause.h>

#include <algorithm>
#include <utility>

namespace sightline {

namespace {

/// Of linear ones.
Quadratic product(const Quadratic& f, const Quadratic& g) {
  return {{f.c[0] * g.c[0], f.c[0] * g.c[1] + f.c[1] * g.c[0], f.c[1] * g.c[1]}};
}

/// a f + b g
Quadratic mixed(const Integer& a, const Quadratic& f, const Integer& b, const Quadratic& g) {
  Quadratic sum;
  for (std::size_t k = 0; k < 3; ++k) sum.c[k] = a * f.c[k] + b * g.c[k];
  return sum;
}

using Edges = std::vector<std::array<std::uint32_t, 2>>;

/// Whether the eye's ray at t through a line and another one goes to the target and meets an edge of the first before
/// it; appends the edge, but for lines of the target's plane, which have none. Degenerate: not where the eye sees both
/// as one.
bool meets(const Piece_view& view, const Quadratic_root& t, std::uint32_t number, std::uint32_t other, Edges& edges) {
  if (number >= view.scene().lines().size()) return true;
  const Moving_eye& eye = view.eye();
  const auto sides = [&](const Homogeneous& p, std::uint32_t of) { return sightline::side(eye, view.line(of), p); };
  for (const auto& edge : view.scene().edges(number)) {
    const std::vector<Near_point>& corners = view.scene().polygons()[edge[0]].corners;
    const Homogeneous &p = corners[edge[1]].exact, &q = corners[(edge[1] + 1) % corners.size()].exact;
    // 1. The ray is in the other line's plane: it meets the edge in x = b p + a q, a and b not negative.
    Quadratic a = sides(p, other), b = sides(q, other);
    const int at_p = t.sign_of(a), at_q = t.sign_of(b);
    if (at_p * at_q > 0 || (at_p == 0 && at_q == 0)) continue;
    for (Integer& c : a.c) c *= at_p;
    for (Integer& c : b.c) c *= at_q;
    // 2. Before the target's plane or in it, and towards it.
    const Quadratic height = mixed(dot(view.plane().exact, p), b, dot(view.plane().exact, q), a),
                    weight = mixed(p[3], b, q[3], a),
                    nearer = mixed(1, product(view.target().eye_side, weight), -eye.ends()[0][3], height);
    if (view.side() * t.sign_of(height) < 0 || view.side() * t.sign_of(nearer) <= 0) continue;
    // 3. Within the target.
    const bool is_within = std::all_of(view.whole().begin(), view.whole().end(), [&](const Line_side& side) {
      const Quadratic f = mixed(1, product(sides(p, side.line), b), 1, product(sides(q, side.line), a));
      return side.sign * t.sign_of(f) >= 0;
    });
    if (!is_within) continue;
    edges.push_back(edge);
    return true;
  }
  return false;
}

/// Edges of three lines that are concurrent at t, not all along, and met by one ray; none where there are none.
std::optional<Along_cause> met_together(const Piece_view& view, const Quadratic_root& t,
                                        const std::array<std::uint32_t, 3>& lines) {
  const Quadratic f = determinant(view.line(lines[0]), view.line(lines[1]), view.line(lines[2]));
  if (f.is_zero() || t.sign_of(f) != 0) return std::nullopt;
  Along_cause cause{Along_kind::triple, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t own = lines[i], next = lines[(i + 1) % 3], last = lines[(i + 2) % 3];
    if (!meets(view, t, own, next, cause.edges) && !meets(view, t, own, last, cause.edges)) return std::nullopt;
    if (sgn(sightline::side(view.line(own).line, view.line(next).line)) == 0) cause.kind = Along_kind::edge_vertex;
  }
  return cause;
}

}  // namespace

const char* name(Along_kind kind) {
  constexpr const char* names[] = {"horizon", "contact", "edge and vertex", "triple"};
  return names[static_cast<std::size_t>(kind)];
}

Along_cause cause_of(const Piece_view& view, const Quadratic_root& t,
                     std::span<const std::array<std::uint32_t, 3>> zero) {
  std::optional<Along_cause> best;
  const auto consider = [&](const std::array<std::uint32_t, 3>& lines) {
    std::optional<Along_cause> own = met_together(view, t, lines);
    if (own && (!best || own->kind < best->kind)) best = std::move(own);
  };
  // 1. What the run rests on, where edges are really met.
  for (const auto& lines : zero) consider(lines);
  if (best) return *best;
  // 2. Cuts go on beyond edges: others through the same point are met.
  const auto count = view.line_count();
  for (const auto& lines : zero)
    for (std::size_t i = 0; i < 3 && !best; ++i) {
      const std::uint32_t one = lines[i], other = lines[(i + 1) % 3];
      std::vector<std::uint32_t> through{one, other};
      Edges edges;
      for (std::uint32_t k = 0; k < count; ++k)
        if (k != one && k != other && t.sign_of(determinant(view.line(one), view.line(other), view.line(k))) == 0 &&
            (meets(view, t, k, one, edges) || meets(view, t, k, other, edges)))
          through.push_back(k);
      for (std::size_t a = 0; a < through.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
          for (std::size_t c = 0; c < b; ++c) consider({through[a], through[b], through[c]});
    }
  return best.value_or(Along_cause{Along_kind::triple, {}});
}

}  // namespace sightline
