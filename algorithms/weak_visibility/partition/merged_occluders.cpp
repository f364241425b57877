#include <sightline/algorithms/weak_visibility/partition/merged_occluders.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sightline {
namespace {

using Loop = std::vector<std::uint32_t>;  // points of the scene, counterclockwise about the plane's normal

/// Two polygons on both sides of an edge as one, where that is convex: the first with the edge from i to i + 1, the
/// second with the same edge backwards, from j to j + 1. Straight corners are left out.
std::optional<Loop> joined_loop(const Scene& scene, const Loop& a, std::size_t i, const Loop& b, std::size_t j) {
  Loop loop;
  for (std::size_t k = 1; k <= a.size(); ++k) loop.push_back(a[(i + k) % a.size()]);
  for (std::size_t k = 2; k < b.size(); ++k) loop.push_back(b[(j + k) % b.size()]);
  // The corners where they meet: loop[0], which both end at, and loop[a.size() - 1].
  const Exact_point normal =
      cross(minus(scene.position(a[1]), scene.position(a[0])), minus(scene.position(a[2]), scene.position(a[0])));
  std::vector<std::size_t> straight;
  for (const std::size_t k : {std::size_t{0}, a.size() - 1}) {
    const Exact_point at = scene.position(loop[k]), before = scene.position(loop[(k + loop.size() - 1) % loop.size()]),
                      after = scene.position(loop[(k + 1) % loop.size()]);
    const int turn = sgn(dot(normal, cross(minus(at, before), minus(after, at))));
    if (turn < 0) return std::nullopt;
    if (turn == 0) straight.push_back(k);
  }
  while (!straight.empty()) {
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(straight.back()));
    straight.pop_back();
  }
  return loop;
}

}  // namespace

Polygon_soup merged_pieces(const Scene& scene) {
  std::vector<Loop> loops;
  std::map<std::uint32_t, std::vector<std::size_t>> by_plane;
  for (const Piece& piece : scene.pieces()) {
    Loop loop;
    for (const Piece_corner& corner : scene.corners(piece)) loop.push_back(corner.point);
    if (piece.support.flipped()) std::reverse(loop.begin(), loop.end());
    by_plane[piece.support.id()].push_back(loops.size());
    loops.push_back(std::move(loop));
  }
  for (const auto& [plane, members] : by_plane) {
    // Each edge with the polygon on its left; one of them where several overlap.
    std::map<std::array<std::uint32_t, 2>, std::size_t> left;
    const auto enter = [&](std::size_t p) {
      for (std::size_t i = 0; i < loops[p].size(); ++i) left[{loops[p][i], loops[p][(i + 1) % loops[p].size()]}] = p;
    };
    const auto leave = [&](std::size_t p) {
      for (std::size_t i = 0; i < loops[p].size(); ++i) {
        const auto at = left.find({loops[p][i], loops[p][(i + 1) % loops[p].size()]});
        if (at != left.end() && at->second == p) left.erase(at);
      }
    };
    for (const std::size_t p : members) enter(p);
    std::vector<std::size_t> open = members;
    while (!open.empty()) {
      const std::size_t p = open.back();
      bool merged = false;
      for (std::size_t i = 0; i < loops[p].size() && !merged; ++i) {
        const std::array<std::uint32_t, 2> back{loops[p][(i + 1) % loops[p].size()], loops[p][i]};
        const auto other = left.find(back);
        if (other == left.end() || other->second == p) continue;
        const std::size_t q = other->second;
        const auto j =
            static_cast<std::size_t>(std::find(loops[q].begin(), loops[q].end(), back[0]) - loops[q].begin());
        std::optional<Loop> both = joined_loop(scene, loops[p], i, loops[q], j);
        if (!both) continue;
        leave(p);
        leave(q);
        loops[q].clear();
        loops[p] = std::move(*both);
        enter(p);
        merged = true;
      }
      if (!merged) {
        open.pop_back();
        while (!open.empty() && loops[open.back()].empty()) open.pop_back();
      }
    }
  }
  Polygon_soup soup;
  soup.file = scene.file();
  std::map<std::uint32_t, Point_id> ids;
  for (const Loop& loop : loops) {
    if (loop.empty()) continue;
    std::vector<Point_id> face;
    for (const std::uint32_t point : loop) {
      const auto [at, is_new] = ids.try_emplace(point, 0);
      if (is_new) {
        const Exact_point p = scene.position(point);
        at->second = soup.add_point(p[0], p[1], p[2]);
      }
      face.push_back(at->second);
    }
    soup.add_face(face);
  }
  return soup;
}

}  // namespace sightline
