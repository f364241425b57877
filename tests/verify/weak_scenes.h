#pragma once
// Hand-made scenes with hand-written certificates of weak visibility, and a judge of them that shares nothing with the
// checker: it shoots at pairs of points.

#include "../sample.h"
#include "scenes.h"

#include <sightline/algorithms/verify/weak.h>

namespace weak_test {

using namespace verify_test;
using Form = Weak_certificate::Form;
using Node = Weak_certificate::Node;
using Kind = Node::Kind;
using Term = Weak_certificate::Term;
using Proof = std::vector<Node>;

inline const unsigned share = test_scenes::is_sanitized() ? 60
                              : test_scenes::is_long()
                                  ? 1
                                  : 3;  // one case in so many: under sanitizers each costs a hundred times as much

inline Form form(const Rational& a, const Rational& b, const Rational& c, const Rational& d) { return {a, b, c, d}; }
inline Node node(Kind kind, std::size_t index = 0) {
  Node result;
  result.kind = kind;
  result.index = index;
  return result;
}
inline Node side_of(std::size_t line) { return node(Kind::line, line); }
inline Node blocked(std::size_t fragment) { return node(Kind::blocked, fragment); }
inline Node away() { return node(Kind::away); }
inline Node cut_source(const Form& plane) {
  Node result = node(Kind::cut_source);
  result.plane = plane;
  return result;
}
inline Node cut_target(const Form& plane) {
  Node result = node(Kind::cut_target);
  result.plane = plane;
  return result;
}
inline Node empty(const std::vector<Term>& terms = {}) {
  Node result = node(Kind::empty);
  result.terms = terms;
  return result;
}
inline Term term(std::size_t line, const Rational& factor, const std::optional<Form>& source = {},
                 const std::optional<Form>& target = {}) {
  return {line, factor, source, target};
}

struct Weak_scene {
  Polygon_soup soup;
  Weak_certificate certificate;

