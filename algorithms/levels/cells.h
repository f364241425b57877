#pragma once
// The cells that a BSP tree divides a level into, the walls between them, and what of the walls is open.

#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace sightline {

using Cell_id = std::uint32_t;
inline constexpr Cell_id no_cell = ~Cell_id{0};

/// What two cells have in common: a convex polygon, counterclockwise as seen from the cell in front.
struct Cell_wall {
  Cell_id front, behind;               ///< `behind` is no_cell at the end of the world
  std::vector<std::uint32_t> corners;  ///< points of Level_cells
  /// Convex parts that no face covers; all of it in one where none does; none at the end of the world.
  std::vector<std::vector<std::uint32_t>> open;
  std::vector<Face_id> faces_front, faces_behind;  ///< that cover some of it, and look into the cell in front, behind
};

/// A leaf of the tree, as a convex polyhedron.
struct Level_cell {
  std::vector<std::uint32_t> walls;
  std::vector<Face_id> faces;  ///< that look into it, ascending
  int winding = 0;             ///< of the faces about its inside, where they close up; 0 at the end of the world
  bool is_solid = false;       ///< the faces close up, and it is behind some of them
  bool is_outside = false;     ///< it has no end, but for the box that is put about the scene
  std::uint32_t region = 0;    ///< of cells with a way through open walls from each to each, all solid or none
  std::uint32_t leaf = 0;      ///< of the tree that space was divided by before
};

/// A tree that divides space before faces do, as a compiled level has one: leaves are convex, and known by numbers.
struct Space_tree {
  struct Node {
    std::array<Rational, 4> plane;         ///< a x + b y + c z + d, in the file's coordinates; not a = b = c = 0
    std::array<std::int32_t, 2> children;  ///< in front, behind: a node, or below 0 leaf -1 - child
  };
  std::vector<Node> nodes;
  std::int32_t root = -1;            ///< a node, or a leaf
  std::vector<Exact_point> corners;  ///< that planes are through, where those are wider than planes of the scene
};

struct Cell_counters {
  std::size_t cells = 0, solid = 0, outside = 0, regions = 0, walls = 0, portals = 0, covered = 0;
  std::size_t contacts = 0;  ///< degenerate ones: corners of walls that were in a plane that divided them
  std::size_t nodes = 0, splits = 0;

  template <class Visit>
  static void each(Visit visit) {
    visit("cells", &Cell_counters::cells);
    visit("solid", &Cell_counters::solid);
    visit("outside", &Cell_counters::outside);
    visit("regions", &Cell_counters::regions);
    visit("walls", &Cell_counters::walls);
    visit("portals", &Cell_counters::portals);
    visit("covered", &Cell_counters::covered);
    visit("contacts", &Cell_counters::contacts);
    visit("nodes", &Cell_counters::nodes);
    visit("splits", &Cell_counters::splits);
  }
};

struct Cell_options {
  unsigned candidates = 5;  ///< face planes tried for each node of the tree
  std::uint64_t seed = 1;
  int threads = 0;       ///< 0: as many as there are processors
  Space_tree tree = {};  ///< each cell is within one of its leaves. Pre: no node is below itself
  /// Planes of the given tree, none of which counts; fragments of the whole one, then its nodes, as a half each. Called
  /// from any thread; what it throws ends it.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
};

/// The leaves of a BSP tree of all faces, cut off by a box twice as large as the scene. Cells are open, convex and
/// disjoint; with their walls they fill the box. No face passes through a cell: each lies in walls.
/// Where the faces close up (P-08), a cell is solid unless its winding number is the least of all: behind faces that
/// look outwards, as of solids, and outside faces that look inwards, as of rooms. Where they do not, none is.
/// Degenerate: an empty scene is one cell; a leaf of `tree` that has no inside has no cell. Cost: the tree's, and
/// O(walls depth). Exact: yes. Source: lecture slides "Visibility Computation" (decomposition into convex regions).
/// Proof: P-88
class Level_cells {
 public:
  explicit Level_cells(const Polygon_soup& soup, const Cell_options& options = {});
  ~Level_cells();
  Level_cells(Level_cells&&) noexcept;

  const std::vector<Level_cell>& cells() const { return cells_; }
  const std::vector<Cell_wall>& walls() const { return walls_; }
  const std::vector<Exact_point>& points() const { return points_; }
  bool is_closed() const { return closed_; }
  const Cell_counters& counters() const { return counters_; }
  const class Scene& scene() const;

  std::vector<Exact_point> polygon(const std::vector<std::uint32_t>& corners) const;
  /// A point of a cell's inside: the mean of its corners. Exact: yes.
  Exact_point inside(Cell_id cell) const;
  /// The cells that a point is in or on the border of, ascending; none beyond the box. Exact: yes.
  std::vector<Cell_id> about(const Exact_point& point) const;
  /// The first of them that is not solid, or else the first. Nothing beyond the box. So what stands on a floor is in
  /// the room, whichever way the tree's planes look.
  Cell_id at(const Exact_point& point) const;
  /// Cells from one of those about a point that are not solid to one that has no end, through open walls, as few as can
  /// be; empty where there is no way, or those about the point are solid. Cost: O(walls)
  std::vector<Cell_id> way_out(const Exact_point& point) const;

 private:
  struct Space;
  std::unique_ptr<Space> space_;  // the scene, its tree and the cells of leaves
  std::vector<Level_cell> cells_;
  std::vector<Cell_wall> walls_;
  std::vector<Exact_point> points_;
  bool closed_ = false;
  Cell_counters counters_;
};

}  // namespace sightline
