#include <sightline/algorithms/levels/cells.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/query.h>
#include <sightline/algorithms/levels/wall_polygon.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <span>
#include <unordered_map>
#include <utility>

namespace sightline {

using levels_detail::Wall_cutter;
using levels_detail::Wall_halves;
using levels_detail::Wall_polygon;

namespace levels_detail {

using Box_planes = std::array<std::array<Plane, 2>, 3>;

/// A given tree without nodes whose planes miss the inside of what the nodes above leave; and what is a leaf in it.
class Given_tree {
 public:
  std::vector<Bsp_options::Given> nodes;
  std::vector<std::array<std::uint32_t, 2>> leaves;  // by node: in front and behind, where there is no node
  std::uint32_t root_leaf = 0;                       // where there is no node at all

  Given_tree(Scene& scene, const Box_planes& box, const Space_tree& tree,
             const std::function<void(std::size_t, std::size_t)>& progress)
      : box_(box) {
    for (const Space_tree::Node& node : tree.nodes) {
      if (progress) progress(0, tree.nodes.size());
      planes_.push_back(scene.add_plane(on_grid(scene, node.plane)));
    }
    if (tree.root < 0) {
      root_leaf = static_cast<std::uint32_t>(-1 - tree.root);
      return;
    }
    const Predicates predicates = scene.predicates();
    Wall_cutter cutter(predicates);
    struct Waiting {
      std::int32_t number;  // in the tree
      std::int32_t above;   // in `nodes`
      bool in_front;
      std::vector<Plane> within;
      Wall_polygon last;  // what the plane of the node above has in its cell
    };
    std::vector<Waiting> stack;
    stack.push_back({tree.root, -1, true, {}, {}});
    while (!stack.empty()) {
      Waiting job = std::move(stack.back());
      stack.pop_back();
      // 1. Down to a plane that passes through the inside.
      Wall_polygon section;
      while (job.number >= 0 && (section = section_of(job.number, job.within, cutter)).empty())
        job.number = tree.nodes[static_cast<std::size_t>(job.number)]
                         .children[is_in_front(predicates, job.number, job.last, job.within, cutter) ? 0 : 1];
      // 2. A node, or a leaf.
      const auto number = static_cast<std::int32_t>(nodes.size());
      if (job.above >= 0) {
        const auto above = static_cast<std::size_t>(job.above);
        if (job.number < 0) leaves[above][job.in_front ? 0 : 1] = static_cast<std::uint32_t>(-1 - job.number);
        else (job.in_front ? nodes[above].front : nodes[above].behind) = number;
      } else if (job.number < 0) {
        root_leaf = static_cast<std::uint32_t>(-1 - job.number);
      }
      if (job.number < 0) continue;
      const Plane plane = planes_[static_cast<std::size_t>(job.number)];
      nodes.push_back({plane});
      leaves.push_back({});
      if (progress) progress(0, tree.nodes.size());
      for (const bool in_front : {false, true}) {
        Waiting& below =
            stack.emplace_back(Waiting{tree.nodes[static_cast<std::size_t>(job.number)].children[in_front ? 0 : 1],
                                       number, in_front, job.within, section});
        below.within.push_back(in_front ? plane : plane.opposite());
      }
    }
  }

 private:
  static std::array<Integer, 4> on_grid(const Scene& scene, const std::array<Rational, 4>& plane) {
    const Exact_point origin = scene.position(std::array<Integer, 4>{0, 0, 0, 1});
    const Rational unit = scene.position(std::array<Integer, 4>{1, 0, 0, 1})[0] - origin[0];
    std::array<Rational, 4> h{plane[0] * unit, plane[1] * unit, plane[2] * unit, plane[3]};
    for (std::size_t k = 0; k < 3; ++k) h[3] += plane[k] * origin[k];
    return Over_common(h).whole;
  }
  Wall_polygon section_of(std::int32_t node, const std::vector<Plane>& within, Wall_cutter& cutter) const {
    const Plane own = planes_[static_cast<std::size_t>(node)];
    for (const std::array<Plane, 2>& axis : box_)
      for (const Plane side : axis)
        if (side.id() == own.id()) return {};  // it has the whole box on one side
    Wall_polygon polygon = cutter.section(own, box_);
    for (const Plane plane : within) polygon = cutter.in_front(polygon, plane);
    return polygon;
  }
  /// Where a cell is to a plane that misses its inside: as some of its boundary is, which is in the plane above, or,
  /// where that is the same plane, as the cell is to that.
  bool is_in_front(const Predicates& predicates, std::int32_t node, const Wall_polygon& last,
                   const std::vector<Plane>& within, Wall_cutter& cutter) const {
    const Plane plane = planes_[static_cast<std::size_t>(node)];
    if (within.empty()) return sgn(predicates.coefficients(plane)[3]) > 0;  // the middle of the box
    const Wall_halves halves = cutter.cut(last, plane);
    if (halves.is_in_plane) return within.back().flipped() == plane.flipped();
    return !halves.front.empty();
  }