  /// A convex face, which is its own fragment. Returns its place.
  std::size_t face(const Points& polygon) {
    std::vector<Point_id> ids;
    for (const Exact_point& p : polygon) ids.push_back(soup.add_point(p[0], p[1], p[2]));
    certificate.fragments.push_back({soup.add_face(ids), 0, polygon});
    return certificate.fragments.size() - 1;
  }
  std::size_t line(std::size_t fragment, std::size_t corner) {
    certificate.lines.push_back({fragment, corner});
    return certificate.lines.size() - 1;
  }
  Weak_scene& from(const Points& source) {
    certificate.sources.push_back(source);
    return *this;
  }
  Weak_scene& see(std::size_t fragment, const Exact_point& start, const Exact_point& end, std::size_t source = 0) {
    certificate.visible.push_back({fragment, source, start, end});
    return *this;
  }
  Weak_scene& hide(std::size_t fragment, const Proof& proof, std::size_t source = 0) {
    certificate.hidden.push_back({fragment, source, proof});
    return *this;
  }
  Verdict verdict() const { return verify_weak(soup, certificate); }
};

inline void expect_accepted(const Weak_scene& scene, const std::string& words = "") {
  const Verdict verdict = scene.verdict();
  EXPECT_TRUE(verdict.accepted) << verdict.why;
  EXPECT_TRUE(verdict.fragments.empty());
  EXPECT_NE(verdict.why.find(words), std::string::npos) << verdict.why;
  EXPECT_EQ(verdict.why.find('\n'), std::string::npos);
}
inline void expect_rejected(const Weak_scene& scene, const std::string& words) {
  const Verdict verdict = scene.verdict();
  EXPECT_FALSE(verdict.accepted) << verdict.why << " but expected: " << words;
  EXPECT_NE(verdict.why.find(words), std::string::npos) << verdict.why << " but expected: " << words;
  EXPECT_EQ(verdict.why.find('\n'), std::string::npos);
  for (const std::size_t f : verdict.fragments) EXPECT_LT(f, scene.certificate.fragments.size());
}

/// Numbers that are not in canonical form.
inline Rational doubled() {
  Rational r;
  mpz_set_si(mpq_numref(r.get_mpq_t()), 2);
  mpz_set_si(mpq_denref(r.get_mpq_t()), 2);
  return r;
}
inline Rational infinite() {
  Rational r;
  mpz_set_si(mpq_numref(r.get_mpq_t()), 1);
  mpz_set_si(mpq_denref(r.get_mpq_t()), 0);
  return r;
}

// ---- Scenes. Sources look up from z = 0, targets look down from above; blockers look up, so that they are not seen
// themselves ----------------

inline Points up(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1, const Rational& z) {
  return rectangle(x0, x1, y0, y1, z);
}
inline Points down(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1, const Rational& z) {
  return reversed(rectangle(x0, x1, y0, y1, z));
}
/// In the plane x = c, looking to -x.
inline Points facing_back(const Rational& c, const Rational& y0, const Rational& y1, const Rational& z0,
                          const Rational& z1) {
  return {at(c, y0, z0), at(c, y0, z1), at(c, y1, z1), at(c, y1, z0)};
}

/// Nothing but a source and a target.
inline Weak_scene nothing_between() {
  Weak_scene scene;
  scene.from(up(0, 1, 0, 1, 0)).face(down(0, 1, 0, 1, 3));
  return scene;
}

inline Weak_scene one_blocker() {
  Weak_scene scene = nothing_between();
  scene.face(up(-5, 6, -5, 6, 1));
  return scene.hide(0, {blocked(1)}).hide(1, {away()});
}

/// Two that share an edge. A line of a blocker that looks up is negative inside it.
inline Weak_scene two_abutting() {
  Weak_scene scene = nothing_between();
  scene.face(up(-5, ratio(1, 2), -5, 6, 1));
  scene.face(up(ratio(1, 2), 6, -5, 6, 1));
  const std::size_t middle = scene.line(1, 1);
  return scene.hide(0, {side_of(middle), blocked(2), blocked(1)}).hide(1, {away()}).hide(2, {away()});
}

/// One on the left, two on the right.
inline Weak_scene t_junction() {
  Weak_scene scene = nothing_between();
  scene.face(up(-5, ratio(1, 2), -5, 6, 1));
  scene.face(up(ratio(1, 2), 6, -5, ratio(1, 2), 1));
  scene.face(up(ratio(1, 2), 6, ratio(1, 2), 6, 1));
  const std::size_t middle = scene.line(1, 1), right = scene.line(2, 2);
  return scene.hide(0, {side_of(middle), side_of(right), blocked(3), blocked(2), blocked(1)})
      .hide(1, {away()})
      .hide(2, {away()})
      .hide(3, {away()});
}

/// A source that stands upright through a floor; the floor blocks what is below, a wall what is above. The floor is
/// seen.
inline Weak_scene source_through_floor() {
  Weak_scene scene;
  scene.from({at(0, 0, -1), at(0, 0, 1), at(1, 0, 1), at(1, 0, -1)});
  scene.face({at(0, 4, 2), at(1, 4, 2), at(1, 4, 3), at(0, 4, 3)});
  scene.face({at(-5, 2, ratio(3, 4)), at(-5, 2, 5), at(6, 2, 5), at(6, 2, ratio(3, 4))});
  scene.face(up(-5, 6, -1, 6, 0));
  scene.hide(0, {cut_source(form(0, 0, 1, 0)), blocked(1), blocked(2)}).hide(1, {away()});
  return scene.see(2, at(ratio(1, 2), 0, ratio(1, 2)), at(ratio(1, 2), 1, 0));
}

/// A target that is partly below the source, and behind a wall where it is above.
inline Weak_scene target_through_ground() {
  Weak_scene scene;
  scene.from(up(0, 1, 0, 1, 0));
  scene.face(facing_back(3, 0, 1, -1, 1));
  scene.face(reversed(facing_back(2, -5, 6, -5, 5)));
  return scene.hide(0, {cut_target(form(0, 0, 1, 0)), blocked(1), away()}).hide(1, {away()});
}

/// One target below the source, one in its plane, one that looks up.
inline Weak_scene all_away() {
  Weak_scene scene;
  scene.from(up(0, 1, 0, 1, 0));
  scene.face(up(0, 1, 0, 1, -1));
  scene.face(down(0, 1, 0, 1, 0));
  scene.face(up(0, 1, 0, 1, 2));
  return scene.hide(0, {away()}).hide(1, {away()}).hide(2, {away()});
}

/// A slit of the given width between two blockers.
inline Weak_scene open_slit(const Rational& width = ratio(1, 5)) {
  Weak_scene scene = nothing_between();
  scene.face(up(-5, ratio(1, 2), -5, 6, 1));
  scene.face(up(ratio(1, 2) + width, 6, -5, 6, 1));
  return scene.hide(1, {away()})
      .hide(2, {away()})
      .see(0, at(ratio(1, 2) + width / 2, ratio(1, 2), 0), at(ratio(1, 2) + width / 2, ratio(1, 2), 3));
}

/// Two blockers at different heights, whose edges a line can pass only if it touches both. `slack` makes them overlap.
inline Weak_scene closed_slit(const Rational& first = 2, const Rational& second = 1, const Rational& slack = 0) {
  Weak_scene scene;
  scene.from(up(0, 1, 0, 1, 0)).face(down(1, 2, 0, 1, 3));
  scene.face(up(-9, 1, -5, 6, 1));
  scene.face(up(1 - slack, 9, -9, 13, 2));
  const std::size_t low = scene.line(1, 1), high = scene.line(2, 3);
  return scene
      .hide(0, {side_of(low), side_of(high), empty({term(low, first), term(high, second)}), blocked(2), blocked(1)})
      .hide(1, {away()})
      .hide(2, {away()});
}

/// A skew edge and a level one, which no line can pass both; but the multipliers must grow along the source: (1 + x) (y
/// - 11/20) + (1 + x) (1/2 - y) <= 0, and a little for the width. `mirrored`: source and target exchanged.
inline Weak_scene skew_slit(const std::vector<Term>& terms, bool mirrored = false) {
  const Rational thin = ratio(1, 100), end = ratio(99, 200);
  const auto place = [&](Points points) {
    if (mirrored)
      for (Exact_point& p : points) p[2] = 1 - p[2];
    return points;
  };
  const Points along = up(0, 1, -thin, thin, 0), across = up(-2 * thin, -thin, 0, 1, 1);
  Weak_scene scene;
  scene.from(mirrored ? place(across) : along).face(reversed(mirrored ? place(along) : across));
  scene.face(place(up(-9, 9, -9, end, ratio(9, 10))));
  scene.face(place({at(-1, 0, 0), at(0, ratio(1, 2), 1), at(0, 9, 1), at(-1, 9, 0)}));
  const std::size_t level = scene.line(1, 2), skew = scene.line(2, 0);
  return scene.hide(0, {side_of(level), side_of(skew), empty(terms), blocked(2), blocked(1)})
      .hide(1, {away()})
      .hide(2, {away()});
}
inline Weak_scene skew_slit() { return skew_slit({term(0, ratio(5, 81), form(1, 0, 0, 1)), term(1, 1)}); }
inline Weak_scene skew_slit_mirrored() {
  return skew_slit({term(0, ratio(5, 81), {}, form(1, 0, 0, 1)), term(1, 1)}, true);
}
inline Weak_scene skew_slit_both() {
  return skew_slit({term(0, ratio(5, 81), {}, form(1, 0, 0, 1)), term(1, 1, form(0, ratio(1, 100), 0, 1))}, true);
}

/// Two faces like a gutter, whose keel is on the source: only the keel, a set of measure zero, sees what is above.
inline Weak_scene keel() {
  Weak_scene scene;
  scene.from(up(-1, 1, -1, 1, 0)).face(down(-1, 1, -1, 1, 3));
  scene.face({at(0, -9, 0), at(8, -9, 8), at(8, 9, 8), at(0, 9, 0)});
  scene.face({at(-8, -9, 8), at(0, -9, 0), at(0, 9, 0), at(-8, 9, 8)});
  const Node halves = cut_source(form(1, 0, 0, 0));
  return scene.hide(0, {halves, blocked(1), blocked(2)})
      .hide(1, {halves, away(), blocked(2)})
      .hide(2, {halves, blocked(1), away()});
}

/// Both sides count: a blocker is seen from behind, and hides a target that looks up.
inline Weak_scene two_sided() {
  Weak_scene scene;
  scene.certificate.two_sided = true;
  scene.from(up(0, 1, 0, 1, 0)).face(up(0, 1, 0, 1, 3));
  scene.face(up(-5, 6, -5, 6, 1));
  scene.face(down(0, 1, 0, 1, 0));
  return scene.hide(0, {blocked(1)})
      .hide(2, {away()})
      .see(1, at(ratio(1, 3), ratio(1, 2), 0), at(ratio(1, 2), ratio(1, 2), 1));
}

/// Two sources, two fragments of one face, a face of which nothing is said, a fragment with a straight corner, and a
/// cell that is cut to nothing.
inline Weak_scene two_sources() {
  Weak_scene scene = two_abutting();
  auto& c = scene.certificate;
  scene.from(up(2, 3, 0, 1, -2));
  c.fragments[0].vertices = {at(0, 0, 3), at(0, 1, 3), at(ratio(1, 3), 1, 3), at(ratio(1, 3), 0, 3)};
  c.fragments.push_back(
      {0, 0, {at(1, 0, 3), at(ratio(1, 3), 0, 3), at(ratio(1, 3), 1, 3), at(ratio(2, 3), 1, 3), at(1, 1, 3)}});
  scene.hide(3, {side_of(0), blocked(2), blocked(1)})
      .hide(3, {cut_source(form(1, 0, 0, -2)), blocked(2), empty()}, 1)
      .hide(0, {side_of(0), blocked(2), blocked(1)}, 1);
  scene.hide(1, {away()}, 1).hide(2, {cut_target(form(0, 0, 1, 5)), away(), empty()}, 1);
  scene.face(down(0, 1, 0, 1, 2));
  c.undecided = {3};
  return scene;
}

/// n blockers beside each other; the tree halves them.
inline Weak_scene strip(std::size_t n) {
  Weak_scene scene;
  const auto x = [&](std::size_t k) {
    return k == 0 ? Rational(-9) : k == n ? Rational(9) : ratio(static_cast<long>(k), static_cast<long>(n));
  };
  scene.from(up(0, 1, 0, 1, 0)).face(down(0, 1, 0, 1, 2));
  for (std::size_t k = 0; k < n; ++k) {
    scene.face(up(x(k), x(k + 1), -9, 9, 1));
    scene.line(k + 1, 1);
    scene.hide(k + 1, {away()});
  }
  Proof proof;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, n}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    if (end - begin == 1) {
      proof.push_back(blocked(begin + 1));
      continue;
    }
    const std::size_t middle = (begin + end) / 2;
    proof.push_back(side_of(middle - 1));  // positive where x is greater
    open.push_back({begin, middle});
    open.push_back({middle, end});
  }
  return scene.hide(0, proof);
}

