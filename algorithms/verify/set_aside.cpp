// To be read after faces.h and verdict.h: contours as they look along an axis, then each reason.

#include <sightline/algorithms/verify/set_aside.h>

#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/scene/set_aside.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sightline::certificate_check {

namespace {

/// +1 where p is on the left of the edge, 0 on its line, -1 on the right.
int side(const Contour::Edge& e, const Contour::Point& p) {
  return sgn(Rational((e.to[0] - e.from[0]) * (p[1] - e.from[1]) - (e.to[1] - e.from[1]) * (p[0] - e.from[0])));
}

/// Whether the edges cross in a point inside both.
bool cross_inside(const Contour::Edge& e, const Contour::Edge& f) {
  return side(e, f.from) * side(e, f.to) < 0 && side(f, e.from) * side(f, e.to) < 0;
}

/// Where the lines of the edges meet. Pre: they are not parallel.
Contour::Point crossing(const Contour::Edge& e, const Contour::Edge& f) {
  const Rational ex = e.to[0] - e.from[0], ey = e.to[1] - e.from[1], fx = f.to[0] - f.from[0], fy = f.to[1] - f.from[1];
  const Rational t = ((f.from[0] - e.from[0]) * fy - (f.from[1] - e.from[1]) * fx) / (ex * fy - ey * fx);
  return {Rational(e.from[0] + t * ex), Rational(e.from[1] + t * ey)};
}

/// Whether p lies on the edge, between its ends.
bool inside(const Contour::Edge& e, const Contour::Point& p) {
  return p != e.from && p != e.to && side(e, p) == 0 && std::min(e.from, e.to) < p && p < std::max(e.from, e.to);
}

}  // namespace

Contour::Contour(const std::vector<Polygon>& loops, std::size_t axis, bool mirrored) {
  std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (mirrored) std::swap(x, y);
  for (const Polygon& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Exact_point &from = loop[i], &to = loop[(i + 1) % loop.size()];
      edges.push_back({{from[x], from[y]}, {to[x], to[y]}});
      points.insert(edges.back().from);
    }
}

bool Contour::crosses_itself() const {
  for (auto e = edges.begin(); e != edges.end(); ++e)
    for (auto f = edges.begin(); f != e; ++f)
      if (cross_inside(*e, *f) && !points.count(crossing(*e, *f))) return true;
  return false;
}

Contour::Winding Contour::winding() const {
  std::set<Rational> abscissae;
  for (const Point& p : points) abscissae.insert(p[0]);
  Winding found = Winding::none;
  if (abscissae.empty()) return found;
  // Between neighbouring abscissae no edges cross: add up the winding number from below on a line in the middle.
  for (auto left = abscissae.begin(), right = std::next(left); right != abscissae.end(); ++left, ++right) {
    const Rational middle = (*left + *right) / 2;
    std::map<Rational, int> steps;
    for (const auto& [from, to] : edges)
      if (std::min(from[0], to[0]) < middle && middle < std::max(from[0], to[0])) {
        const Rational height = from[1] + (to[1] - from[1]) * (middle - from[0]) / (to[0] - from[0]);
        steps[height] += from[0] < to[0] ? 1 : -1;
      }
    int number = 0;
    for (const auto& [height, step] : steps) {
      number += step;
      if (number != 0 && number != 1) return Winding::other;
      if (number == 1) found = Winding::once;
    }
  }
  return found;
}

bool Contour::edge_passes_a_point() const {
  std::map<std::pair<Point, Point>, long> walks;  // there minus back
  for (const auto& [from, to] : edges) {
    if (from < to) ++walks[{from, to}];
    else --walks[{to, from}];
  }
  return std::any_of(walks.begin(), walks.end(), [&](const auto& walk) {
    const Edge edge{walk.first.first, walk.first.second};
    return walk.second != 0 &&
           std::any_of(points.begin(), points.end(), [&](const Point& p) { return inside(edge, p); });
  });
}

bool self_intersecting(const Face& face) {
  // Seen from the front, as if a coordinate plane were the face's.
  std::size_t axis = 0;
  while (sgn(face.plane.normal[axis]) == 0) ++axis;
  const Contour contour(face.loops, axis, sgn(face.plane.normal[axis]) < 0);
  return contour.crosses_itself() || contour.winding() == Contour::Winding::other;
}

