#include <sightline/algorithms/point_visibility/scene_edges.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <span>
#include <tuple>
#include <utility>

namespace sightline {

namespace {

/// What a piece bounds of a line.
struct Side {
  std::uint32_t p, q;  ///< p < q
  std::uint32_t piece;
  std::uint32_t edge;  ///< its plane's id: those of a face in one plane are on one line iff it is the same

  bool has_ends_of(const Side& other) const { return p == other.p && q == other.q; }
};

bool comes_before(const Side& a, const Side& b) { return std::tie(a.p, a.q, a.piece) < std::tie(b.p, b.q, b.piece); }

void add_sides(const Scene& scene, std::uint32_t piece, std::vector<Side>& found) {
  const std::span<const Piece_corner> corners = scene.corners(scene.pieces()[piece]);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto [p, q] = std::minmax(corners[k].point, corners[k + 1 == corners.size() ? 0 : k + 1].point);
    found.push_back({p, q, piece, corners[k].edge.id()});
  }
}

/// Sides on one line, of pieces of one face in one plane: what is of two pieces, one on either side, is inside the
/// face.
void add_bounds(const Scene& scene, std::span<const Side> sides, std::vector<Side>& found) {
  if (sides.size() == 1) {
    found.push_back(sides[0]);
    return;
  }
  // 1. The line's points, from end to end, each with the pieces at the stretch that begins there.
  struct Stretch {
    std::uint32_t from;
    std::vector<std::uint32_t> pieces;
  };
  std::map<std::array<Integer, 3>, Stretch> stretches;
  const auto place = [&](std::uint32_t p) {
    return std::array<Integer, 3>{scene.points().integer(p, 0), scene.points().integer(p, 1),
                                  scene.points().integer(p, 2)};
  };
  for (const Side& side : sides)
    for (const std::uint32_t p : {side.p, side.q}) stretches.emplace(place(p), Stretch{p, {}});
  for (const Side& side : sides) {
    const std::array<Integer, 3> p = place(side.p), q = place(side.q);
    for (auto at = stretches.find(std::min(p, q)); at->first != std::max(p, q); ++at)
      at->second.pieces.push_back(side.piece);
  }
  // 2. What is not of two.
  for (auto at = stretches.begin(); at != stretches.end(); ++at) {
    const std::vector<std::uint32_t>& pieces = at->second.pieces;
    if (pieces.empty()) continue;
    if (pieces.size() == 2) continue;
    const auto [p, q] = std::minmax(at->second.from, std::next(at)->second.from);
    for (const std::uint32_t piece : pieces) found.push_back({p, q, piece, sides[0].edge});
  }
}

/// What the pieces of a face, which has several, bound together: all of their sides, but for what two of them share.
void add_bounds_of_face(const Scene& scene, std::span<const Piece> pieces, std::uint32_t first,
                        std::vector<Side>& found) {
  std::vector<Side> sides, left;
  for (std::uint32_t k = 0; k < pieces.size(); ++k) add_sides(scene, first + k, sides);
  // 1. Sides that are the same. A surface of several planes is triangles of all corners: they share nothing else.
  std::sort(sides.begin(), sides.end(), comes_before);
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t next = k + 1;
    while (next < sides.size() && sides[next].has_ends_of(sides[k])) ++next;
    if (next != k + 2) left.insert(left.end(), &sides[k], &sides[k] + (next - k));
    k = next;
  }
  const auto is_in_one_plane = [&](const Piece& piece) { return piece.support.id() == pieces[0].support.id(); };
  if (!std::all_of(pieces.begin(), pieces.end(), is_in_one_plane)) {
    found.insert(found.end(), left.begin(), left.end());
    return;
  }
  // 2. In one plane, such as a corner of the face parts on one side of it only.
  std::stable_sort(left.begin(), left.end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
  for (std::size_t k = 0; k < left.size();) {
    std::size_t next = k + 1;
    while (next < left.size() && left[next].edge == left[k].edge) ++next;
    add_bounds(scene, std::span(left).subspan(k, next - k), found);
    k = next;
  }
}

}  // namespace

std::vector<Scene_edge> scene_edges(const Scene& scene) {
  const std::span<const Piece> pieces = scene.pieces();
  std::vector<Side> sides;
  for (std::uint32_t first = 0; first < pieces.size();) {
    std::uint32_t end = first + 1;
    while (end < pieces.size() && pieces[end].face == pieces[first].face) ++end;
    if (end - first == 1) add_sides(scene, first, sides);
    else add_bounds_of_face(scene, pieces.subspan(first, end - first), first, sides);
    first = end;
  }
  std::sort(sides.begin(), sides.end(), comes_before);
  std::vector<Scene_edge> edges;
  for (const Side& side : sides) {
    if (edges.empty() || edges.back().p != side.p || edges.back().q != side.q) edges.push_back({side.p, side.q, {}});
    edges.back().pieces.push_back(side.piece);
  }
  return edges;
}

}  // namespace sightline
