#pragma once
// Slow and independent answers about planar polygons, in rational arithmetic.

#include <sightline/kernel/scene/convex_parts.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace oracle {

using sightline::Contour;
using sightline::Convex_parts;
using sightline::Integer;
using sightline::Planar_point;
using sightline::Rational;
using Loop = std::vector<std::uint32_t>;

struct Polygon {
  std::vector<Planar_point> points;
  std::vector<Loop> loops;
};

// What is tested.
inline Convex_parts parts_of(const Polygon& p) { return sightline::convex_parts(p.points, p.loops); }
inline Convex_parts triangles_of(const Polygon& p) { return sightline::triangles(p.points, p.loops); }

struct Sample {
  Rational x, y;
};

inline Integer cross(const Planar_point& a, const Planar_point& b, const Planar_point& c) {
  return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

inline Integer twice_area(const std::vector<Planar_point>& points, const Loop& loop) {
  Integer sum = 0;
  for (std::size_t i = 2; i < loop.size(); ++i) sum += cross(points[loop[0]], points[loop[i - 1]], points[loop[i]]);
  return sum;
}

/// The loops as the semantics orients them: holes clockwise.
inline std::vector<Loop> oriented(const Polygon& polygon) {
  std::vector<Loop> loops = polygon.loops;
  for (std::size_t k = 1; k < loops.size(); ++k)
    if (twice_area(polygon.points, loops[k]) > 0) loops[k] = Loop(loops[k].rbegin(), loops[k].rend());
  return loops;
}

inline Integer twice_area(const Polygon& polygon) {
  Integer sum = 0;
  for (const Loop& loop : oriented(polygon)) sum += twice_area(polygon.points, loop);
  return sum;
}

/// Winding number of the oriented loops round a point that is on none of their edges, by a ray to the right.
inline int winding(const Polygon& polygon, const Sample& s) {
  int number = 0;
  for (const Loop& loop : oriented(polygon))
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Planar_point &a = polygon.points[loop[i]], &b = polygon.points[loop[(i + 1) % loop.size()]];
      const bool a_below = a.y <= s.y, b_below = b.y <= s.y;
      if (a_below == b_below) continue;
      const Rational x = a.x + (s.y - a.y) * Rational(b.x - a.x) / Rational(b.y - a.y);
      if (x > s.x) number += a_below ? 1 : -1;
    }
  return number;
}

inline bool strictly_crosses(const Planar_point& a, const Planar_point& b, const Planar_point& c,
                             const Planar_point& d) {
  return sgn(cross(a, b, c)) * sgn(cross(a, b, d)) < 0 && sgn(cross(c, d, a)) * sgn(cross(c, d, b)) < 0;
}

/// The contour's kind by the definition: all pairs of edges, and the winding number on both sides of every edge between
/// consecutive points. Pre: coordinates small against 10^4 (for the distance of the samples).
inline Contour contour(const Polygon& polygon) {
  std::vector<std::pair<Planar_point, Planar_point>> edges;
  for (const Loop& loop : polygon.loops)
    for (std::size_t i = 0; i < loop.size(); ++i)
      edges.emplace_back(polygon.points[loop[i]], polygon.points[loop[(i + 1) % loop.size()]]);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size(); ++j)
      if (strictly_crosses(edges[i].first, edges[i].second, edges[j].first, edges[j].second)) {
        bool at_a_point = false;  // of a loop
        for (const Loop& loop : polygon.loops)
          for (const std::uint32_t p : loop)
            at_a_point = at_a_point || (cross(edges[i].first, edges[i].second, polygon.points[p]) == 0 &&
                                        cross(edges[j].first, edges[j].second, polygon.points[p]) == 0);
        if (!at_a_point) return Contour::self_intersecting;
      }
  bool area = false;
  for (const auto& [a, b] : edges) {
    const Integer dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
    if (length == 0) continue;
    std::set<Rational> cuts{0, 1};
    for (const Loop& loop : polygon.loops)
      for (const std::uint32_t p : loop) {
        const Planar_point& q = polygon.points[p];
        Rational t((q.x - a.x) * dx + (q.y - a.y) * dy, length);
        t.canonicalize();
        if (cross(a, b, q) == 0 && t > 0 && t < 1) cuts.insert(t);
      }
    for (auto cut = cuts.begin(); std::next(cut) != cuts.end(); ++cut) {
      const Rational t = (*cut + *std::next(cut)) / 2;
      for (const int side : {-1, 1}) {
        const Rational small = Rational(side, 1000000000);
        const int number = winding(polygon, {a.x + t * dx - small * dy, a.y + t * dy + small * dx});
        if (number != 0 && number != 1) return Contour::self_intersecting;
        area = area || number == 1;
      }
    }
  }
  return area ? Contour::simple : Contour::zero_area;
}

/// Whether some side of a has all of b on its right: then the interiors of two convex polygons are disjoint.
inline bool separates(const std::vector<Planar_point>& points, const Loop& a, const Loop& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    bool all = true;
    for (const std::uint32_t p : b) all = all && cross(points[a[i]], points[a[(i + 1) % a.size()]], points[p]) <= 0;
    if (all) return true;
  }
  return false;
}

/// What must hold of any partition of a simple contour; `exhaustive` adds the checks of quadratic cost.
inline ::testing::AssertionResult is_partition(const Polygon& polygon, const Convex_parts& parts, bool strict_corners,
                                               bool exhaustive) {
  const auto fail = [] { return ::testing::AssertionFailure(); };
  if (parts.contour != Contour::simple) return fail() << "not simple";
  std::set<std::uint32_t> used;
  for (const Loop& loop : polygon.loops) used.insert(loop.begin(), loop.end());
  Integer sum = 0;
  for (std::size_t k = 0; k < parts.pieces.size(); ++k) {
    const Loop& piece = parts.pieces[k];
    const std::size_t n = piece.size();
    if (n < 3) return fail() << "piece " << k << " has " << n << " corners";
    const Integer area = twice_area(polygon.points, piece);
    if (area <= 0) return fail() << "piece " << k << " is not counterclockwise";
    sum += area;
    for (std::size_t i = 0; i < n; ++i) {
      if (!used.count(piece[i])) return fail() << "piece " << k << " uses a point of no loop";
      const Planar_point &a = polygon.points[piece[i]], &b = polygon.points[piece[(i + 1) % n]],
                         &c = polygon.points[piece[(i + 2) % n]];
      if (cross(a, b, c) <= 0 && strict_corners) return fail() << "piece " << k << " is not strictly convex";
      // Not wound twice: all triangles of the fan are counterclockwise.
      if (i > 0 && i + 1 < n && cross(polygon.points[piece[0]], a, b) <= 0)
        return fail() << "piece " << k << " winds twice";
    }
    if (exhaustive)
      for (std::size_t i = 2; i < n; ++i) {
        Sample s;
        for (const std::uint32_t p : {piece[0], piece[i - 1], piece[i]}) {
          s.x += polygon.points[p].x;
          s.y += polygon.points[p].y;
        }
        s.x /= 3;
        s.y /= 3;
        if (winding(polygon, s) != 1) return fail() << "piece " << k << " is not inside";
      }
    if (exhaustive)
      for (std::size_t j = 0; j < k; ++j)
        if (!separates(polygon.points, piece, parts.pieces[j]) && !separates(polygon.points, parts.pieces[j], piece))
          return fail() << "pieces " << j << " and " << k << " overlap";
  }
  if (sum != twice_area(polygon)) return fail() << "area " << sum << " instead of " << twice_area(polygon);
  return ::testing::AssertionSuccess();
}

}  // namespace oracle
