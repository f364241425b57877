#pragma once
// Convex hulls by brute force in integers, on-view faces by definition, and viewpoints where everything is degenerate.

#include <sightline/algorithms/cutset/tracker.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/harness/generate/soups.h>

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace cutset_test {

using namespace sightline;
using Wide = __int128;
using Whole = std::array<std::int64_t, 3>;

inline std::int64_t between(std::mt19937_64& random, std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

inline Whole minus(const Whole& a, const Whole& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Whole cross(const Whole& a, const Whole& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline std::int64_t dot(const Whole& a, const Whole& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A polyhedron in small integers: face k's corners, counterclockwise seen from outside.
struct Body {
  std::vector<Whole> points;
  std::vector<std::vector<std::uint32_t>> faces;

  Whole normal(std::size_t f) const {
    const auto& c = faces[f];
    return cross(minus(points[c[1]], points[c[0]]),
                 minus(points[c[2]], points[c[0]]));  // Pre: convex faces without straight corners
  }
  Polygon_soup soup() const {
    Polygon_soup soup;
    for (const Whole& p : points) soup.add_point(Rational(p[0]), Rational(p[1]), Rational(p[2]));
    for (const auto& face : faces) soup.add_face(face);
    return soup;
  }
};

/// The convex hull of points with small integer coordinates, coplanar ones in one face: every plane through three of
/// them with nothing in front. Empty faces where they are all coplanar.
inline Body hull(std::vector<Whole> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Body body{points, {}};
  std::set<std::vector<std::uint32_t>> seen;
  const std::uint32_t n = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t k = 0; k < n; ++k) {
        const Whole normal = cross(minus(points[j], points[i]), minus(points[k], points[i]));
        if (normal == Whole{0, 0, 0}) continue;
        std::vector<std::uint32_t> on;
        bool behind = false, front = false;
        for (std::uint32_t p = 0; p < n && !front; ++p) {
          const std::int64_t height = dot(normal, minus(points[p], points[i]));
          front |= height > 0;
          behind |= height < 0;
          if (height == 0) on.push_back(p);
        }
        if (front || !behind || !seen.insert(on).second) continue;
        // Its corners: gift wrapping in the plane, the farther of collinear points.
        std::vector<std::uint32_t> loop{on.front()};  // the least point is a corner
        do {
          std::uint32_t next = loop.back() == on[0] ? on[1] : on[0];
          for (const std::uint32_t p : on) {
            if (p == loop.back()) continue;
            const Whole at = points[loop.back()], a = minus(points[next], at), b = minus(points[p], at);
            const std::int64_t turn = dot(normal, cross(a, b));
            if (turn < 0 || (turn == 0 && dot(b, b) > dot(a, a))) next = p;
          }
          loop.push_back(next);
        } while (loop.back() != loop.front());
        loop.pop_back();
        body.faces.push_back(loop);
      }
  return body;
}

/// A viewpoint in homogeneous integers: x/w, y/w, z/w, or with w = 0 a direction.
struct Lattice_eye {
  Whole at;
  std::int64_t w;
  Viewpoint view() const {
    if (w == 0) return {{Rational(at[0]), Rational(at[1]), Rational(at[2])}, true};
    Viewpoint v{{Rational(at[0], w), Rational(at[1], w), Rational(at[2], w)}, false};
    for (Rational& x : v.at) x.canonicalize();
    return v;
  }
};

/// Whether each node is on-view, by definition. Pre: the graph is of the body's soup.
inline std::vector<bool> on_view(const Face_graph& graph, const Body& body, const Lattice_eye& eye) {
  std::vector<bool> on(body.faces.size());
  for (std::uint32_t f = 0; f < on.size(); ++f) {
    const Whole n = body.normal(f), p = body.points[body.faces[f][0]];
    Wide height = 0;
    for (std::size_t k = 0; k < 3; ++k) height += Wide{n[k]} * (Wide{eye.at[k]} - Wide{eye.w} * p[k]);
    on[graph.node(f)] = height > 0;
  }
  return on;
}

/// The same for any graph, in rationals and from corners only.
inline std::vector<bool> on_view(const Face_graph& graph, const Viewpoint& view) {
  std::vector<bool> on(graph.size());
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const auto corners = graph.scene().corners(graph.scene().pieces()[graph.piece(i)]);
    const auto corner = [&](std::size_t k) { return graph.scene().position(corners[k].point); };
    Exact_point normal{0, 0, 0};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Exact_point p = corner(k), q = corner(k + 1 == corners.size() ? 0 : k + 1);
      for (std::size_t a = 0; a < 3; ++a)
        normal[a] += p[(a + 1) % 3] * q[(a + 2) % 3] - p[(a + 2) % 3] * q[(a + 1) % 3];
    }
    const Exact_point p = corner(0);
    Rational height = 0;
    for (std::size_t a = 0; a < 3; ++a)
      height += normal[a] * (view.at_infinity ? view.at[a] : Rational(view.at[a] - p[a]));
    on[i] = height > 0;
  }
  return on;
}

/// The edges whose ends differ.
inline std::vector<std::uint32_t> cut_of(const Face_graph& graph, const std::vector<bool>& on) {
  std::vector<std::uint32_t> cut;
  for (std::uint32_t e = 0; e < graph.edges().size(); ++e)
    if (on[graph.edges()[e].first] != on[graph.edges()[e].second]) cut.push_back(e);
  return cut;
}
inline std::vector<std::uint32_t> sorted(std::vector<std::uint32_t> list) {
  std::sort(list.begin(), list.end());
  return list;
}

/// Whether a tracker says of every node and edge what is true.
template <class Tracker>
bool agrees(const Tracker& tracker, const Face_graph& graph, const std::vector<bool>& on) {
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    if (tracker.on_view(i) != on[i]) return false;
  return sorted(tracker.cut_edges()) == cut_of(graph, on);
}

/// A scene with its graph and its traits.
struct Stage {
  Scene scene;
  Face_graph graph;
  Exact_traits traits;
  explicit Stage(const Polygon_soup& soup) : scene(soup), graph(scene), traits(scene) {}
};

/// An axis-parallel box.
inline Body box(const Whole& low, const Whole& high) {
  Body body;
  for (int k = 0; k < 8; ++k)
    body.points.push_back({k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]});
  body.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};  // -x +x -y +y -z +z
  return body;
}

}  // namespace cutset_test
