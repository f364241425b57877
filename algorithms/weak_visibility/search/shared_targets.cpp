#include <sightline/algorithms/weak_visibility/search/shared_targets.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <cstddef>
#include <unordered_set>
#include <utility>

namespace sightline {
namespace {

/// Calls visit(other) for the pieces in the same oriented plane that have a corner in common, itself too, until one is
/// accepted; a piece may come again.
template <class Visit>
bool any_neighbour_in_plane(const Occluders& occluders, std::uint32_t piece, const Visit& visit) {
  const Scene& scene = occluders.scene();
  const std::vector<Piece>& pieces = scene.pieces();
  for (const Piece_corner& corner : scene.corners(pieces[piece]))
    for (const std::uint32_t other : occluders.pieces_at(corner.point))
      if (pieces[other].support == pieces[piece].support && visit(other)) return true;
  return false;
}

/// A piece's plane seen along an axis that it is not parallel to: two coordinates, in an order in which what is
/// counterclockwise from the front is so here.
struct Flat_view {
  std::size_t across, upwards;

  explicit Flat_view(const Near_plane& plane) {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (mpz_cmpabs(plane.exact[k].get_mpz_t(), plane.exact[axis].get_mpz_t()) > 0) axis = k;
    across = (axis + 1) % 3;
    upwards = (axis + 2) % 3;
    if (sgn(plane.exact[axis]) < 0) std::swap(across, upwards);
  }
  /// 1 where c, in homogeneous coordinates, is to the left of the way from a to b. Exact: yes.
  int turn(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b, const std::array<Integer, 4>& c) const {
    return sgn(Integer((b[across] - a[across]) * (c[upwards] - c[3] * a[upwards]) -
                       (b[upwards] - a[upwards]) * (c[across] - c[3] * a[across])));
  }
  int turn(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b, const std::array<Integer, 3>& c) const {
    return turn(a, b, std::array<Integer, 4>{c[0], c[1], c[2], Integer(1)});
  }
};

}  // namespace

bool has_neighbour_in_plane(const Occluders& occluders, std::uint32_t piece) {
  return any_neighbour_in_plane(occluders, piece, [&](std::uint32_t other) { return other != piece; });
}

std::vector<Targets> hanging_together(const Occluders& occluders, std::span<const std::uint32_t> pieces) {
  std::unordered_set<std::uint32_t> left(pieces.begin(), pieces.end());
  std::vector<Targets> found;
  for (const std::uint32_t first : pieces) {
    if (left.erase(first) == 0) continue;
    Targets group{first};
    for (std::size_t k = 0; k < group.size(); ++k)
      any_neighbour_in_plane(occluders, group[k], [&](std::uint32_t other) {
        if (left.erase(other) > 0) group.push_back(other);
        return false;
      });
    if (group.size() < 2) continue;
    std::sort(group.begin(), group.end());
    found.push_back(std::move(group));
  }
  return found;
}

std::array<Targets, 2> halves(const Occluders& occluders, std::span<const std::uint32_t> pieces) {
  std::vector<std::pair<Triple, std::uint32_t>> middles;
  for (const std::uint32_t piece : pieces) {
    const std::span<const Triple> corners = occluders.corners(piece);
    Triple middle{};
    for (const Triple& corner : corners)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += corner[k] / static_cast<double>(corners.size());
    middles.push_back({middle, piece});
  }
  std::size_t axis = 0;
  double longest = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [least, most] = std::minmax_element(
        middles.begin(), middles.end(), [k](const auto& a, const auto& b) { return a.first[k] < b.first[k]; });
    const double length = most->first[k] - least->first[k];
    if (length > longest) {
      longest = length;
      axis = k;
    }
  }
  std::sort(middles.begin(), middles.end(), [axis](const auto& a, const auto& b) {
    return std::pair(a.first[axis], a.second) < std::pair(b.first[axis], b.second);
  });
  std::array<Targets, 2> parts;
  for (std::size_t i = 0; i < middles.size(); ++i) parts[2 * i < middles.size() ? 0 : 1].push_back(middles[i].second);
  for (Targets& part : parts) std::sort(part.begin(), part.end());
  return parts;
}

Near_polygon polygon_around(const Occluders& occluders, std::span<const std::uint32_t> pieces) {
  const Scene& scene = occluders.scene();
  const Flat_view view(occluders.plane(pieces[0]));
  struct Corner {
    std::array<Integer, 3> at;
    std::uint32_t point;
  };
  // 1. All corners, each once, from one end to the other.
  std::vector<std::uint32_t> points;
  for (const std::uint32_t piece : pieces)
    for (const Piece_corner& corner : scene.corners(scene.pieces()[piece])) points.push_back(corner.point);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Corner> corners;
  for (const std::uint32_t point : points) corners.push_back({occluders.grid_point(point), point});
  std::sort(corners.begin(), corners.end(), [&](const Corner& a, const Corner& b) {
    const int order = cmp(a.at[view.across], b.at[view.across]);
    return order != 0 ? order < 0 : a.at[view.upwards] < b.at[view.upwards];
  });
  // 2. The lower chain, then the upper one.
  std::vector<const Corner*> hull;
  for (const bool upper : {false, true}) {
    const std::size_t begin = hull.size();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Corner& next = corners[upper ? corners.size() - 1 - k : k];
      while (hull.size() >= begin + 2 && view.turn(hull[hull.size() - 2]->at, hull.back()->at, next.at) <= 0)
        hull.pop_back();
      hull.push_back(&next);
    }
    hull.pop_back();  // the other chain begins with it
  }
  Near_polygon polygon;
  for (const Corner* corner : hull)
    polygon.push_back({{corner->at[0], corner->at[1], corner->at[2], Integer(1)},
                       occluders.near_point_of(corner->point),
                       occluders.rest_of(corner->point)});
  return polygon;
}

bool has_inside(const Occluders& occluders, std::uint32_t piece, const Near_point& point) {
  const Flat_view view(occluders.plane(piece));
  for (std::size_t e = 0; e < occluders.size(piece); ++e) {
    const std::array<std::uint32_t, 2> edge = occluders.edge_points(piece, e);
    if (view.turn(occluders.grid_point(edge[0]), occluders.grid_point(edge[1]), point.exact) <= 0) return false;
  }
  return true;
}

}  // namespace sightline
