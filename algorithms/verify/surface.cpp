// From top to bottom: the loops, the axis, the two kinds of surfaces.

#include <sightline/algorithms/verify/surface.h>

#include <sightline/algorithms/verify/contour.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace sightline::certificate_check {

namespace {

bool on_one_line(const Exact_point& p, const Exact_point& q, const Exact_point& r) {
  const Exact_point normal = cross(minus(q, p), minus(r, p));
  return sgn(normal[0]) == 0 && sgn(normal[1]) == 0 && sgn(normal[2]) == 0;
}

}  // namespace

Polygon without_straight_points(const Polygon& loop) {
  Polygon left = loop;
  for (std::size_t i = 0, unchanged = 0; left.size() > 2 && unchanged < left.size();) {
    const std::size_t n = left.size();
    const Exact_point &before = left[(i + n - 1) % n], &p = left[i % n], &after = left[(i + 1) % n];
    if (p == after || on_one_line(before, p, after)) {
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i % n));
      unchanged = 0;
      i = (i % n + n - 2) % (n - 1);  // the one before has a new neighbour
    } else {
      i = (i + 1) % n;
      ++unchanged;
    }
  }
  if (left.size() < 3) left.clear();
  return left;
}

Skew_face::Skew_face(const Face& face) {
  for (const Polygon& loop : face.loops) {
    Polygon left = without_straight_points(loop);
    if (left.empty() && loops.empty()) return;
    if (!left.empty()) loops.push_back(std::move(left));
  }
}

std::vector<Polygon> Skew_face::seen_along(std::size_t axis) const {
  std::vector<Polygon> seen = loops;
  for (Polygon& loop : seen) {
    const int sense = sgn(newell_normal(loop)[axis]);
    if (sense == 0) return {};
    if (&loop != &seen[0] && sense == sgn(newell_normal(seen[0])[axis])) std::reverse(loop.begin(), loop.end());
  }
  return seen;
}

bool Skew_face::simple_along(std::size_t axis) const {
  const std::vector<Polygon> seen = seen_along(axis);
  if (seen.empty()) return false;
  const Contour contour(seen, axis, sgn(newell_normal(seen[0])[axis]) < 0);
  std::set<Exact_point> points;
  for (const Polygon& loop : seen) points.insert(loop.begin(), loop.end());
  return contour.points.size() == points.size() && !contour.crosses_itself() &&
         contour.winding() == Contour::Winding::once && !contour.edge_passes_a_point();
}

std::optional<std::size_t> Skew_face::axis() const {
  if (loops.empty()) return std::nullopt;
  const Integer_vector area = newell_normal(loops[0]);
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) { return abs(area[a]) > abs(area[b]); });
  for (const std::size_t axis : axes)
    if (simple_along(axis)) return axis;
  return std::nullopt;
}

namespace {

// ---- The triangulation along an axis

/// A piece, as it looks along the axis.
struct Triangle {
  std::array<Exact_point, 3> corners;
  std::array<Contour::Point, 3> flat;
  std::string name;

  Contour::Edge edge(std::size_t k) const { return {flat[k], flat[(k + 1) % 3]}; }
};

/// The pieces as triangles on the points of the loops, counterclockwise.
std::vector<Triangle> triangles_of(const std::string& what, const std::vector<Surface_piece>& pieces,
                                   const std::set<Exact_point>& own, std::size_t axis, bool mirrored) {
  std::vector<Triangle> triangles;
  for (const Surface_piece& piece : pieces) {
    if (piece.polygon->size() != 3) reject(piece.name + " of " + what + ", which is not planar, is no triangle");
    Triangle& triangle = triangles.emplace_back();
    triangle.name = piece.name + " of " + what;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.corners[k] = (*piece.polygon)[k];
      if (!own.count(triangle.corners[k])) reject(triangle.name + " has a vertex that is not a corner of the face's");
      triangle.flat[k] = Contour::look(triangle.corners[k], axis, mirrored);
    }
    if (side(triangle.edge(0), triangle.flat[2]) <= 0)
      reject(triangle.name + " does not run counterclockwise as seen along the axis " + "xyz"[axis]);
  }
  return triangles;
}

/// Rejects where a triangle holds a point that is not its corner, or an edge of the loops runs through it.
void check_nothing_inside(const Contour& contour, const std::vector<Triangle>& triangles) {
  for (const Triangle& triangle : triangles) {
    for (const Contour::Point& p : contour.points) {
      const bool is_corner = std::count(triangle.flat.begin(), triangle.flat.end(), p) > 0;
      if (!is_corner && side(triangle.edge(0), p) >= 0 && side(triangle.edge(1), p) >= 0 &&
          side(triangle.edge(2), p) >= 0)
        reject(triangle.name + " holds a corner of the face that is not its own");
    }
    for (const Contour::Edge& edge : contour.edges)
      for (std::size_t k = 0; k < 3; ++k)
        if (cross_inside(edge, triangle.edge(k))) reject(triangle.name + " is crossed by an edge of the face");
  }
}