  const Box_planes& box_;
  std::vector<Plane> planes_;
};

}  // namespace levels_detail

using levels_detail::Box_planes;
using levels_detail::Given_tree;

struct Level_cells::Space {
  Scene scene;
  Box_planes box;
  Given_tree given;
  Exact_traits traits;
  Exact_tree tree;
  std::vector<std::array<Cell_id, 2>> leaves;  // by node: the cells in front and behind, where those are leaves

  Space(const Polygon_soup& soup, const Cell_options& options)
      : scene(with_points(soup, options.tree.corners)),
        box(box_about(scene)),
        given(scene, box, options.tree, options.progress),
        traits(scene),
        tree(build_bsp(traits, bsp_options(options))) {}

  /// The same scene on a grid that has the points too.
  static Polygon_soup with_points(Polygon_soup soup, const std::vector<Exact_point>& points) {
    for (const Exact_point& p : points) soup.add_point(p[0], p[1], p[2]);
    return soup;
  }
  /// Beyond all points of the scene: its coordinates on the grid are less than that.
  static Box_planes box_about(Scene& scene) {
    Integer reach;
    mpz_setbit(reach.get_mpz_t(), static_cast<mp_bitcnt_t>(scene.points().bits()));
    Box_planes box;
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<Integer, 4> low{0, 0, 0, reach}, high{0, 0, 0, reach};
      low[k] = 1;
      high[k] = -1;
      box[k] = {scene.add_plane(low), scene.add_plane(high)};
    }
    return box;
  }
  Bsp_options bsp_options(const Cell_options& options) const {
    Bsp_options bsp;
    bsp.given = given.nodes;
    bsp.candidates = options.candidates;
    bsp.seed = options.seed;
    bsp.threads = options.threads;
    if (options.progress)  // the first half of all
      bsp.progress = [&tell = options.progress](std::size_t done, std::size_t all) { tell(done, 2 * all); };
    return bsp;
  }

  /// The leaf of the given tree that each cell is in.
  void find_leaves(std::vector<Level_cell>& cells) const {
    struct Waiting {
      std::int32_t node;   // of the tree
      std::int32_t given;  // the same of the given one, or none
      std::uint32_t leaf;  // then
    };
    std::vector<Waiting> stack;
    if (!tree.nodes.empty()) stack.push_back({0, given.nodes.empty() ? -1 : 0, given.root_leaf});
    else cells[0].leaf = given.root_leaf;
    while (!stack.empty()) {
      const Waiting job = stack.back();
      stack.pop_back();
      const auto n = static_cast<std::size_t>(job.node);
      for (const std::size_t side : {0u, 1u}) {
        Waiting below{side == 0 ? tree.nodes[n].front : tree.nodes[n].behind, -1, job.leaf};
        if (job.given >= 0) {
          const auto g = static_cast<std::size_t>(job.given);
          below.given = side == 0 ? given.nodes[g].front : given.nodes[g].behind;
          below.leaf = given.leaves[g][side];
        }
        if (below.node != Exact_tree::leaf) stack.push_back(below);
        else cells[leaves[n][side]].leaf = below.leaf;
      }
    }
  }
};

namespace {

/// Divides the planes of a tree's nodes into walls between its leaves.
class Wall_builder {
 public:
  using Tree = Exact_tree;

  Wall_builder(const Exact_traits& traits, const Tree& tree, const Box_planes& box,
               std::vector<std::array<Cell_id, 2>>& leaves)
      : traits_(traits), tree_(tree), box_(box), leaves_(leaves), cutter_(traits.predicates()) {}

  void number_leaves() {
    leaves_.assign(tree_.nodes.size(), {no_cell, no_cell});
    for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
      if (tree_.nodes[n].front == Tree::leaf) leaves_[n][0] = cells_++;
      if (tree_.nodes[n].behind == Tree::leaf) leaves_[n][1] = cells_++;
    }
    if (tree_.nodes.empty()) cells_ = 1;
  }

