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

/// Whether two polygons on both sides of an edge are convex together: the first with the edge from i to i + 1, the
/// second with the same edge backwards, from j to j + 1; and whether the corners at its end and at its beginning are
/// straight then.
std::optional<std::array<bool, 2>> straight_corners(const Scene& scene, const Loop& a, std::size_t i, const Loop& b,
                                                    std::size_t j) {
  const auto of_a = [&](std::size_t k) { return scene.position(a[(i + k) % a.size()]); };
  const auto of_b = [&](std::size_t k) { return scene.position(b[(j + k) % b.size()]); };
  const Exact_point normal =
      cross(minus(scene.position(a[1]), scene.position(a[0])), minus(scene.position(a[2]), scene.position(a[0])));
  const auto turn = [&](const Exact_point& before, const Exact_point& at, const Exact_point& after) {
    return sgn(dot(normal, cross(minus(at, before), minus(after, at))));
  };
  const int at_end = turn(of_b(b.size() - 1), of_a(1), of_a(2)), at_begin = turn(of_a(a.size() - 1), of_a(0), of_b(2));
  if (at_end < 0 || at_begin < 0) return std::nullopt;
  return std::array{at_end == 0, at_begin == 0};
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
    const auto enter = [&](std::size_t p, std::size_t first) {
      for (std::size_t i = first; i < loops[p].size(); ++i)
        left[{loops[p][i], loops[p][(i + 1) % loops[p].size()]}] = p;
    };
    const auto leave_edge = [&](std::size_t p, std::size_t i) {
      const auto at = left.find({loops[p][i % loops[p].size()], loops[p][(i + 1) % loops[p].size()]});
      if (at != left.end() && at->second == p) left.erase(at);
    };
    const auto leave = [&](std::size_t p) {
      for (std::size_t i = 0; i < loops[p].size(); ++i) leave_edge(p, i);
    };
    for (const std::size_t p : members) enter(p, 0);
    std::vector<std::size_t> open = members;
    while (!open.empty()) {
      const std::size_t p = open.back();
      std::vector<bool> in_vain(loops[p].size());  // edges where nothing can be joined while their corners stay
      bool has_all = false;                        // whether it is on the left of all its edges
      for (std::size_t i = 0; i < loops[p].size();) {
        if (in_vain[i]) {
          ++i;
          continue;
        }
        in_vain[i] = true;
        const std::array<std::uint32_t, 2> back{loops[p][(i + 1) % loops[p].size()], loops[p][i]};
        const auto other = left.find(back);
        if (other == left.end() || other->second == p) continue;
        const std::size_t q = other->second, n = loops[p].size();
        const auto j =
            static_cast<std::size_t>(std::find(loops[q].begin(), loops[q].end(), back[0]) - loops[q].begin());
        const std::optional<std::array<bool, 2>> straight = straight_corners(scene, loops[p], i, loops[q], j);
        if (!straight) continue;
        // What is no edge any more.
        const auto [at_end, at_begin] = *straight;
        if (has_all) {
          leave_edge(p, i);
          if (at_end) leave_edge(p, i + 1);
          if (at_begin) leave_edge(p, i + n - 1);
        } else {
          leave(p);
        }
        leave(q);
        // Both as one, from the edge's end on.
        Loop both;
        std::vector<bool> still_in_vain;
        for (std::size_t k = 1; k <= n; ++k) {
          if ((k == 1 && at_end) || (k == n && at_begin)) continue;
          both.push_back(loops[p][(i + k) % n]);
          still_in_vain.push_back(k > 1 && k + 1 < n && in_vain[(i + k) % n]);
        }
        for (std::size_t k = 2; k < loops[q].size(); ++k) both.push_back(loops[q][(j + k) % loops[q].size()]);
        still_in_vain.resize(both.size());
        loops[q].clear();
        loops[p] = std::move(both);
        in_vain = std::move(still_in_vain);
        enter(p, has_all ? n - 2 - at_end : 0);
        has_all = true;
        i = 0;
      }
      open.pop_back();
      while (!open.empty() && loops[open.back()].empty()) open.pop_back();
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