/// +1 where d is inside the circle through a, b, c, 0 on it. Pre: they run counterclockwise.
int in_circle(const Contour::Point& a, const Contour::Point& b, const Contour::Point& c, const Contour::Point& d) {
  std::array<std::array<Rational, 3>, 3> m;
  for (std::size_t k = 0; k < 3; ++k) {
    const Contour::Point& p = k == 0 ? a : k == 1 ? b : c;
    const Rational x = p[0] - d[0], y = p[1] - d[1];
    m[k] = {x, y, Rational(x * x + y * y)};
  }
  const std::array<Rational, 3> normal = cross(m[1], m[2]);
  return sgn(Rational(m[0][0] * normal[0] + m[0][1] * normal[1] + m[0][2] * normal[2]));
}

/// Rejects where two triangles that share an edge which is on none of the loops' should have the other diagonal.
void check_delaunay(const Contour& contour, const std::vector<Triangle>& triangles) {
  const auto on = [](const Contour::Edge& e, const Contour::Point& p) {
    return p == e.from || p == e.to || inside(e, p);
  };
  std::map<std::pair<Contour::Point, Contour::Point>, std::pair<const Triangle*, std::size_t>> edges;
  for (const Triangle& triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [from, to] = triangle.edge(k);
      edges[{from, to}] = {&triangle, k};
      const auto twin = edges.find({to, from});
      if (twin == edges.end()) continue;
      const bool on_contour =
          std::any_of(contour.edges.begin(), contour.edges.end(),
                      [&, from = from, to = to](const Contour::Edge& e) { return on(e, from) && on(e, to); });
      if (on_contour) continue;
      const auto& [other, l] = twin->second;
      const int inside_circle =
          in_circle(triangle.flat[0], triangle.flat[1], triangle.flat[2], other->flat[(l + 2) % 3]);
      const Exact_point &a = triangle.corners[k], &b = triangle.corners[(k + 1) % 3];
      const Exact_point& least = std::min({a, b, triangle.corners[(k + 2) % 3], other->corners[(l + 2) % 3]});
      if (inside_circle > 0 || (inside_circle == 0 && least != a && least != b))
        reject(triangle.name + " is not one of the face's surface: the diagonal from " + name(a) + " to " + name(b) +
               " should be the other one");
    }
}

void check_triangulation(const std::string& what, const std::vector<Polygon>& loops, std::size_t axis,
                         const std::vector<Surface_piece>& pieces) {
  const bool mirrored = sgn(newell_normal(loops[0])[axis]) < 0;
  const Contour contour(loops, axis, mirrored);
  std::set<Exact_point> own;
  for (const Polygon& loop : loops) own.insert(loop.begin(), loop.end());
  const std::vector<Triangle> triangles = triangles_of(what, pieces, own, axis, mirrored);
  Boundary_chain difference;
  difference.add(loops, 1);
  for (const Surface_piece& piece : pieces) difference.add(*piece.polygon, -1);
  if (const auto point = difference.nonzero())
    reject(what + " is not bounded as its pieces are: boundaries do not cancel near " + name(*point));
  check_nothing_inside(contour, triangles);
  check_delaunay(contour, triangles);
}

// ---- The cone

/// The triangles from the least point to the edges, less those walked back. An edge is cut where it passes a point.
std::vector<Polygon> cone_of(const Polygon& loop) {
  std::map<std::pair<Exact_point, Exact_point>, long> net;  // edges from the lesser end to the other
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto [low, high] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
    std::set<Exact_point> stops{low, high};
    for (const Exact_point& p : loop)
      if (low < p && p < high && on_one_line(low, p, high)) stops.insert(p);
    for (auto from = stops.begin(), to = std::next(from); to != stops.end(); ++from, ++to)
      net[{*from, *to}] += low == loop[i] ? 1 : -1;
  }
  std::set<Exact_point> ends;
  for (const auto& [edge, times] : net)
    if (times != 0) ends.insert({edge.first, edge.second});
  std::vector<Polygon> triangles;
  for (const auto& [edge, times] : net) {
    if (times == 0 || on_one_line(*ends.begin(), edge.first, edge.second)) continue;
    const Polygon triangle =
        times > 0 ? Polygon{*ends.begin(), edge.first, edge.second} : Polygon{*ends.begin(), edge.second, edge.first};
    triangles.insert(triangles.end(), static_cast<std::size_t>(std::abs(times)), triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

void check_cone(const std::string& what, const Polygon& loop, const std::vector<Surface_piece>& pieces) {
  std::vector<Polygon> given;
  for (const Surface_piece& piece : pieces) {
    Polygon polygon = *piece.polygon;
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    given.push_back(std::move(polygon));
  }
  std::sort(given.begin(), given.end());
  if (given != cone_of(loop))
    reject(what + ", which is simple along no axis, has other pieces than the triangles from its least point");
}

}  // namespace

void check_surface(const std::string& what, const Face& face, const std::vector<Surface_piece>& pieces) {
  const Skew_face skew(face);
  if (skew.loops.empty()) reject(what + " has no area and is not set aside");
  if (const auto axis = skew.axis()) check_triangulation(what, skew.seen_along(*axis), *axis, pieces);
  else if (skew.loops.size() > 1) reject(what + " is simple along no axis, has holes and is not set aside");
  else check_cone(what, skew.loops[0], pieces);
}

}  // namespace sightline::certificate_check
