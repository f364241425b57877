#pragma once
// How directions are cut: by planes through the eye and scene edges, until one piece covers each region.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/lazy_table.h>
#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

namespace visible_detail {

template <View V>
class Solver {
 public:
  using Ray = typename V::Ray;
  using Plane = typename V::Plane;
  using Surface = Visible_surface<V>;
  static constexpr std::uint32_t nothing = Surface::nothing;

  using Region = typename Surface::Cone;

  Solver(const V& view, const Piece_boxes& boxes, const Visible_options& options)
      : view_(view),
        boxes_(boxes),
        options_(options),
        predicates_(view.scene().predicates()),
        eye_(view.scene().locate(view.eye())),
        edges_(boxes.chunks().size()),
        seen_(view.scene().counters().faces_read) {}

  Surface solve(std::vector<Region> fields) {
    std::vector<Output> outputs(fields.size());
    for (std::size_t k = 0; k < fields.size(); ++k) {
      Task task{fields[k], {}, {}, nothing, {}, 0};
      if (!boxes_.nodes().empty()) task.boxes.push_back({0, 0});
      outputs[k].root = solve_in_parallel(std::move(task), 0x1p0 / static_cast<double>(fields.size()), outputs[k]);
    }
    Surface surface = gathered(outputs);
    surface.cones = std::move(fields);
    return surface;
  }

 private:
  // ---- What a region holds

  /// A chunk that may meet the region, with a bit for each edge plane that has parts of the region on both sides (none:
  /// it covers the region).
  struct Item {
    std::uint32_t chunk, active;
  };
  Item with_all_edges(std::uint32_t chunk) const {
    const std::uint32_t size = boxes_.chunks()[chunk].size;
    return {chunk, size == 32 ? ~0u : (1u << size) - 1};
  }
  static void remove(std::vector<Item>& items, std::size_t i) {
    items[i] = items.back();
    items.pop_back();
  }
  /// A box that has not been opened, by its node.
  struct Closed_box {
    std::uint32_t node;
    double distance;  // from the eye
    friend bool operator<(const Closed_box& a, const Closed_box& b) {
      return a.distance != b.distance ? a.distance > b.distance : a.node > b.node;
    }  // a heap has the nearest first
  };
  struct Task {
    Region region;
    std::vector<Item> items;
    std::vector<Closed_box> boxes;    // a heap
    std::uint32_t cover;              // the chunk that is nearest of those that cover the region, or nothing
    std::vector<std::uint32_t> tied;  // chunks in the plane of the cover that come after it
    std::uint32_t depth;
  };
  struct Output {
    std::vector<typename Surface::Part> parts;
    std::vector<Ray> rays;
    std::vector<typename Surface::Node> nodes;
    std::vector<typename Surface::Crossing> crossings;
    std::int32_t root = Surface::no_child;
    Visible_counters counters;
  };

  std::uint32_t piece_of(std::uint32_t chunk) const { return boxes_.chunks()[chunk].piece; }
  std::span<const std::uint32_t> points_of(std::uint32_t chunk) const { return boxes_.points(boxes_.chunks()[chunk]); }
  const Piece_boxes::Node& node(const Closed_box& box) const { return boxes_.nodes()[box.node]; }
  /// The planes through the eye and a chunk's edges, its inside in their front. Pre: it is not edge-on.
  const Plane* edges_of(std::uint32_t chunk) const {
    const auto make = [&](std::size_t c) {
      const std::span<const std::uint32_t> points = points_of(static_cast<std::uint32_t>(c));
      // Counterclockwise as seen from the front is clockwise around the rays from an eye in front.
      const bool turned = view_.eye_side(piece_of(static_cast<std::uint32_t>(c))) == CGAL::POSITIVE;
      std::vector<Plane> edges;
      edges.reserve(points.size());
      for (std::size_t k = 0; k < points.size(); ++k) {
        const std::uint32_t p = points[k], q = points[k + 1 == points.size() ? 0 : k + 1];
        edges.push_back(turned ? view_.edge(q, p) : view_.edge(p, q));
      }
      return edges;
    };
    return edges_.at(chunk, make).data();
  }

  /// Whether a comes before b where both are met at once.
  bool comes_first(std::uint32_t a, std::uint32_t b) const {
    const Sign side_a = view_.eye_side(a), side_b = view_.eye_side(b);
    if (side_a != side_b) return side_a == CGAL::POSITIVE;
    const Piece &p = view_.scene().pieces()[a], &q = view_.scene().pieces()[b];
    return p.face != q.face ? p.face < q.face : p.number <= q.number;
  }

