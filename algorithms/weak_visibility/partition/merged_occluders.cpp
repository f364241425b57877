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

/// Puts polygons of one plane together, whatever is convex then, along the edges that they share.
class Plane_merger {
 public:
  /// `loops` of the scene, of which `members` are in the plane. Both outlive it.
  Plane_merger(const Scene& scene, std::vector<Loop>& loops, const std::vector<std::size_t>& members)
      : scene_(scene), loops_(loops), open_(members) {
    for (const std::size_t p : members) enter(p, 0);
  }

  /// Of polygons that became one, all loops but one are empty then.
  void merge() {
    while (!open_.empty()) {
      grow(open_.back());
      open_.pop_back();
      while (!open_.empty() && loops_[open_.back()].empty()) open_.pop_back();
    }
  }

 private:
  /// A polygon that grows.
  struct Growing {
    std::size_t place;
    std::vector<bool> in_vain;  // edges where nothing can be joined while their corners stay
    bool has_all = false;       // whether it is on the left of all its edges
  };

  void grow(std::size_t place) {
    Growing grown{place, std::vector<bool>(loops_[place].size()), false};
    for (std::size_t i = 0; i < loops_[place].size();) {
      const bool is_tried = grown.in_vain[i];
      grown.in_vain[i] = true;
      i = is_tried ? i + 1 : join_beyond(grown, i) ? 0 : i;
    }
  }

  /// Joins what is beyond the edge from i to i + 1, if both are convex together.
  bool join_beyond(Growing& grown, std::size_t i) {
    // 1. Who is there.
    const std::size_t p = grown.place, n = loops_[p].size();
    const std::array<std::uint32_t, 2> back{loops_[p][(i + 1) % n], loops_[p][i]};
    const auto other = left_.find(back);
    if (other == left_.end() || other->second == p) return false;
    const std::size_t q = other->second;
    const auto j = static_cast<std::size_t>(std::find(loops_[q].begin(), loops_[q].end(), back[0]) - loops_[q].begin());
    const std::optional<std::array<bool, 2>> straight = straight_corners(scene_, loops_[p], i, loops_[q], j);
    if (!straight) return false;
    const auto [at_end, at_begin] = *straight;
    // 2. What is no edge any more.
    if (grown.has_all) {
      leave_edge(p, i);
      if (at_end) leave_edge(p, i + 1);
      if (at_begin) leave_edge(p, i + n - 1);
    } else {
      leave(p);
    }
    leave(q);
    // 3. Both as one, from the edge's end on.
    Loop both;
    std::vector<bool> in_vain;
    for (std::size_t k = 1; k <= n; ++k) {
      if ((k == 1 && at_end) || (k == n && at_begin)) continue;
      both.push_back(loops_[p][(i + k) % n]);
      in_vain.push_back(k > 1 && k + 1 < n && grown.in_vain[(i + k) % n]);
    }
    for (std::size_t k = 2; k < loops_[q].size(); ++k) both.push_back(loops_[q][(j + k) % loops_[q].size()]);
    in_vain.resize(both.size());
    loops_[q].clear();
    loops_[p] = std::move(both);
    grown.in_vain = std::move(in_vain);
    enter(p, grown.has_all ? n - 2 - at_end : 0);
    grown.has_all = true;
    return true;
  }

  std::array<std::uint32_t, 2> edge(std::size_t p, std::size_t i) const {
    return {loops_[p][i % loops_[p].size()], loops_[p][(i + 1) % loops_[p].size()]};
  }
  void enter(std::size_t p, std::size_t first) {
    for (std::size_t i = first; i < loops_[p].size(); ++i) left_[edge(p, i)] = p;
  }
  void leave_edge(std::size_t p, std::size_t i) {
    const auto at = left_.find(edge(p, i));
    if (at != left_.end() && at->second == p) left_.erase(at);
  }
  void leave(std::size_t p) {
    for (std::size_t i = 0; i < loops_[p].size(); ++i) leave_edge(p, i);
  }

  const Scene& scene_;
  std::vector<Loop>& loops_;
  std::vector<std::size_t> open_;
  std::map<std::array<std::uint32_t, 2>, std::size_t> left_;  // of edges; one of those on it where several overlap
};

/// The loops that are not empty, as faces.
Polygon_soup soup_of(const Scene& scene, const std::vector<Loop>& loops) {
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
  for (const auto& [plane, members] : by_plane) Plane_merger(scene, loops, members).merge();
  return soup_of(scene, loops);
}

}  // namespace sightline
