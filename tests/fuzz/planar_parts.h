#pragma once
// Convex parts and triangles of polygons with holes in the plane, against winding numbers as a checker finds them.

#include "soups.h"

#include <sightline/algorithms/verify/contour.h>
#include <sightline/kernel/scene/convex_parts.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <vector>

namespace fuzz {

using Corner_at = std::array<long, 2>;

inline long turn_of(const Corner_at& p, const Corner_at& q, const Corner_at& r) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}
inline long twice_area_of(const Outline& loop) {
  long area = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) area += turn_of({0, 0}, loop[k], loop[(k + 1) % loop.size()]);
  return area;
}

/// The kind of contour that the loops are, by the checker's own arrangement of edges.
inline Contour kind_of(const Outlines& outlines) {
  std::vector<certificate_check::Polygon> loops;
  for (Outline loop : outlines) {
    if (!loops.empty() && twice_area_of(loop) > 0) std::reverse(loop.begin(), loop.end());  // a hole
    certificate_check::Polygon& polygon = loops.emplace_back();
    for (const auto& [x, y] : loop) polygon.push_back({Rational(x), Rational(y), Rational(0)});
  }
  const certificate_check::Contour contour(loops, 2, false);
  using Winding = certificate_check::Contour::Winding;
  if (contour.crosses_itself() || contour.winding() == Winding::other) return Contour::self_intersecting;
  return contour.winding() == Winding::once ? Contour::simple : Contour::zero_area;
}

/// Where a point, given in quarters, is to a convex polygon: 1 inside, 0 on its boundary, -1 outside.
inline int location_in(const Outline& polygon, const Corner_at& quarters) {
  int least = 1;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner_at &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const long turn = turn_of({4 * p[0], 4 * p[1]}, {4 * q[0], 4 * q[1]}, quarters);
    least = std::min(least, turn > 0 ? 1 : turn < 0 ? -1 : 0);
  }
  return least;
}

inline void planar_parts(std::string_view bytes) {
  Random random(Bytes(bytes).word());
  Outlines outlines = any_outlines(random);
  // 1. Points, some of them several times; loops that begin anywhere, and rest at a corner now and then.
  std::map<Corner_at, std::vector<std::uint32_t>> ids;
  std::vector<Corner_at> at;
  for (Outline& loop : outlines) {
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size())), loop.end());
    if (random.chance(1, 4))
      loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size())), loop[0]);
    at.insert(at.end(), loop.begin(), loop.end());
  }
  std::vector<Planar_point> points;
  std::vector<std::size_t> order(at.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  random.shuffle(order);
  for (const std::size_t k : order) {
    const Corner_at& p = at[k];
    if (ids[p].empty() || random.chance(1, 4)) {
      ids[p].push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back({Integer(p[0]), Integer(p[1])});
    }
  }
  std::vector<std::vector<std::uint32_t>> loops;
  std::map<Corner_at, std::uint32_t> least;  // of those that loops use
  for (const Outline& outline : outlines) {
    std::vector<std::uint32_t>& loop = loops.emplace_back();
    for (const Corner_at& p : outline) {
      loop.push_back(ids[p][random.below(ids[p].size())]);
      const auto [place, is_new] = least.try_emplace(p, loop.back());
      place->second = std::min(place->second, loop.back());
    }
  }

  const Contour kind = kind_of(outlines);
  long area = 0;
  for (std::size_t k = 0; k < outlines.size(); ++k)
    area += k == 0 ? twice_area_of(outlines[0]) : -std::abs(twice_area_of(outlines[k]));
  for (const bool merged : {true, false}) {
    const Convex_parts found = merged ? convex_parts(points, loops) : triangles(points, loops);
    require(found.contour == kind, "a contour is of the kind that its winding numbers say");
    require((kind == Contour::simple) != found.pieces.empty(), "what is simple has parts, and nothing else has");
    // 2. Parts are convex, on the least of the points, and in order.
    std::vector<Outline> parts;
    for (const std::vector<std::uint32_t>& piece : found.pieces) {
      Outline& part = parts.emplace_back();
      for (const std::uint32_t p : piece) {
        const Corner_at corner{points[p].x.get_si(), points[p].y.get_si()};
        require(least.count(corner) > 0 && least[corner] == p, "a corner is the least index of its point");
        part.push_back(corner);
      }
      require(part.size() >= 3 && (merged || part.size() == 3), "a part has three corners, or more where it may");
      for (std::size_t k = 0; k < part.size(); ++k)
        require(turn_of(part[k], part[(k + 1) % part.size()], part[(k + 2) % part.size()]) > 0, "a part is convex");
      require(*std::min_element(piece.begin(), piece.end()) == piece[0], "a part begins with its least index");
      area -= twice_area_of(part);
      if (!merged)
        for (const auto& [p, index] : least)
          require(location_in(part, {4 * p[0], 4 * p[1]}) < 0 || std::count(part.begin(), part.end(), p) > 0,
                  "a point that touches a triangle is its corner");
    }
    require(std::is_sorted(found.pieces.begin(), found.pieces.end()), "parts are in order");
    if (kind == Contour::simple) require(area == 0, "parts have the area of the contour");
    for (const Outline& part : parts) area += twice_area_of(part);
    // 3. They lie apart.
    for (long x = 0; x <= 32; ++x)
      for (long y = 0; y <= 32; ++y) {
        std::size_t inside = 0, touched = 0;
        for (const Outline& part : parts) {
          const int location = location_in(part, {x, y});
          inside += location > 0;
          touched += location == 0;
        }
        require(inside == 0 || inside + touched == 1, "parts lie apart");
      }
  }
}

}  // namespace fuzz