  void build(const std::function<void(std::size_t, std::size_t)>& progress) {
    // 1. Walls in the planes of nodes: what their ancestors leave of them.
    struct Waiting {
      std::int32_t node;
      std::size_t depth;
    };
    std::vector<Waiting> stack;
    std::vector<std::pair<std::int32_t, bool>> path;  // nodes above, and whether this is in front of them
    if (!tree_.nodes.empty()) stack.push_back({0, 0});
    std::size_t done = 0;
    while (!stack.empty()) {
      const auto [node, depth] = stack.back();
      stack.pop_back();
      path.resize(depth);
      if (depth > 0) path.back().second = tree_.nodes[static_cast<std::size_t>(path.back().first)].front == node;
      divide_node(node, path);
      if (progress) progress(tree_.nodes.size() + ++done, 2 * tree_.nodes.size());  // the second half
      const auto& here = tree_.nodes[static_cast<std::size_t>(node)];
      path.push_back({node, true});
      if (here.behind != Tree::leaf) stack.push_back({here.behind, depth + 1});
      if (here.front != Tree::leaf) stack.push_back({here.front, depth + 1});
    }

    // 2. Walls at the end of the world: those of the box, to the inside.
    for (const std::array<Plane, 2>& axis : box_)
      for (const Plane plane : axis) {
        const auto keep = [&](Wall_polygon part, Cell_id cell) { add_wall(std::move(part), cell, no_cell, {}); };
        push(cutter_.section(plane, box_), tree_.nodes.empty() ? Tree::leaf : 0, 0, keep);
      }
  }

  std::vector<Cell_wall> walls;
  std::vector<Exact_point> points;
  std::vector<int> steps;  // by wall: by how much the winding number behind it is more than in front
  std::size_t cells() const { return cells_; }
  const Wall_cutter& cutter() const { return cutter_; }

 private:
  /// Sends a wall down a subtree, from the side that its cells are on; `keep` gets each part with its leaf.
  /// Pre: `node` is an inner node, or `cell` a leaf.
  template <class Keep>
  void push(Wall_polygon polygon, std::int32_t node, Cell_id cell, const Keep& keep, bool from_front = true) {
    struct Part {
      Wall_polygon polygon;
      std::int32_t node;
      Cell_id cell;
    };
    std::vector<Part> stack;
    stack.push_back({std::move(polygon), node, cell});
    while (!stack.empty()) {
      Part part = std::move(stack.back());
      stack.pop_back();
      if (part.polygon.empty()) continue;
      if (part.node == Tree::leaf) {
        keep(std::move(part.polygon), part.cell);
        continue;
      }
      const auto n = static_cast<std::size_t>(part.node);
      const auto& here = tree_.nodes[n];
      Wall_halves halves = cutter_.cut(part.polygon, here.plane);
      if (halves.is_in_plane) {  // the cells are on that side of it that they are on of the wall
        const bool same = is_same_side(part.polygon.plane, here.plane);
        (same == from_front ? halves.front : halves.behind) = std::move(part.polygon);
      }
      stack.push_back({std::move(halves.behind), here.behind, leaves_[n][1]});
      stack.push_back({std::move(halves.front), here.front, leaves_[n][0]});
    }
  }
  /// Whether two names of one plane have their fronts on one side.
  bool is_same_side(Plane g, Plane h) const {
    if (g.id() == h.id()) return g.flipped() == h.flipped();
    const std::array<Integer, 4> a = traits_.predicates().coefficients(g), b = traits_.predicates().coefficients(h);
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 0;
  }

  void divide_node(std::int32_t node, const std::vector<std::pair<std::int32_t, bool>>& path) {
    const auto n = static_cast<std::size_t>(node);
    const auto& here = tree_.nodes[n];
    Wall_polygon polygon = cutter_.section(here.plane, box_);
    for (const auto& [above, in_front] : path) {
      const Plane plane = tree_.nodes[static_cast<std::size_t>(above)].plane;
      polygon = cutter_.in_front(polygon, in_front ? plane : plane.opposite());
    }
    const auto keep_behind = [&](Wall_polygon part, Cell_id front) {
      push(
          std::move(part), here.behind, leaves_[n][1],
          [&](Wall_polygon wall, Cell_id behind) { add_wall(std::move(wall), front, behind, tree_.on(here)); }, false);
    };
    push(std::move(polygon), here.front, leaves_[n][0], keep_behind);
  }

