#include <sightline/algorithms/image/bsp2d.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/visible_output.h>
#include <sightline/algorithms/point_visibility/visible_region.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace sightline {

namespace image_detail {

namespace {

using Region = visible_detail::Region<Exact_view>;
using Exact_fragment = Fragment<Exact_traits>;
using Exact_polygon = Convex_polygon<Exact_traits>;

/// Where a region lies to a plane through the eye.
Position position_of(const Exact_view& view, const Region& region, const Exact_view::Plane& w,
                     Predicate_counts& counts) {
  bool front = false, behind = false;
  for (const Exact_view::Ray& ray : region.rays) {
    const Sign s = view.side(w, ray, counts);
    front = front || s == CGAL::POSITIVE;
    behind = behind || s == CGAL::NEGATIVE;
    if (front && behind) break;
  }
  return sightline::position_of(front, behind);
}

// ---- A fragment as a cone

/// The plane through the eye and edge k of a fragment, its inside in front.
Exact_view::Plane inwards(const Exact_view& view, const Exact_polygon& polygon, std::uint32_t k) {
  const auto edge = [&](std::uint32_t p, std::uint32_t q) {
    // Counterclockwise around it, an edge of a front has what it bounds behind it.
    return view.eye_side(polygon.piece) == CGAL::POSITIVE ? view.edge(q, p) : view.edge(p, q);
  };
  const Corner<Exact_traits>& corner = polygon.corners[k];
  const Vertex &from = *corner.vertex, &to = *polygon.corners[k + 1 == polygon.size ? 0 : k + 1].vertex;
  if (from.is_input() && to.is_input()) return edge(from.point, to.point);
  // What is left of an edge of the piece, or else a cut.
  const std::span<const Piece_corner> whole = view.scene().corners(view.scene().pieces()[polygon.piece]);
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (whole[i].edge == corner.edge.bound) return edge(whole[i].point, whole[i + 1 == whole.size() ? 0 : i + 1].point);
  return view.cut(polygon.piece, corner.edge.bound);
}

/// The directions in which a fragment is. Pre: the eye is not in its plane.
Region cone_of(const Exact_view& view, const Exact_polygon& polygon, Predicate_counts& counts) {
  const std::uint32_t n = polygon.size;
  const bool turned = view.eye_side(polygon.piece) == CGAL::POSITIVE;  // fronts are clockwise around their rays
  Region cone;
  for (std::uint32_t j = 0; j < n; ++j) cone.sides.push_back(inwards(view, polygon, turned ? (2 * n - 2 - j) % n : j));
  for (std::uint32_t j = 0; j < n; ++j) {
    const Vertex& corner = *polygon.corners[turned ? n - 1 - j : j].vertex;
    cone.rays.push_back(corner.is_input() ? view.ray(corner.point)
                                          : view.meet(cone.sides[j == 0 ? n - 1 : j - 1], cone.sides[j], counts));
  }
  return cone;
}

// ---- The tree of directions

/// Convex cones of directions, each cut by a plane through the eye, or covered by a piece, or free.
class Covered_directions {
 public:
  Covered_directions(const Exact_view& view, const Cones<Exact_view>& cones)
      : view_(view), eye_(view.scene().locate(view.eye())), roots_(cones.size()) {
    for (const Region& cone : cones) cells_.push_back({.region = cone, .parent = nowhere});
  }

  struct Found {
    bool free = false;  ///< some of it came to leaves that were free, which it covers now
    bool tied = false;  ///< some of it came to leaves that were covered at the same time
  };
  /// Covers what is free of a cone. `time`: not before that of any cone before, and not 0.
  Found cover(const Region& cone, std::uint32_t piece, std::uint32_t time, Bsp2d_counters& counters) {
    Found found;
    for (std::uint32_t root = 0; root < roots_; ++root)
      if (std::optional<Region> part = inside(cone, cells_[root].region, counters))
        waiting_.push_back({root, std::move(*part)});
    while (!waiting_.empty()) {
      auto [at, part] = std::move(waiting_.back());
      waiting_.pop_back();
      // 1. Down to a leaf; what is across a plane goes both ways.
      while (!is_hidden(at, time) && !is_leaf(at)) at = step(at, part, counters);
      if (is_hidden(at, time)) continue;
      // 2. A leaf is covered by what is in it.
      if (cells_[at].piece != nobody) {
        found.tied = true;
        continue;
      }
      found.free = true;
      occupy(at, part, piece, time, counters);
    }
    return found;
  }

