#pragma once
// Scenes made by people: towns, houses, and lattices of cells.

#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace sightline::generate {

/// The points of a lattice of axis-parallel planes, each added to the soup when it is first used.
class Lattice_points {
 public:
  Lattice_points(Polygon_soup& soup, std::array<std::vector<double>, 3> planes)
      : soup_(soup),
        planes_(std::move(planes)),
        ids_(planes_[0].size() * planes_[1].size() * planes_[2].size(), absent) {}

  /// Adds the rectangle at lattice place p, so many cells wide and high, whose front looks along +axis or -axis.
  void add_wall(std::array<std::size_t, 3> p, std::size_t axis, bool positive, std::size_t width = 1,
                std::size_t height = 1);

  /// Adds the boundary of a union of cells, each wall between a full and an empty cell once, its front to the empty
  /// side. Post: closed: every directed edge occurs as often as its opposite.
  template <class Is_solid>
  void add_boundary(Is_solid is_solid) {
    for_each_wall(is_solid, [&](const std::array<std::size_t, 3>& p, std::size_t axis, bool positive) {
      add_wall(p, axis, positive);
    });
  }

  /// The same boundary in larger rectangles: from its first corner each grows along one axis as far as it can, then
  /// along the other. Post: closed as point sets are: rectangles meet in T-junctions.
  template <class Is_solid>
  void add_merged_boundary(Is_solid is_solid) {
    // By axis, plane, sense: (c, b).
    std::map<std::tuple<std::size_t, std::size_t, bool>, std::set<std::pair<std::size_t, std::size_t>>> walls;
    for_each_wall(is_solid, [&](const std::array<std::size_t, 3>& p, std::size_t axis, bool positive) {
      walls[{axis, p[axis], positive}].emplace(p[(axis + 2) % 3], p[(axis + 1) % 3]);
    });
    for (auto& entry : walls) {
      auto& cells = entry.second;
      const auto [axis, plane, positive] = entry.first;
      while (!cells.empty()) {
        const auto [c, b] = *cells.begin();
        std::size_t width = 1, height = 1;
        while (cells.count({c, b + width})) ++width;
        const auto whole_row = [&, c = c, b = b](std::size_t row) {
          for (std::size_t k = 0; k < width; ++k)
            if (!cells.count({c + row, b + k})) return false;
          return true;
        };
        while (whole_row(height)) ++height;
        for (std::size_t row = 0; row < height; ++row)
          for (std::size_t k = 0; k < width; ++k) cells.erase({c + row, b + k});
        std::array<std::size_t, 3> p;
        p[axis] = plane;
        p[(axis + 1) % 3] = b;
        p[(axis + 2) % 3] = c;
        add_wall(p, axis, positive, width, height);
      }
    }
  }

 private:
  /// Calls f(place, axis, positive) for each wall between a full and an empty cell.
  template <class Is_solid, class Function>
  void for_each_wall(Is_solid is_solid, Function f);

  static constexpr Point_id absent = std::numeric_limits<Point_id>::max();
  Point_id id(const std::array<std::size_t, 3>& p);
  Polygon_soup& soup_;
  std::array<std::vector<double>, 3> planes_;
  std::vector<Point_id> ids_;
};

/// The planes 0, 1, ..., n.
std::vector<double> unit_planes(std::size_t n);

/// All 3 n^2 (n + 1) walls of n x n x n unit cells, each a quad of its own whose front looks along its positive axis:
/// many coplanar faces, up to twelve of them in a point, and no view from one cell into another.
Polygon_soup grid(std::size_t n);

/// 3 (n + 1) squares, each across the whole cube of n x n x n unit cells: a partition cuts them into the walls of
/// grid(n), and nearly every test of a vertex against a plane is an incidence. Pre: n <= 10^7; what asks for the
/// crossings has n^2 lines of them.
Polygon_soup lattice(std::size_t n);

/// The boundary of the Menger sponge of a level: 2 20^level + 4 8^level unit quads, fronts outwards, coordinates 0 ..
/// 3^level. `merged`: in fewer, larger rectangles that meet in T-junctions. Post: closed; some edges have four faces.
/// Pre: level <= 5.
Polygon_soup menger_sponge(std::size_t level, bool merged = false);

/// A town: disjoint boxes of random height on the plane z = 0, one in each unit cell of a square lattice in random
/// order, moved and sized at random; 5 faces each (no bottom), fronts outwards, and the ground, one face, last.
/// `rotated` turns each box about its vertical axis by a random rational rotation (from a Pythagorean triple), else all
/// are axis-parallel. Post: 5 boxes + 1 faces; coordinates are multiples of 1/1024, where rotated of 1/(1024 25 13 17
/// 29).
Polygon_soup city(std::size_t boxes, std::uint64_t seed, bool rotated = false);

/// A house of nx x ny rooms on one floor: walls, floor and ceiling with thickness, doors (a random spanning tree, so
/// that every room can be reached, some more, and one to the outside), windows, and a few boxes of furniture, all one
/// solid of lattice cells. A room is five cells wide, of random widths for each row of rooms. Coordinates are multiples
/// of 1/64 m. Post: closed: every directed edge occurs as often as its opposite; fronts look into the air.
Polygon_soup rooms(std::size_t nx, std::size_t ny, std::uint64_t seed);

}  // namespace sightline::generate