  using Fragments = std::span<const Fragment<Exact_traits>>;

  void add_wall(Wall_polygon polygon, Cell_id front, Cell_id behind, Fragments fragments) {
    Cell_wall wall{front, behind, ids_of(polygon), {}, {}, {}};
    const std::array<double, 6> box = box_of(polygon.corners, [](const auto& corner) { return corner.vertex; });
    std::vector<Wall_polygon> open{polygon};
    Wall_polygon covered;  // a part of it that some faces cover wholly and the others not at all
    int step = 0;
    for (const Fragment<Exact_traits>& fragment : fragments) {
      if (!overlap(box, box_of(fragment.polygon, [](const auto& corner) { return *corner.vertex; }))) continue;
      const Wall_polygon common = within(polygon, fragment);
      if (common.empty()) continue;
      (fragment.same_sense ? wall.faces_front : wall.faces_behind).push_back(traits_.face(fragment.polygon.piece));
      open = without(open, fragment);
      const Wall_polygon of_both = covered.empty() ? common : within(covered, fragment);
      if (of_both.empty()) continue;
      covered = of_both;
      step += (fragment.same_sense ? 1 : -1) * times_[fragment.polygon.piece];
    }
    for (std::vector<Face_id>* faces : {&wall.faces_front, &wall.faces_behind}) {
      std::sort(faces->begin(), faces->end());
      faces->erase(std::unique(faces->begin(), faces->end()), faces->end());
    }
    if (behind != no_cell)
      for (const Wall_polygon& part : open) wall.open.push_back(ids_of(part));
    steps.push_back(open.empty() ? step : 0);
    walls.push_back(std::move(wall));
  }

  template <class Corners, class Vertex_of>
  static std::array<double, 6> box_of(const Corners& corners, Vertex_of vertex_of) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 6> box{far, far, far, -far, -far, -far};
    for (const auto& corner : corners) {
      const Vertex& v = vertex_of(corner);
      const double p[3] = {v.x, v.y, v.z};
      for (std::size_t k = 0; k < 3; ++k) {
        const double low = v.error < far ? p[k] - v.error * (1 + 0x1p-50) - 0x1p-50 * std::fabs(p[k]) : -far,
                     high = v.error < far ? p[k] + v.error * (1 + 0x1p-50) + 0x1p-50 * std::fabs(p[k]) : far;
        box[k] = std::min(box[k], low);
        box[k + 3] = std::max(box[k + 3], high);
      }
    }
    return box;
  }
  static bool overlap(const std::array<double, 6>& a, const std::array<double, 6>& b) {
    for (std::size_t k = 0; k < 3; ++k)
      if (a[k] > b[k + 3] || b[k] > a[k + 3]) return false;
    return true;
  }

  /// What a polygon has in common with a fragment in its plane.
  Wall_polygon within(Wall_polygon polygon, const Fragment<Exact_traits>& fragment) {
    for (const auto& corner : fragment.polygon) {
      if (polygon.empty()) break;
      polygon = cutter_.in_front(polygon, corner.edge.bound);
    }
    return polygon;
  }
  /// What of polygons a fragment in their plane leaves, in convex parts.
  std::vector<Wall_polygon> without(const std::vector<Wall_polygon>& polygons, const Fragment<Exact_traits>& fragment) {
    std::vector<Wall_polygon> left;
    for (const Wall_polygon& polygon : polygons) {
      if (within(polygon, fragment).empty()) {
        left.push_back(polygon);
        continue;
      }
      Wall_polygon rest = polygon;
      for (const auto& corner : fragment.polygon) {
        Wall_halves halves = cutter_.cut(rest, corner.edge.bound);
        if (!halves.behind.empty()) left.push_back(std::move(halves.behind));
        rest = std::move(halves.front);
      }
    }
    return left;
  }

  std::vector<std::uint32_t> ids_of(const Wall_polygon& polygon) {
    std::vector<std::uint32_t> ids;
    for (const Wall_polygon::Corner& corner : polygon.corners) ids.push_back(id_of(corner.vertex));
    return ids;
  }
  /// A vertex that has had the same name before has the same place; one of another name may have.
  std::uint32_t id_of(const Vertex& v) {
    Name name{v.plane[0], v.plane[1], v.plane[2]};
    std::sort(name.begin(), name.end());
    const auto [known, is_new_name] = ids_by_name_.try_emplace(name, 0);
    if (!is_new_name) return known->second;
    const auto [place, is_new] = ids_.try_emplace(traits_.position(v), static_cast<std::uint32_t>(points.size()));
    if (is_new) points.push_back(place->first);
    return known->second = place->second;
  }

  const Exact_traits& traits_;
  const Tree& tree_;
  const Box_planes& box_;
  std::vector<std::array<Cell_id, 2>>& leaves_;
  Wall_cutter cutter_;
  Cell_id cells_ = 0;
  std::vector<int> times_ = times_given(traits_.scene());
  using Name = std::array<std::uint32_t, 3>;  ///< planes that meet
  struct Name_hash {
    std::size_t operator()(const Name& name) const {
      return ((name[0] * 0x9e3779b97f4a7c15u + name[1]) * 0x9e3779b97f4a7c15u + name[2]) * 0x9e3779b97f4a7c15u >> 7;
    }
  };
  std::unordered_map<Name, std::uint32_t, Name_hash> ids_by_name_;
  std::map<Exact_point, std::uint32_t> ids_;
};