  /// Whether a box is covered, for certain.
  bool hides(const Piece_boxes::Box& box) const {
    std::vector<std::uint32_t> stack;
    for (std::uint32_t root = 0; root < roots_; ++root) stack.push_back(root);
    while (!stack.empty()) {
      const Cell& cell = cells_[stack.back()];
      stack.pop_back();
      if (cell.covered_at != never) continue;
      if (cell.children == none) {
        if (!is_outside(box, cell.region)) return false;
        continue;
      }
      if (!is_behind(box, cell.plane)) stack.push_back(cell.children);
      if (!is_behind(box, view_.opposite(cell.plane))) stack.push_back(cell.children + 1);
    }
    return true;
  }

  /// All cells, and of two leaves of one node that show the same, one.
  Visible_surface<Exact_view> surface(Cones<Exact_view> cones) const {
    Visible_surface<Exact_view> surface;
    for (std::uint32_t root = 0; root < roots_; ++root) {
      const visible_detail::Output<Exact_view> out = output(root);
      surface.roots.push_back(append(out, out.root, surface));
    }
    surface.cones = std::move(cones);
    return surface;
  }
  std::size_t size() const { return cells_.size(); }

 private:
  static constexpr std::uint32_t nobody = Visible_surface<Exact_view>::nothing, nowhere = ~std::uint32_t{0}, none = 0,
                                 never = 0;
  struct Cell {
    Region region;
    std::uint32_t parent;
    std::uint32_t children = none;     // in front of the plane, and the next one behind it
    Exact_view::Plane plane = {};      // where it has children
    std::uint32_t piece = nobody;      // where it has none
    std::uint32_t covered_at = never;  // the time at which all of it was
  };
  struct Waiting {
    std::uint32_t cell;
    Region part;
  };

  bool is_leaf(std::uint32_t at) const { return cells_[at].children == none; }
  bool is_hidden(std::uint32_t at, std::uint32_t time) const {
    return cells_[at].covered_at != never && cells_[at].covered_at < time;
  }

  /// What is inside a root's cone.
  std::optional<Region> inside(Region part, const Region& root, Bsp2d_counters& counters) const {
    for (const Exact_view::Plane& side : root.sides) {
      const Position position = position_of(view_, part, side, counters.predicates);
      if (position == Position::behind) return std::nullopt;
      if (position == Position::across)
        part = std::move(visible_detail::cut(view_, part, side, counters.predicates)[0]);
    }
    return part;
  }
  /// The child that a part goes on in, clipped; what is behind the node's plane, where it is across, waits.
  std::uint32_t step(std::uint32_t at, Region& part, Bsp2d_counters& counters) {
    const Cell& cell = cells_[at];
    const Position position = position_of(view_, part, cell.plane, counters.predicates);
    if (position == Position::across) {
      ++counters.clips;
      std::array<Region, 2> halves = visible_detail::cut(view_, part, cell.plane, counters.predicates);
      part = std::move(halves[0]);
      waiting_.push_back({cell.children + 1, std::move(halves[1])});
    }
    return position == Position::behind ? cell.children + 1 : cell.children;
  }
  /// Cuts a free leaf along the sides of a part of it, which a piece covers.
  void occupy(std::uint32_t at, const Region& part, std::uint32_t piece, std::uint32_t time, Bsp2d_counters& counters) {
    for (const Exact_view::Plane& side : part.sides) {
      if (position_of(view_, cells_[at].region, side, counters.predicates) != Position::across) continue;
      std::array<Region, 2> halves = visible_detail::cut(view_, cells_[at].region, side, counters.predicates);
      const auto children = static_cast<std::uint32_t>(cells_.size());
      for (Region& half : halves) cells_.push_back({.region = std::move(half), .parent = at});
      cells_[at].plane = side;
      cells_[at].children = children;
      at = children;
    }
    cells_[at].piece = piece;
    // So is each cell above with both children covered.
    for (cells_[at].covered_at = time; cells_[at].parent != nowhere; cells_[at].covered_at = time) {
      at = cells_[at].parent;
      const std::uint32_t children = cells_[at].children;
      if (cells_[children].covered_at == never || cells_[children + 1].covered_at == never) break;
    }
  }