  // ---- Tests

  /// Updates which edges of a chunk cut the region. Returns whether it may still meet it.
  bool update(Item& item, const Region& region, Predicate_counts& counts) const {
    const Plane* edges = item.active != 0 ? edges_of(item.chunk) : nullptr;
    for (std::uint32_t bits = item.active; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(bits));
      const Plane& edge = edges[k];
      bool inside = false, outside = false;
      for (const Ray& r : region.rays) {
        const Sign s = view_.side(edge, r, counts);
        inside = inside || s == CGAL::POSITIVE;
        outside = outside || s == CGAL::NEGATIVE;
        if (inside && outside) break;
      }
      if (!inside) return false;
      if (!outside) item.active &= ~(1u << k);
    }
    return true;
  }
  bool is_behind(std::uint32_t chunk, const Plane& w, Predicate_counts& counts) const {
    for (const std::uint32_t p : points_of(chunk))
      if (view_.side(w, p, counts) == CGAL::POSITIVE) return false;
    return true;
  }
  bool is_behind(const Piece_boxes::Node& node, const Plane& w) const {
    const Approximate_eye_plane a = view_.approximate(w);
    return Piece_boxes::is_behind(node.box, a.normal, a.size, a.error, eye_);
  }
  bool is_outside(std::uint32_t chunk, const Region& region, Predicate_counts& counts) const {
    return std::any_of(region.sides.begin(), region.sides.end(),
                       [&](const Plane& w) { return is_behind(chunk, w, counts); });
  }
  bool is_outside(const Piece_boxes::Node& node, const Region& region) const {
    return std::any_of(region.sides.begin(), region.sides.end(), [&](const Plane& w) { return is_behind(node, w); });
  }

  enum class Depth : char { nearer, tied, farther, crossing };
  /// How chunk f, which covers the region, is to chunk g there. `farther`: g is nearer, or comes first, in all of it.
  Depth compare(std::uint32_t f, std::uint32_t g, const Region& region, Predicate_counts& counts) const {
    const std::uint32_t a = piece_of(f), b = piece_of(g);
    if (view_.same_plane(a, b)) return comes_first(a, b) ? Depth::tied : Depth::farther;
    bool nearer = false, farther = false;
    for (const Ray& r : region.rays) {
      const Sign s = view_.nearer(a, b, r, counts);
      nearer = nearer || s == CGAL::POSITIVE;
      farther = farther || s == CGAL::NEGATIVE;
      if (nearer && farther) return Depth::crossing;
    }
    return farther ? Depth::farther : Depth::nearer;
  }
  /// Whether chunk g is behind f, which covers the region, although their planes cross there: no corner of it is on the
  /// eye's side of f's plane.
  bool is_beyond(std::uint32_t f, std::uint32_t g, Predicate_counts& counts) const {
    const std::span<const std::uint32_t> points = points_of(g);
    return std::all_of(points.begin(), points.end(),
                       [&](std::uint32_t p) { return view_.beyond(piece_of(f), p, counts) != CGAL::NEGATIVE; });
  }

  // ---- One region

