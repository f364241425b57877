#include <sightline/algorithms/levels/coarse.h>

#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/union_find.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace sightline {

namespace levels_detail {

/// Convex polyhedra that grow, each known by one of its cells.
class Region_merger {
 public:
  explicit Region_merger(const Level_cells& level)
      : level_(level), sets_(level.cells().size()), regions_(level.cells().size()) {
    for (std::uint32_t w = 0; w < level.walls().size(); ++w) add_wall(w);
    std::stable_sort(open_.begin(), open_.end(),
                     [&](std::uint32_t v, std::uint32_t w) { return areas_[v] > areas_[w]; });
  }

  /// Puts together what can be until `count` regions that are not solid are no more than `most`.
  void merge(std::size_t count, std::size_t most, const std::function<void(std::size_t, std::size_t)>& progress) {
    const std::size_t begun = count;
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (const std::uint32_t w : open_) {
        if (count <= most) return;
        if (progress) progress(begun - count, begun - most);
        const Cell_id a = region_of(level_.walls()[w].front), b = region_of(level_.walls()[w].behind);
        const std::uint32_t plane = sides_[w].first;
        if (a == b || !fits(a, b, plane) || !fits(b, a, plane) || is_covered(a, b)) continue;
        put_together(a, b, plane);
        --count;
        goes_on = true;
      }
    }
  }

  /// The least of the cells that it is together with.
  Cell_id region_of(Cell_id c) { return sets_.find(c); }

 private:
  /// A plane, and whether it is positive where the region is.
  using Side = std::pair<std::uint32_t, bool>;
  struct Region {
    std::set<std::uint32_t> corners;  // points of the level; some may be in the inside of sides
    std::set<Side> sides;
    std::vector<std::uint32_t> covered;  // walls, in part at least
  };

  void add_wall(std::uint32_t w) {
    // 1. Its plane, by one name whatever its front, and its area, squared and times four.
    const Cell_wall& wall = level_.walls()[w];
    const std::vector<Exact_point> corners = level_.polygon(wall.corners);
    const Exact_plane own = exact_plane(corners);
    const Exact_point normal{own[0], own[1], own[2]};
    areas_.push_back(dot(normal, normal));
    const auto [plane, is_turned] = unoriented(own);
    const auto [at, is_new] = ids_.try_emplace(plane, static_cast<std::uint32_t>(planes_.size()));
    if (is_new) planes_.push_back(plane);
    sides_.emplace_back(at->second, !is_turned);

    // 2. What it is to its cells.
    const bool is_inner =
        wall.behind != no_cell && !level_.cells()[wall.front].is_solid && !level_.cells()[wall.behind].is_solid;
    const bool is_open = wall.faces_front.empty() && wall.faces_behind.empty();
    if (is_inner && is_open) open_.push_back(w);
    for (const Cell_id cell : {wall.front, wall.behind}) {
      if (cell == no_cell) continue;
      Region& region = regions_[cell];
      region.corners.insert(wall.corners.begin(), wall.corners.end());
      region.sides.insert({at->second, is_turned != (cell == wall.front)});
      if (is_inner && !is_open) region.covered.push_back(w);
    }
  }

  /// Whether a region is within all planes of another one, but for one.
  bool fits(Cell_id a, Cell_id other, std::uint32_t but) const {
    for (const auto& [plane, is_positive] : regions_[other].sides) {
      if (plane == but) continue;
      for (const std::uint32_t corner : regions_[a].corners) {
        const int side = sgn(exact_height(planes_[plane], level_.points()[corner]));
        if (is_positive ? side < 0 : side > 0) return false;
      }
    }
    return true;
  }

  /// Whether a face covers some of what two regions have in common.
  bool is_covered(Cell_id a, Cell_id b) {
    return std::any_of(regions_[a].covered.begin(), regions_[a].covered.end(), [&](std::uint32_t w) {
      return region_of(level_.walls()[w].front) == b || region_of(level_.walls()[w].behind) == b;
    });
  }

  void put_together(Cell_id a, Cell_id b, std::uint32_t between) {
    Region& one = regions_[std::min(a, b)];
    Region& other = regions_[std::max(a, b)];
    one.corners.merge(other.corners);
    one.sides.merge(other.sides);
    for (const bool is_positive : {false, true}) one.sides.erase({between, is_positive});
    one.covered.insert(one.covered.end(), other.covered.begin(), other.covered.end());
    other = {};
    sets_.join(a, b);
  }

  const Level_cells& level_;
  Union_find sets_;
  std::vector<Region> regions_;  // by the least of their cells
  std::map<Exact_plane, std::uint32_t> ids_;
  std::vector<Exact_plane> planes_;
  std::vector<Side> sides_;          // by wall: of the cell in front
  std::vector<Rational> areas_;      // by wall
  std::vector<std::uint32_t> open_;  // walls that no face covers some of, the largest first
};

}  // namespace levels_detail

std::vector<std::uint32_t> convex_regions(const Level_cells& level, std::size_t most,
                                          const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::vector<Level_cell>& cells = level.cells();
  levels_detail::Region_merger merger(level);
  merger.merge(cells.size() - level.counters().solid, most, progress);
  std::vector<std::uint32_t> numbers(cells.size(), no_cell);
  std::uint32_t next = 0;
  for (Cell_id c = 0; c < cells.size(); ++c) {
    if (cells[c].is_solid) continue;
    const Cell_id first = merger.region_of(c);  // the least of its cells
    numbers[c] = first == c ? next++ : numbers[first];
  }
  return numbers;
}

}  // namespace sightline