  bool is_behind(const Piece_boxes::Box& box, const Exact_view::Plane& w) const {
    const Approximate_eye_plane a = view_.approximate(w);
    return Piece_boxes::is_behind(box, a.normal, a.size, a.error, eye_);
  }
  bool is_outside(const Piece_boxes::Box& box, const Region& region) const {
    return std::any_of(region.sides.begin(), region.sides.end(),
                       [&](const auto& side) { return is_behind(box, side); });
  }

  /// The tree below a root, children before what is above them.
  visible_detail::Output<Exact_view> output(std::uint32_t root) const {
    visible_detail::Output<Exact_view> out;
    struct Step {
      std::uint32_t cell;
      bool children_done;
    };
    std::vector<Step> steps{{root, false}};
    std::vector<std::int32_t> done;
    while (!steps.empty()) {
      const Step next = steps.back();
      steps.pop_back();
      const Cell& cell = cells_[next.cell];
      if (cell.children == none) {
        done.push_back(out.add(cell.piece, cell.region));
        ++out.counters.regions;
      } else if (next.children_done) {
        const std::array<std::int32_t, 2> children{done[done.size() - 2], done.back()};
        done.resize(done.size() - 2);
        done.push_back(out.merge(cell.plane, children, cell.region));
        ++out.counters.splits;
      } else {
        steps.push_back({next.cell, true});
        steps.push_back({cell.children + 1, false});
        steps.push_back({cell.children, false});
      }
    }
    out.root = done.back();
    return out;
  }

  const Exact_view& view_;
  Located_point eye_;
  std::uint32_t roots_;
  std::vector<Cell> cells_;       // those of the roots first
  std::vector<Waiting> waiting_;  // parts that are not in a leaf yet
};

// ---- The scene's tree

/// What is below each node, itself included.
struct Subtrees {
  std::vector<Piece_boxes::Box> boxes;
  std::vector<std::uint32_t> nodes, fragments;

  explicit Subtrees(const Exact_tree& tree)
      : boxes(tree.nodes.size()), nodes(tree.nodes.size(), 1), fragments(tree.nodes.size()) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {  // children come after their node
      const Exact_tree::Node& node = tree.nodes[i];
      boxes[i].low.fill(infinity);
      boxes[i].high.fill(-infinity);
      fragments[i] = node.count;
      for (const Exact_fragment& fragment : tree.on(node))
        for (const Corner<Exact_traits>& corner : fragment.polygon) {
          const Vertex& v = *corner.vertex;
          add({{v.x - v.error, v.y - v.error, v.z - v.error}, {v.x + v.error, v.y + v.error, v.z + v.error}}, boxes[i]);
        }
      for (const std::int32_t child : {node.front, node.behind}) {
        if (child == Exact_tree::leaf) continue;
        const auto c = static_cast<std::size_t>(child);
        add(boxes[c], boxes[i]);
        nodes[i] += nodes[c];
        fragments[i] += fragments[c];
      }
    }
  }
  /// The sums round; the next doubles outwards are safe.
  static void add(const Piece_boxes::Box& box, Piece_boxes::Box& to) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      to.low[k] = std::min(to.low[k], std::nextafter(box.low[k], -infinity));
      to.high[k] = std::max(to.high[k], std::nextafter(box.high[k], infinity));
    }
  }
};

class Front_to_back {
 public:
  Front_to_back(const Exact_view& view, const Exact_tree& tree, const Cones<Exact_view>& cones,
                const Bsp2d_options& options, Bsp2d& result)
      : view_(view),
        tree_(tree),
        options_(options),
        result_(result),
        counters_(result.counters),
        subtrees_(tree),
        covered_(view, cones),
        faces_(view),
        visited_(view.scene().counters().faces_read) {}