  /// Drops what is hidden in the region, opens boxes, and returns the plane to cut it by; none where it is settled.
  std::optional<Plane> settle(Task& task, Output& out) const {
    std::size_t checked = 0;  // items before this have been compared with the cover
    std::optional<Hiding> hiding;
    for (;;) {
      if (find_cover(task, checked, out.counters) || (!hiding && task.cover != nothing))
        drop_hidden_boxes(task, hiding.emplace(hiding_in(task)), out.counters);
      drop_hidden(task, checked, out.counters);
      checked = task.items.size();
      if (task.boxes.empty() || has_enough(task)) break;
      open_nearest(task, hiding, out.counters);
    }
    if (task.items.empty()) return std::nullopt;
    return choose(task, out);
  }
  /// Keeps the nearest of what covers the region, apart from the items. Others stay there only where they cross it.
  /// Returns whether another one is it.
  bool find_cover(Task& task, std::size_t& checked, Visible_counters& counters) const {
    bool changed = false;
    for (std::size_t i = checked; i < task.items.size();) {
      const Item item = task.items[i];
      if (item.active != 0) {
        ++i;
        continue;
      }
      const Depth depth =
          task.cover == nothing ? Depth::farther : compare(task.cover, item.chunk, task.region, counters.predicates);
      if (depth == Depth::crossing && !has_side(task.region, crossing_of(task.cover, item.chunk))) {
        ++i;
        continue;
      }
      remove(task.items, i);
      if (depth == Depth::tied) task.tied.push_back(item.chunk);
      if (depth != Depth::farther) continue;
      if (task.cover != nothing && view_.same_plane(piece_of(task.cover), piece_of(item.chunk)))
        task.tied.push_back(task.cover);
      else task.tied.clear();
      task.cover = item.chunk;
      checked = i = 0;
      changed = true;  // all others once more
    }
    return changed;
  }
  /// What the cover of a region hides of boxes: those farther than all of it there, those beyond its plane.
  struct Hiding {
    double farthest;
    Prepared_plane plane;  // the eye in front
    bool hides(const Piece_boxes::Box& box, double distance) const {
      return distance > farthest || Piece_boxes::is_behind(box, plane);
    }
  };
  Hiding hiding_in(const Task& task) const {
    const std::uint32_t cover = piece_of(task.cover);
    double farthest = 0;  // of a polygon, so at a corner
    for (const Ray& r : task.region.rays) farthest = std::max(farthest, view_.farthest(cover, r));
    const sightline::Plane support = view_.scene().pieces()[cover].support;
    return {farthest * (1 + 0x1p-40) + 4 * eye_.error + 0x1p-900,
            predicates_.prepare(view_.eye_side(cover) == CGAL::POSITIVE ? support : support.opposite())};
  }
  void drop_hidden_boxes(Task& task, const Hiding& hiding, Visible_counters& counters) const {
    counters.hidden_boxes +=
        std::erase_if(task.boxes, [&](const Closed_box& box) { return hiding.hides(node(box).box, box.distance); });
    std::make_heap(task.boxes.begin(), task.boxes.end());
  }
  /// Drops what is behind the cover.
  void drop_hidden(Task& task, std::size_t checked, Visible_counters& counters) const {
    if (task.cover == nothing) return;
    for (std::size_t i = checked; i < task.items.size();) {
      const Item item = task.items[i];
      const Depth depth = compare(task.cover, item.chunk, task.region, counters.predicates);
      const bool drop =
          depth == Depth::nearer || depth == Depth::tied ||
          (depth == Depth::crossing && item.active != 0 && is_beyond(task.cover, item.chunk, counters.predicates));
      if (depth == Depth::tied) task.tied.push_back(item.chunk);
      counters.hidden += drop;
      if (drop) remove(task.items, i);
      else ++i;
    }
  }
  /// Whether there are pieces enough to choose a cut from; one that covers the region offers no edge.
  static bool has_enough(const Task& task) {
    constexpr std::ptrdiff_t enough = 6;
    return std::count_if(task.items.begin(), task.items.end(), [](const Item& item) { return item.active != 0; }) >=
           enough;
  }
  void open_nearest(Task& task, const std::optional<Hiding>& hiding, Visible_counters& counters) const {
    std::pop_heap(task.boxes.begin(), task.boxes.end());
    const Closed_box opened = task.boxes.back();
    task.boxes.pop_back();
    ++counters.opened;
    if (const std::uint32_t second = node(opened).second; second != 0) {
      for (const std::uint32_t child : {opened.node + 1, second}) {
        const Piece_boxes::Node& box = boxes_.nodes()[child];
        if (is_outside(box, task.region)) continue;
        const double distance = Piece_boxes::distance(box.box, eye_);
        if (hiding && hiding->hides(box.box, distance)) {
          ++counters.hidden_boxes;
          continue;
        }
        task.boxes.push_back({child, distance});
        std::push_heap(task.boxes.begin(), task.boxes.end());
      }
      return;
    }
    for (std::uint32_t chunk = node(opened).first; chunk < node(opened).first + node(opened).count; ++chunk) {
      if (view_.eye_side(piece_of(chunk)) == CGAL::ZERO) continue;
      ++counters.looked_at;
      if (is_outside(chunk, task.region, counters.predicates)) continue;
      Item item = with_all_edges(chunk);
      if (update(item, task.region, counters.predicates)) task.items.push_back(item);
    }
  }

  Eye_plane_name crossing_of(std::uint32_t f, std::uint32_t g) const {
    return Eye_plane_name::crossing(piece_of(f), piece_of(g));
  }
  static bool has_side(const Region& region, Eye_plane_name name) {
    return std::any_of(region.sides.begin(), region.sides.end(), [&](const Plane& w) { return w.name == name; });
  }