bool simple_along(const Face& face, std::size_t axis) {
  const std::vector<Polygon> loops = face.seen_along(axis);
  if (loops.empty()) return false;
  const Contour contour(loops, axis, sgn(newell_normal(loops[0])[axis]) < 0);
  std::set<Exact_point> points;
  for (const Polygon& loop : loops) points.insert(loop.begin(), loop.end());
  return contour.points.size() == points.size() && !contour.crosses_itself() &&
         contour.winding() == Contour::Winding::once && !contour.edge_passes_a_point();
}

bool same_cycle(const Polygon& a, const Polygon& b) {
  if (a.size() != b.size()) return false;
  Polygon twice = a;
  twice.insert(twice.end(), a.begin(), a.end());
  return std::search(twice.begin(), twice.end(), b.begin(), b.end()) != twice.end();
}

namespace {

void check_zero_area(const std::string& what, const Face& face) {
  Boundary_chain boundary, outer;
  boundary.add(face.loops, 1);
  outer.add(face.loops[0], 1);
  const bool no_area = !boundary.nonzero() || !outer.nonzero();
  if (!no_area) reject(what + " is set aside for zero area but has area");
}

/// Loop by loop the same cycles, holes in either sense.
bool same_loops(const Face& a, const Face& b) {
  if (a.loops.size() != b.loops.size() || !same_cycle(a.loops[0], b.loops[0])) return false;
  for (std::size_t k = 1; k < a.loops.size(); ++k)
    if (!same_cycle(a.loops[k], b.loops[k]) && !same_cycle(a.loops[k], Polygon(b.loops[k].rbegin(), b.loops[k].rend())))
      return false;
  return true;
}

/// `digits`: what stands behind "duplicate of ".
void check_duplicate(const std::string& what, const Polygon_soup& soup, const Face& face, Face_id own,
                     std::string_view digits, const std::set<Face_id>& set_aside) {
  std::uint64_t original = 0;
  std::size_t count = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') break;
    original = std::min(10 * original + static_cast<std::uint64_t>(c - '0'), std::uint64_t{1} << 32);
    ++count;
  }
  if (count == 0 || original >= own) reject(what + " is set aside as a duplicate, but not of an earlier face");
  const Face_id f = static_cast<Face_id>(original);
  if (set_aside.count(f))
    reject(what + " is set aside as a duplicate of face " + std::to_string(f) + ", which is set aside itself");
  const Face other(soup, f);
  if (!same_loops(face, other))
    reject(what + " is set aside as a duplicate of face " + std::to_string(f) + " but differs from it");
}

void check_self_intersecting(const std::string& what, const Face& face) {
  if (!face.planar) reject(what + " is set aside as self-intersecting but is not planar");
  if (is_zero(face.plane.normal) || !self_intersecting(face))
    reject(what + " is set aside as self-intersecting but is not");
}

void check_no_simple_projection(const std::string& what, const Face& face) {
  const std::string aside = what + " is set aside as simple along no axis but ";
  if (face.planar) reject(aside + "is planar");
  if (face.loops.size() == 1) reject(aside + "has no holes");
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (simple_along(face, axis)) reject(aside + "is along axis " + "xyz"[axis]);
}

}  // namespace

void check_set_aside(const Polygon_soup& soup, const Covering::Set_aside& entry, const std::set<Face_id>& set_aside) {
  const std::string what = name("face", entry.face);
  const std::optional<Set_aside_reason> reason = set_aside_reason(entry.why);
  if (!reason) reject(what + " is set aside for no reason that can be checked");
  const Face face(soup, entry.face);
  switch (*reason) {
    case Set_aside_reason::zero_area: return check_zero_area(what, face);
    case Set_aside_reason::duplicate:
      return check_duplicate(what, soup, face, entry.face, std::string_view(entry.why).substr(text_of(*reason).size()),
                             set_aside);
    case Set_aside_reason::self_intersecting: return check_self_intersecting(what, face);
    case Set_aside_reason::no_simple_projection: return check_no_simple_projection(what, face);
  }
}

}  // namespace sightline::certificate_check