  void run(Cones<Exact_view> cones) {
    const Exact_traits traits(view_.scene());
    const Traversal_counters walk = traverse_nodes(
        traits, tree_, traits.eye(view_.eye()), Direction::front_to_back, [&](std::size_t node) { return enter(node); },
        [&](std::size_t node, Sign side) { visit(node, side); });
    counters_.nodes = walk.nodes;
    counters_.fragments = walk.fragments;
    counters_.on_planes = walk.on_planes;
    counters_.predicates += walk.predicates;
    counters_.cells = covered_.size();
    result_.surface = covered_.surface(std::move(cones));
    faces_.list_in(result_.surface);
    count_skipped_faces();
    Visible_counters& common = result_.surface.counters;
    common.pieces = view_.scene().pieces().size();
    common.looked_at = counters_.fragments;
    common.hidden = counters_.hidden;
    common.hidden_boxes = skipped_;
    common.predicates += counters_.predicates;
  }

 private:
  /// Not where all below a node is covered.
  bool enter(std::size_t node) {
    if (!options_.skip_hidden || !covered_.hides(subtrees_.boxes[node])) return true;
    ++skipped_;
    counters_.nodes_skipped += subtrees_.nodes[node];
    counters_.fragments_skipped += subtrees_.fragments[node];
    report(subtrees_.fragments[node]);
    return false;
  }

  void visit(std::size_t node, Sign side) {
    const std::span<const Exact_fragment> on = tree_.on(tree_.nodes[node]);
    for (const Exact_fragment& fragment : on) visited_[face_of(fragment)] = true;
    report(on.size());
    if (side == CGAL::ZERO) {
      counters_.edge_on += on.size();
      return;
    }
    // 1. Those in one plane by the rule of ties.
    std::vector<const Exact_fragment*> ordered;
    for (const Exact_fragment& fragment : on) ordered.push_back(&fragment);
    const auto rank = [&](const Exact_fragment* fragment) {
      const std::uint32_t piece = fragment->polygon.piece;
      return std::tuple(view_.eye_side(piece) == CGAL::NEGATIVE, face_of(*fragment), piece);
    };
    std::stable_sort(ordered.begin(), ordered.end(), [&](auto* f, auto* g) { return rank(f) < rank(g); });
    // 2. What is left of each is seen, and covers the rest.
    ++time_;
    for (const Exact_fragment* fragment : ordered) {
      const std::uint32_t piece = fragment->polygon.piece;
      const Region cone = cone_of(view_, fragment->polygon, counters_.predicates);
      const Covered_directions::Found found = covered_.cover(cone, piece, time_, counters_);
      if (found.free || found.tied) {
        faces_.note(piece);
        result_.seen.push_back(static_cast<std::uint32_t>(fragment - tree_.fragments.data()));
      } else {
        ++counters_.hidden;
      }
    }
  }

  Face_id face_of(const Exact_fragment& fragment) const { return view_.scene().pieces()[fragment.polygon.piece].face; }
  void report(std::size_t fragments) {
    done_ += fragments;
    if (options_.progress) options_.progress(done_, tree_.fragments.size());
  }
  void count_skipped_faces() {
    for (const Exact_fragment& fragment : tree_.fragments)
      if (const Face_id face = face_of(fragment); !visited_[face]) {
        visited_[face] = true;
        ++counters_.faces_skipped;
      }
  }

  const Exact_view& view_;
  const Exact_tree& tree_;
  const Bsp2d_options& options_;
  Bsp2d& result_;
  Bsp2d_counters& counters_;
  Subtrees subtrees_;
  Covered_directions covered_;
  visible_detail::Seen_faces<Exact_view> faces_;
  std::vector<bool> visited_;  // faces
  std::uint32_t time_ = 0;     // nodes visited
  std::uint64_t skipped_ = 0;  // subtrees
  std::size_t done_ = 0;       // fragments
};

}  // namespace

}  // namespace image_detail

Bsp2d bsp2d(const Exact_view& view, const Exact_tree& tree, Cones<Exact_view> cones, const Bsp2d_options& options) {
  Bsp2d result;
  image_detail::Front_to_back walk(view, tree, cones, options, result);
  walk.run(std::move(cones));
  return result;
}

Bsp2d bsp2d(const Exact_view& view, Cones<Exact_view> cones, const Bsp2d_options& options) {
  Bsp_options building;
  building.threads = options.threads;
  building.seed = options.seed;
  building.progress = options.progress;
  const Exact_traits traits(view.scene());
  return bsp2d(view, build_bsp(traits, building), std::move(cones), options);
}

}  // namespace sightline