/// Calls visit(neighbour, wall) for each wall of a cell that another is beyond.
template <class Visit>
void each_neighbour(const std::vector<Level_cell>& cells, const std::vector<Cell_wall>& walls, Cell_id cell,
                    Visit visit) {
  for (const std::uint32_t w : cells[cell].walls) {
    const Cell_id other = walls[w].front == cell ? walls[w].behind : walls[w].front;
    if (other != no_cell) visit(other, w);
  }
}

/// Winding numbers, from the end of the world on.
void find_windings(std::vector<Level_cell>& cells, const std::vector<Cell_wall>& walls, const std::vector<int>& steps) {
  std::vector<char> is_known(cells.size(), 0);
  std::queue<Cell_id> waiting;
  for (Cell_id c = 0; c < cells.size(); ++c)
    if (cells[c].is_outside) {
      is_known[c] = 1;
      waiting.push(c);
    }
  for (; !waiting.empty(); waiting.pop()) {
    const Cell_id cell = waiting.front();
    each_neighbour(cells, walls, cell, [&](Cell_id other, std::uint32_t w) {
      if (is_known[other] != 0) return;
      is_known[other] = 1;
      cells[other].winding = cells[cell].winding + (walls[w].front == cell ? steps[w] : -steps[w]);
      waiting.push(other);
    });
  }
  int least = 0;
  for (const Level_cell& cell : cells) least = std::min(least, cell.winding);
  for (Level_cell& cell : cells) cell.is_solid = cell.winding > least;
}

/// What hangs together through open walls. On both sides of one the winding number is the same: it is of a whole cell,
/// and does not change at a point of the wall that is on no face.
std::size_t find_regions(std::vector<Level_cell>& cells, const std::vector<Cell_wall>& walls) {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  for (Level_cell& cell : cells) cell.region = none;
  std::uint32_t regions = 0;
  for (Cell_id c = 0; c < cells.size(); ++c) {
    if (cells[c].region != none) continue;
    cells[c].region = regions;
    std::vector<Cell_id> stack{c};
    while (!stack.empty()) {
      const Cell_id cell = stack.back();
      stack.pop_back();
      each_neighbour(cells, walls, cell, [&](Cell_id other, std::uint32_t w) {
        if (walls[w].open.empty() || cells[other].region != none) return;
        cells[other].region = regions;
        stack.push_back(other);
      });
    }
    ++regions;
  }
  return regions;
}

}  // namespace