  Approximate_vector middle_of(const Region& region) const {
    Approximate_vector sum{0, 0, 0};
    for (const Ray& r : region.rays) {
      const Approximate_vector v = view_.approximate(r);
      const double size = std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
      if (size > 0) {
        sum.x += v.x / size;
        sum.y += v.y / size;
        sum.z += v.z / size;
      }
    }
    return sum;
  }
  /// The plane to cut a region by: of the edges of the piece that is nearest in the middle of it, the one that shares
  /// out the rest best; where nothing but pieces that cover the region is left, and two of them cross, their line.
  Plane choose(const Task& task, Output& out) const {
    double nearest = -std::numeric_limits<double>::infinity();
    const Item* best = nullptr;
    const Approximate_vector middle = middle_of(task.region);
    for (const Item& item : task.items) {
      if (item.active == 0) continue;
      const double near = view_.nearness(piece_of(item.chunk), middle);
      if (best == nullptr || near > nearest) {
        nearest = near;
        best = &item;
      }
    }
    if (best == nullptr) {
      ++out.counters.crossings;
      return view_.crossing(piece_of(task.cover), piece_of(task.items.front().chunk));  // no boxes are left
    }
    const Plane* cheapest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t bits = best->active; bits != 0; bits &= bits - 1) {
      const Plane& w = edges_of(best->chunk)[std::countr_zero(bits)];
      const double cost = cost_of(w, task, out.counters.predicates);
      if (cheapest == nullptr || cost < least) {
        least = cost;
        cheapest = &w;
      }
    }
    return *cheapest;
  }
  /// What a cut costs: pieces and boxes that it does not keep on one side, and how unequal the sides become. A box
  /// counts as the square root of its pieces: most of them will be hidden.
  double cost_of(const Plane& w, const Task& task, Predicate_counts& counts) const {
    constexpr double price = 3;
    const Plane against = view_.opposite(w);
    double front = 0, behind = 0, both = 0;
    const auto weigh = [&](bool in_front, bool at_back, double weight) {
      (in_front && at_back ? both : in_front ? front : behind) += weight;
    };
    for (const Closed_box& box : task.boxes)
      weigh(!is_behind(node(box), w), !is_behind(node(box), against), std::sqrt(static_cast<double>(node(box).count)));
    for (const Item& item : task.items) {
      bool in_front = false, at_back = false;
      for (const std::uint32_t p : points_of(item.chunk)) {
        const Sign s = view_.side(w, p, counts);
        in_front = in_front || s == CGAL::POSITIVE;
        at_back = at_back || s == CGAL::NEGATIVE;
      }
      weigh(in_front, at_back, 1);
    }
    return price * both + std::fabs(front - behind);
  }
  /// The parts of a region in front of a plane and behind it.
  std::array<Region, 2> cut(const Region& region, const Plane& w, Predicate_counts& counts) const {
    const std::size_t n = region.rays.size();
    std::vector<Sign> sides(n);
    for (std::size_t k = 0; k < n; ++k) sides[k] = view_.side(w, region.rays[k], counts);
    std::array<Region, 2> parts;
    const Plane against = view_.opposite(w);
    for (std::size_t k = 0; k < n; ++k) {
      const Sign from = sides[k], to = sides[k + 1 == n ? 0 : k + 1];
      const auto add = [&](std::size_t part, const Ray& ray, const Plane& side) {
        parts[part].rays.push_back(ray);
        parts[part].sides.push_back(side);
      };
      if (from != CGAL::NEGATIVE)
        add(0, region.rays[k], from == CGAL::POSITIVE || to == CGAL::POSITIVE ? region.sides[k] : w);
      if (from != CGAL::POSITIVE)
        add(1, region.rays[k], from == CGAL::NEGATIVE || to == CGAL::NEGATIVE ? region.sides[k] : against);
      if (from * to >= 0) continue;
      const Ray crossing =
          from == CGAL::POSITIVE ? view_.meet(region.sides[k], w, counts) : view_.meet(w, region.sides[k], counts);
      add(0, crossing, from == CGAL::POSITIVE ? w : region.sides[k]);
      add(1, crossing, from == CGAL::POSITIVE ? region.sides[k] : against);
    }
    return parts;
  }

  /// The tasks of the two parts of a region.
  std::array<Task, 2> divide(const Task& task, const Plane& w, Output& out) const {
    Visible_counters& counters = out.counters;
    std::array<Region, 2> regions = cut(task.region, w, counters.predicates);
    ++counters.splits;
    if (w.name.kind() == Eye_plane_name::crossing_kind) {
      const std::uint32_t f = piece_of(task.cover), g = piece_of(task.items.front().chunk);
      const Region& near = regions[0];
      for (std::size_t k = 0; k < near.rays.size(); ++k)
        if (near.sides[k].name == w.name)
          out.crossings.push_back({f, g, near.rays[k], near.rays[k + 1 == near.rays.size() ? 0 : k + 1]});
    }
    std::array<Task, 2> tasks;
    for (std::size_t part = 0; part < 2; ++part) {
      Task& to = tasks[part];
      to.region = std::move(regions[part]);
      to.cover = task.cover;
      to.tied = task.tied;
      to.depth = task.depth + 1;
      if (to.region.rays.size() < 3) continue;  // inexact signs only
      const Plane side = part == 0 ? w : view_.opposite(w);
      for (const Closed_box& box : task.boxes)
        if (!is_behind(node(box), side)) to.boxes.push_back(box);
      std::make_heap(to.boxes.begin(), to.boxes.end());
      for (Item item : task.items)
        if (item.active == 0 ||
            (!is_behind(item.chunk, side, counters.predicates) && update(item, to.region, counters.predicates)))
          to.items.push_back(item);
    }
    return tasks;
  }

  // ---- All of them

  static constexpr std::uint32_t parallel_depth = 10;

  /// Returns the tree of what a region became: a child as nodes have it.
  std::int32_t solve_in_parallel(Task task, double share, Output& out) {
    if (task.depth >= parallel_depth || options_.threads == 1) return solve_alone(std::move(task), share, out);
    if (task.region.rays.size() < 3) return Surface::no_child;
    const std::optional<Plane> w = settle(task, out);
    if (!w) return finish(task, share, out);
    std::array<Task, 2> tasks = divide(task, *w, out);
    Output second;
    std::array<std::int32_t, 2> children;
    parallel_invoke([&] { children[0] = solve_in_parallel(std::move(tasks[0]), share / 2, out); },
                    [&] { children[1] = solve_in_parallel(std::move(tasks[1]), share / 2, second); });
    children[1] = append(second, children[1], out);
    return merge(*w, children, task.region, out);
  }

  std::int32_t solve_alone(Task first, double share, Output& out) {
    struct Step {
      Task task;
      std::optional<Plane> cut;  // where both parts are done
    };
    const std::uint32_t depth = first.depth;
    std::vector<Step> steps;
    std::vector<std::int32_t> done;
    steps.push_back({std::move(first), std::nullopt});
    while (!steps.empty()) {
      Step step = std::move(steps.back());
      steps.pop_back();
      if (step.cut) {
        const std::array<std::int32_t, 2> children{done[done.size() - 2], done.back()};
        done.resize(done.size() - 2);
        done.push_back(merge(*step.cut, children, step.task.region, out));
        continue;
      }
      if (step.task.region.rays.size() < 3) {
        done.push_back(Surface::no_child);
        continue;
      }
      const std::optional<Plane> w = settle(step.task, out);
      if (!w) {
        done.push_back(
            finish(step.task, std::ldexp(share, -static_cast<int>(std::min(step.task.depth - depth, 1000u))), out));
        continue;
      }
      std::array<Task, 2> tasks = divide(step.task, *w, out);
      step.task.items = {};
      step.task.boxes = {};
      step.task.tied = {};
      step.cut = w;
      steps.push_back(std::move(step));
      steps.push_back({std::move(tasks[1]), std::nullopt});
      steps.push_back({std::move(tasks[0]), std::nullopt});
    }
    return done.back();
  }

  /// A region in which one piece is seen, or none.
  std::int32_t finish(const Task& task, double share, Output& out) {
    const std::uint32_t piece = task.cover == nothing ? nothing : piece_of(task.cover);
    ++out.counters.regions;
    out.counters.depth = std::max<std::uint64_t>(out.counters.depth, task.depth);
    if (piece != nothing) {
      note(piece);
      for (const std::uint32_t chunk : task.tied)
        if (!is_noted(piece_of(chunk)) && meets(chunk, task.region, out.counters.predicates)) note(piece_of(chunk));
    }
    report(share);
    return add(piece, task.region, out);
  }
  static std::int32_t add(std::uint32_t piece, const Region& region, Output& out) {
    out.parts.push_back({piece, static_cast<std::uint32_t>(region.rays.size()), out.rays.size()});
    out.rays.insert(out.rays.end(), region.rays.begin(), region.rays.end());
    return ~static_cast<std::int32_t>(out.parts.size() - 1);
  }
  /// Whether a chunk and a region in front of its plane have an open set in common. Proof: P-62
  bool meets(std::uint32_t chunk, const Region& region, Predicate_counts& counts) const {
    Item item = with_all_edges(chunk);
    return update(item, region, counts) && (item.active == 0 || !is_outside(chunk, region, counts));
  }
  /// Two parts of one region that show the same are one. Pre: the children are the latest that were added.
  std::int32_t merge(const Plane& w, const std::array<std::int32_t, 2>& children, const Region& region, Output& out) {
    if (children[0] == Surface::no_child) return children[1];
    if (children[1] == Surface::no_child) return children[0];
    if (children[0] < 0 && children[1] < 0) {
      const auto first = out.parts[out.parts.size() - 2], second = out.parts.back();
      if (first.piece == second.piece) {
        out.parts.resize(out.parts.size() - 2);
        out.rays.resize(first.first);
        ++out.counters.merged;
        return add(first.piece, region, out);
      }
    }
    out.nodes.push_back({w, children[0], children[1]});
    return static_cast<std::int32_t>(out.nodes.size() - 1);
  }
  /// Puts one output behind another. Returns the child that `child` of the second becomes.
  template <class To>
  static std::int32_t append(const Output& from, std::int32_t child, To& to) {
    const auto parts = static_cast<std::int32_t>(to.parts.size()), nodes = static_cast<std::int32_t>(to.nodes.size());
    const auto moved = [&](std::int32_t c) { return c == Surface::no_child ? c : c < 0 ? c - parts : c + nodes; };
    for (typename Surface::Part part : from.parts) {
      part.first += to.rays.size();
      to.parts.push_back(part);
    }
    for (const typename Surface::Node& node : from.nodes)
      to.nodes.push_back({node.plane, moved(node.front), moved(node.behind)});
    to.rays.insert(to.rays.end(), from.rays.begin(), from.rays.end());
    to.crossings.insert(to.crossings.end(), from.crossings.begin(), from.crossings.end());
    to.counters += from.counters;
    return moved(child);
  }

  static constexpr unsigned char from_front = 1, from_behind = 2;
  unsigned char side_bit(std::uint32_t piece) const {
    return view_.eye_side(piece) == CGAL::POSITIVE ? from_front : from_behind;
  }
  void note(std::uint32_t piece) {
    if (!is_noted(piece))
      seen_[view_.scene().pieces()[piece].face].fetch_or(side_bit(piece), std::memory_order_relaxed);
  }
  bool is_noted(std::uint32_t piece) const {
    return (seen_[view_.scene().pieces()[piece].face].load(std::memory_order_relaxed) & side_bit(piece)) != 0;
  }

  void report(double share) {
    if (!options_.progress) return;
    constexpr double all = 0x1p20;
    const double done = done_.fetch_add(share * all, std::memory_order_relaxed);
    if (std::floor(done + share * all) != std::floor(done) || ++silent_ % 1024 == 0)
      options_.progress(static_cast<std::size_t>(std::min(done, all)), static_cast<std::size_t>(all));
  }

  Surface gathered(const std::vector<Output>& outputs) const {
    Surface surface;
    for (const Output& out : outputs) surface.roots.push_back(append(out, out.root, surface));
    surface.counters.pieces = view_.scene().pieces().size();
    for (Face_id f = 0; f < seen_.size(); ++f) {
      if ((seen_[f] & from_front) != 0) surface.visible.push_back(f);
      if ((seen_[f] & from_behind) != 0) surface.from_behind.push_back(f);
    }
    return surface;
  }

  const V& view_;
  const Piece_boxes& boxes_;
  const Visible_options& options_;
  Predicates predicates_;
  Located_point eye_;
  Lazy_table<std::vector<Plane>, 1> edges_;       // of chunks
  std::vector<std::atomic<unsigned char>> seen_;  // of each face, from_front and from_behind
  std::atomic<double> done_{0};
  std::atomic<unsigned> silent_{0};
};

}  // namespace visible_detail

}  // namespace sightline