inline std::vector<std::pair<const char*, Weak_scene>> all_scenes() {
  return {{"one blocker", one_blocker()},
          {"two abutting", two_abutting()},
          {"T-junction", t_junction()},
          {"source through floor", source_through_floor()},
          {"target through ground", target_through_ground()},
          {"all away", all_away()},
          {"open slit", open_slit()},
          {"closed slit", closed_slit()},
          {"skew slit", skew_slit()},
          {"skew slit, mirrored", skew_slit_mirrored()},
          {"skew slit, both", skew_slit_both()},
          {"keel", keel()},
          {"two-sided", two_sided()},
          {"two sources", two_sources()},
          {"strip", strip(5)}};
}

// ---- The judge

inline Exact_point along(const Exact_point& p, const Rational& t, const Exact_point& d) {
  return at(p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]);
}
inline Exact_point from_to(const Exact_point& a, const Exact_point& b) { return along(b, -1, a); }
inline Rational inner(const Exact_point& a, const Exact_point& b) {
  return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
inline Exact_point outer(const Exact_point& a, const Exact_point& b) {
  return at(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
/// A convex polygon as half-spaces: its plane, and for each edge the direction inwards.
struct Judged {
  Points corners;
  Exact_point normal = at(0, 0, 0);
  std::vector<Exact_point> inwards;

  explicit Judged(const Points& polygon) : corners(polygon) {
    const auto edge = [&](std::size_t i) { return from_to(corners[i], corners[(i + 1) % corners.size()]); };
    for (std::size_t i = 0; i < corners.size(); ++i)
      normal = along(normal, 1, outer(from_to(corners[0], corners[i]), edge(i)));
    for (std::size_t i = 0; i < corners.size(); ++i) inwards.push_back(outer(normal, edge(i)));
  }
  Rational height(const Exact_point& p) const { return inner(normal, from_to(corners[0], p)); }
  int above(const Exact_point& p) const { return sgn(height(p)); }
  int place(const Exact_point& p) const {  // 1 inside, 0 on the boundary, -1 outside; p in the plane
    int least = 1;
    for (std::size_t i = 0; i < corners.size(); ++i)
      least = std::min(least, sgn(inner(inwards[i], from_to(corners[i], p))));
    return least;
  }
  /// The places t on the way from p to q, in [0, 1], where it meets the closed polygon: one, or, if it is in the plane,
  /// the ends of a stretch.
  std::vector<Rational> meetings(const Exact_point& p, const Exact_point& q) const {
    const Exact_point d = from_to(p, q);
    const Rational at_p = height(p), at_q = height(q);
    if (sgn(at_p) * sgn(at_q) > 0) return {};
    if (at_p != at_q) {
      const Rational t = at_p / (at_p - at_q);
      return place(along(p, t, d)) >= 0 ? std::vector<Rational>{t} : std::vector<Rational>{};
    }
    Rational low = 0, high = 1;  // clipped edge by edge
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Rational start = inner(inwards[i], from_to(corners[i], p)), change = inner(inwards[i], d);
      if (sgn(change) == 0 && sgn(start) < 0) return {};
      if (sgn(change) > 0) low = std::max(low, Rational(-start / change));
      if (sgn(change) < 0) high = std::min(high, Rational(-start / change));
    }
    return low <= high ? std::vector<Rational>{low, high} : std::vector<Rational>{};
  }
  /// Whether the open segment meets it.
  bool blocks(const Exact_point& p, const Exact_point& q) const {
    const std::vector<Rational> places = meetings(p, q);
    return !places.empty() && places.front() < 1 && places.back() > 0;
  }
};
inline Exact_point random_inside(const Points& polygon, Dice& dice) {
  Exact_point sum = at(0, 0, 0);
  Rational total = 0;
  for (const Exact_point& p : polygon) {
    const Rational weight = roll(dice, 0, 5) == 0 ? Rational(roll(dice, 1, 100000)) : Rational(roll(dice, 1, 1000));
    sum = along(sum, weight, p);
    total += weight;
  }
  return at(sum[0] / total, sum[1] / total, sum[2] / total);
}
/// det[p, q, a, b], by its first column.
inline Rational side_value(const Exact_point& p, const Exact_point& q, const Exact_point& a, const Exact_point& b) {
  return -inner(from_to(a, p), outer(from_to(a, q), from_to(a, b)));
}

/// Shoots at what a certificate says. Pre: it is accepted, so that all it names is there.
struct Judge {
  const Weak_certificate& c;
  std::vector<Judged> fragments, sources;

  explicit Judge(const Weak_certificate& certificate) : c(certificate) {
    for (const Order_fragment& fragment : c.fragments) fragments.emplace_back(fragment.vertices);
    for (const Points& source : c.sources) sources.emplace_back(source);
  }
  bool look_at_each_other(std::size_t source, std::size_t target, const Exact_point& p, const Exact_point& q) const {
    const int front = fragments[target].above(p);
    return sources[source].above(q) > 0 && (c.two_sided ? front != 0 : front > 0);
  }
  bool is_free(const Exact_point& p, const Exact_point& q) const {
    return std::none_of(fragments.begin(), fragments.end(), [&](const Judged& f) { return f.blocks(p, q); });
  }
  /// What is wrong with it; nothing, if nothing was found.
  std::string fault(Dice& dice, int shots) const {
    for (const auto& v : c.visible)
      for (int k = 0; k < 8; ++k)
        if (!holds(v, k == 0 ? Rational(0) : tiny(200), dice)) return "not a sightline";
    std::vector<Weak_certificate::Hidden> hidden;  // one fragment each
    for (const auto& entry : c.hidden)
      entry.for_each_fragment([&](std::size_t fragment) {
        hidden.push_back({fragment, entry.source, entry.proof, {}});
      });
    for (const auto& entry : hidden)
      for (int k = 0; k < shots; ++k) {
        const Exact_point p = random_inside(c.sources[entry.source], dice),
                          q = random_inside(c.fragments[entry.fragment].vertices, dice);
        if (const std::string what = fault_at(entry, p, q); !what.empty()) return "a pair " + what;
        bool sees = true;  // and so do others close to it
        for (int n = 0; sees && n < 4; ++n) {
          const Rational step = n == 0 ? Rational(0) : tiny(200);
          const Exact_point near_p = along(p, step, from_to(p, random_inside(c.sources[entry.source], dice)));
          const Exact_point near_q =
              along(q, step, from_to(q, random_inside(c.fragments[entry.fragment].vertices, dice)));
          sees = look_at_each_other(entry.source, entry.fragment, near_p, near_q) && is_free(near_p, near_q);
        }
        if (sees) return "a pair sees each other";
      }
    for (std::size_t i = 0; i < c.fragments.size(); ++i)
      for (std::size_t s = 0; s < c.sources.size(); ++s) {
        const Face_id f = c.fragments[i].face;
        const bool visible = std::any_of(c.visible.begin(), c.visible.end(),
                                         [&](const auto& v) { return c.fragments[v.fragment].face == f; });
        const bool is_hidden =
            std::any_of(hidden.begin(), hidden.end(), [&](const auto& h) { return h.fragment == i && h.source == s; });
        const auto undecided = std::count(c.undecided.begin(), c.undecided.end(), f);
        if (undecided > 1 || (undecided == 1 && visible) || (undecided == 0 && !visible && !is_hidden))
          return "a face is not accounted for once";
      }
    return "";
  }

  /// Whether the sightline, its ends moved by `step` of the way to points inside, is one.
  bool holds(const Weak_certificate::Sightline& v, const Rational& step, Dice& dice) const {
    const Judged &source = sources[v.source], &target = fragments[v.fragment];
    const Exact_point p = along(v.from, step, from_to(v.from, random_inside(source.corners, dice))),
                      q = along(v.to, step, from_to(v.to, random_inside(target.corners, dice)));
    return source.above(p) == 0 && source.place(p) > 0 && target.above(q) == 0 && target.place(q) > 0 &&
           look_at_each_other(v.source, v.fragment, p, q) && is_free(p, q);
  }
  /// Goes to the leaf where the tree sends a pair of points, and says what is wrong there. Empty: nothing, or the pair
  /// is on a border.
  std::string fault_at(const Weak_certificate::Hidden& entry, const Exact_point& p, const Exact_point& q) const {
    std::size_t skip = 0;  // subtrees that the pair is not in
    for (const Node& n : entry.proof) {
      const bool is_inner = n.kind == Kind::line || n.kind == Kind::cut_source || n.kind == Kind::cut_target;
      if (skip > 0) {
        skip = is_inner ? skip + 1 : skip - 1;
        continue;
      }
      if (is_inner) {
        Rational value;
        if (n.kind == Kind::line) {
          const auto& [fragment, corner] = c.lines[n.index];
          const Points& polygon = c.fragments[fragment].vertices;
          value = side_value(p, q, polygon[corner], polygon[(corner + 1) % polygon.size()]);
        } else {
          value = inner(at(n.plane[0], n.plane[1], n.plane[2]), n.kind == Kind::cut_source ? p : q) + n.plane[3];
        }
        if (sgn(value) == 0) return "";
        if (sgn(value) < 0) skip = 1;
        continue;
      }
      if (n.kind == Kind::away)
        return look_at_each_other(entry.source, entry.fragment, p, q) ? "looks, in an away leaf" : "";
      if (n.kind == Kind::empty) return "is in an empty leaf";
      return fragments[n.index].blocks(p, q) ? "" : "is not blocked";
    }
    return "is in no leaf";
  }
};

}  // namespace weak_test