Level_cells::Level_cells(const Polygon_soup& soup, const Cell_options& options)
    : space_(std::make_unique<Space>(soup, options)) {
  // 1. Walls between leaves.
  Wall_builder builder(space_->traits, space_->tree, space_->box, space_->leaves);
  builder.number_leaves();
  builder.build(options.progress);
  walls_ = std::move(builder.walls);
  points_ = std::move(builder.points);
  cells_.resize(builder.cells());
  for (std::uint32_t w = 0; w < walls_.size(); ++w) {
    const Cell_wall& wall = walls_[w];
    Level_cell& front = cells_[wall.front];
    front.walls.push_back(w);
    front.faces.insert(front.faces.end(), wall.faces_front.begin(), wall.faces_front.end());
    if (wall.behind == no_cell) {
      front.is_outside = true;
      continue;
    }
    Level_cell& behind = cells_[wall.behind];
    behind.walls.push_back(w);
    behind.faces.insert(behind.faces.end(), wall.faces_behind.begin(), wall.faces_behind.end());
  }
  for (Level_cell& cell : cells_) {
    std::sort(cell.faces.begin(), cell.faces.end());
    cell.faces.erase(std::unique(cell.faces.begin(), cell.faces.end()), cell.faces.end());
  }

  space_->find_leaves(cells_);

  // 2. What is solid, and what is connected.
  closed_ = closure(space_->scene).closed;
  if (closed_) find_windings(cells_, walls_, builder.steps);
  counters_.regions = find_regions(cells_, walls_);

  counters_.cells = cells_.size();
  for (const Level_cell& cell : cells_) {
    counters_.solid += cell.is_solid;
    counters_.outside += cell.is_outside;
  }
  counters_.walls = walls_.size();
  for (const Cell_wall& wall : walls_) {
    counters_.portals += !wall.open.empty() && !cells_[wall.front].is_solid;
    counters_.covered += wall.behind != no_cell && wall.open.empty();
  }
  counters_.contacts = builder.cutter().contacts();
  counters_.nodes = space_->tree.counters.nodes;
  counters_.splits = space_->tree.counters.splits;
}

Level_cells::~Level_cells() = default;
Level_cells::Level_cells(Level_cells&&) noexcept = default;

const Scene& Level_cells::scene() const { return space_->scene; }

std::vector<Exact_point> Level_cells::polygon(const std::vector<std::uint32_t>& corners) const {
  std::vector<Exact_point> polygon;
  for (const std::uint32_t p : corners) polygon.push_back(points_[p]);
  return polygon;
}

Exact_point Level_cells::inside(Cell_id cell) const {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t w : cells_[cell].walls)
    corners.insert(corners.end(), walls_[w].corners.begin(), walls_[w].corners.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  Exact_point sum{};
  for (const std::uint32_t p : corners)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += points_[p][k];
  for (Rational& x : sum) x /= static_cast<long>(corners.size());
  return sum;
}

std::vector<Cell_id> Level_cells::about(const Exact_point& point) const {
  Predicate_counts counts;
  const Located_point place = space_->traits.eye(point);
  for (const std::array<Plane, 2>& axis : space_->box)
    for (const Plane plane : axis)
      if (space_->traits.side(place, plane, counts) == CGAL::NEGATIVE) return {};
  if (space_->tree.nodes.empty()) return {0};
  std::vector<Cell_id> cells;
  std::vector<std::int32_t> stack{0};
  while (!stack.empty()) {
    const auto n = static_cast<std::size_t>(stack.back());
    stack.pop_back();
    const Exact_tree::Node& node = space_->tree.nodes[n];
    const Sign side = space_->traits.side(place, node.plane, counts);
    const auto go = [&](std::int32_t child, Cell_id leaf) {
      if (child != Exact_tree::leaf) stack.push_back(child);
      else if (leaf != no_cell) cells.push_back(leaf);
    };
    if (side != CGAL::NEGATIVE) go(node.front, space_->leaves[n][0]);
    if (side != CGAL::POSITIVE) go(node.behind, space_->leaves[n][1]);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

Cell_id Level_cells::at(const Exact_point& point) const {
  const std::vector<Cell_id> cells = about(point);
  if (cells.empty()) return no_cell;
  const auto open = std::find_if(cells.begin(), cells.end(), [&](Cell_id cell) { return !cells_[cell].is_solid; });
  return open == cells.end() ? cells[0] : *open;
}

std::vector<Cell_id> Level_cells::way_out(const Exact_point& point) const {
  std::vector<Cell_id> from(cells_.size(), no_cell);
  std::queue<Cell_id> waiting;
  for (const Cell_id start : about(point)) {
    if (cells_[start].is_solid) continue;
    from[start] = start;
    waiting.push(start);
  }
  for (; !waiting.empty(); waiting.pop()) {
    const Cell_id cell = waiting.front();
    if (cells_[cell].is_outside) {
      std::vector<Cell_id> way{cell};
      while (way.back() != from[way.back()]) way.push_back(from[way.back()]);
      std::reverse(way.begin(), way.end());
      return way;
    }
    each_neighbour(cells_, walls_, cell, [&](Cell_id other, std::uint32_t w) {
      if (walls_[w].open.empty() || from[other] != no_cell) return;
      from[other] = cell;
      waiting.push(other);
    });
  }
  return {};
}

}  // namespace sightline
