#pragma once
// How directions are cut: by planes through the eye and scene edges, until one piece covers each region.
//
//   visible_region.h   a region, and how a plane cuts it
//   visible_chunks.h   pieces and boxes, and whether they meet a region
//   visible_cover.h    what covers a region, and what is behind that
//   visible_choice.h   by which plane a region is cut
//   visible_output.h   what comes of regions
//   here               one region, step by step; then all of them

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/algorithms/point_visibility/visible_choice.h>
#include <sightline/algorithms/point_visibility/visible_chunks.h>
#include <sightline/algorithms/point_visibility/visible_cover.h>
#include <sightline/algorithms/point_visibility/visible_output.h>
#include <sightline/algorithms/point_visibility/visible_region.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/prepared_plane.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace sightline::visible_detail {

/// Reports the share of directions that is done with, of 2^20; from any thread.
class Share_done {
 public:
  explicit Share_done(const Visible_options& options) : options_(options) {}

  void add(double share) {
    if (!options_.progress) return;
    constexpr double all = 0x1p20;
    const double done = done_.fetch_add(share * all, std::memory_order_relaxed);
    if (std::floor(done + share * all) != std::floor(done) || ++silent_ % 1024 == 0)
      options_.progress(static_cast<std::size_t>(std::min(done, all)), static_cast<std::size_t>(all));
  }

 private:
  const Visible_options& options_;
  std::atomic<double> done_{0};
  std::atomic<unsigned> silent_{0};
};

/// Choice: by which plane a region is cut, and whether it wants to know more of it, as Cut_choice.
template <View V, class Choice = Cut_choice<V>>
class Solver {
 public:
  using Plane = typename V::Plane;
  using Surface = Visible_surface<V>;

  Solver(const V& view, const Piece_boxes& boxes, const Visible_options& options)
      : view_(view),
        chunks_(view, boxes),
        covers_(chunks_),
        cuts_(chunks_),
        threads_(options.threads),
        seen_(view),
        done_(options) {}

  /// `through`: of each field the pieces that are looked through, as Looked_through has them; or no list at all.
  Surface solve(std::vector<Region<V>> fields, const std::vector<std::vector<std::uint32_t>>& through = {}) {
    const double share = 0x1p0 / static_cast<double>(fields.size());
    std::vector<Output<V>> outputs(fields.size());
    parallel_for(fields.size(), [&](std::size_t k) {
      Task<V> task;
      task.region = fields[k];
      std::optional<Looked_through> looked;
      if (!through.empty() && !through[k].empty())
        task.through = &looked.emplace(Looked_through{through[k], plane_with_the_eye_behind(through[k].back())});
      if (!chunks_.boxes().nodes().empty()) task.boxes.push_back({0, 0});
      outputs[k].root = solve_in_parallel(std::move(task), share, outputs[k]);
    });
    Surface surface;
    for (const Output<V>& out : outputs) surface.roots.push_back(append(out, out.root, surface));
    surface.counters.pieces = view_.scene().pieces().size();
    seen_.list_in(surface);
    surface.cones = std::move(fields);
    return surface;
  }

 private:
  Prepared_plane plane_with_the_eye_behind(std::uint32_t piece) const {
    const auto support = view_.scene().pieces()[piece].support;
    return view_.scene().prepared(view_.eye_side(piece) == CGAL::POSITIVE ? support.opposite() : support);
  }

  // ---- One region

  /// Drops what is hidden in the region, opens boxes, and returns the plane to cut it by; none where it is settled.
  std::optional<Plane> settle(Task<V>& task, Visible_counters& counters) const {
    std::size_t checked = 0;     // items before this have been compared with the cover
    std::vector<Hiding> hiding;  // of the cover, then of what else covers the region
    std::vector<std::uint32_t> others;
    std::ptrdiff_t enough = 6;
    for (;;) {
      bool changed = hiding.empty() && task.has_cover();
      if (covers_.find_cover(task, checked, counters)) {
        others.clear();
        changed = true;
      }
      if (covers_.find_others(task, checked, others, counters)) {
        checked = 0;
        changed = true;
      }
      if (changed) {
        hiding.assign(1, covers_.hiding_in(task.region, task.cover));
        for (const std::uint32_t other : others) hiding.push_back(covers_.hiding_in(task.region, other));
        covers_.drop_hidden_boxes(task, hiding, counters);
      }
      covers_.drop_hidden(task, checked, others, counters);
      checked = task.items.size();
      if (task.boxes.empty()) break;
      if (has_edges(task, enough)) {
        if (!cuts_.wants_more(task)) break;
        enough = 2 * std::ssize(task.items);
      }
      open_nearest(task, hiding, counters);
    }
    if (task.items.empty()) return std::nullopt;
    return cuts_.choose(task, counters);
  }
  /// Whether there are pieces enough to choose a cut from; one that covers the region offers no edge.
  static bool has_edges(const Task<V>& task, std::ptrdiff_t enough) {
    if (std::ssize(task.items) < enough) return false;
    return std::count_if(task.items.begin(), task.items.end(), [](const Item& item) { return !item.covers(); }) >=
           enough;
  }

  void open_nearest(Task<V>& task, const std::vector<Hiding>& hiding, Visible_counters& counters) const {
    std::pop_heap(task.boxes.begin(), task.boxes.end());
    const Closed_box opened = task.boxes.back();
    task.boxes.pop_back();
    ++counters.opened;
    const Piece_boxes::Node& node = chunks_.node(opened);
    if (node.second == 0) {
      add_chunks(node, task, counters);
      return;
    }
    add_box(opened.node + 1, task, hiding, counters);
    add_box(node.second, task, hiding, counters);
  }
  void add_box(std::uint32_t child, Task<V>& task, const std::vector<Hiding>& hiding,
               Visible_counters& counters) const {
    const Piece_boxes::Node& node = chunks_.boxes().nodes()[child];
    if (chunks_.is_outside(node, task.region)) return;
    if (task.through != nullptr && task.through->passes(node.box)) return;
    const double distance = chunks_.distance(node.box);
    if (Hiding::any_hides(hiding, node.box, distance)) {
      ++counters.hidden_boxes;
      return;
    }
    task.boxes.push_back({child, distance});
    std::push_heap(task.boxes.begin(), task.boxes.end());
  }
  void add_chunks(const Piece_boxes::Node& leaf, Task<V>& task, Visible_counters& counters) const {
    for (std::uint32_t chunk = leaf.first; chunk < leaf.first + leaf.count; ++chunk) {
      const std::uint32_t piece = chunks_.piece_of(chunk);
      if (view_.eye_side(piece) == CGAL::ZERO || (task.through != nullptr && task.through->has(piece))) continue;
      ++counters.looked_at;
      if (chunks_.is_outside(chunk, task.region, counters.predicates)) continue;
      Item item = chunks_.with_all_edges(chunk);
      if (chunks_.update(item, task.region, counters.predicates)) task.items.push_back(item);
    }
  }

  /// A region in which one piece is seen, or none. Returns its leaf.
  std::int32_t finish(const Task<V>& task, double share, Output<V>& out) {
    const std::uint32_t piece = task.has_cover() ? chunks_.piece_of(task.cover) : Surface::nothing;
    ++out.counters.regions;
    out.counters.depth = std::max<std::uint64_t>(out.counters.depth, task.depth);
    if (task.has_cover()) {
      seen_.note(piece);
      Predicate_counts uncounted;  // which regions ask depends on which thread is first to see a face
      for (const std::uint32_t chunk : task.tied) {
        const std::uint32_t other = chunks_.piece_of(chunk);
        if (!seen_.has(other) && chunks_.meets(chunk, task.region, uncounted)) seen_.note(other);
      }
    }
    done_.add(share);
    return out.add(piece, task.region);
  }

  // ---- Its two parts

  std::array<Task<V>, 2> divide(const Task<V>& task, const Plane& w, Output<V>& out) const {
    Predicate_counts& counts = out.counters.predicates;
    std::array<Region<V>, 2> regions = cut(view_, task.region, w, counts);
    ++out.counters.splits;
    return {part_of(task, std::move(regions[0]), w, counts),
            part_of(task, std::move(regions[1]), view_.opposite(w), counts)};
  }
  /// The part of a region in front of one side of it.
  Task<V> part_of(const Task<V>& task, Region<V> region, const Plane& side, Predicate_counts& counts) const {
    Task<V> part;
    part.region = std::move(region);
    part.cover = task.cover;
    part.tied = task.tied;
    part.depth = task.depth + 1;
    part.through = task.through;
    if (is_flat(part)) return part;
    for (const Closed_box& box : task.boxes)
      if (!chunks_.is_behind(chunks_.node(box), side)) part.boxes.push_back(box);
    std::make_heap(part.boxes.begin(), part.boxes.end());
    for (Item item : task.items)
      if (item.covers() || (!chunks_.is_behind(item.chunk, side, counts) && chunks_.update(item, part.region, counts)))
        part.items.push_back(item);
    return part;
  }
  static bool is_flat(const Task<V>& task) { return task.region.rays.size() < 3; }  // inexact signs only

  // ---- All of them

  static constexpr std::uint32_t parallel_depth = 10;

  /// Returns the tree of what a region became: a child as nodes have it.
  std::int32_t solve_in_parallel(Task<V> task, double share, Output<V>& out) {
    if (task.depth >= parallel_depth || threads_ == 1) return solve_alone(std::move(task), share, out);
    if (is_flat(task)) return Surface::no_child;
    const std::optional<Plane> w = settle(task, out.counters);
    if (!w) return finish(task, share, out);
    std::array<Task<V>, 2> tasks = divide(task, *w, out);
    Output<V> second;
    std::array<std::int32_t, 2> children;
    parallel_invoke([&] { children[0] = solve_in_parallel(std::move(tasks[0]), share / 2, out); },
                    [&] { children[1] = solve_in_parallel(std::move(tasks[1]), share / 2, second); });
    children[1] = append(second, children[1], out);
    return out.merge(*w, children, task.region);
  }

  /// The same without recursion, which could go deep.
  std::int32_t solve_alone(Task<V> first, double share, Output<V>& out) {
    struct Step {
      Task<V> task;
      std::optional<Plane> cut;  // where both parts are done
    };
    const std::uint32_t depth = first.depth;
    const auto share_of = [&](const Task<V>& task) {
      return std::ldexp(share, -static_cast<int>(std::min(task.depth - depth, 1000u)));
    };
    std::vector<Step> steps;
    std::vector<std::int32_t> done;
    steps.push_back({std::move(first), std::nullopt});
    while (!steps.empty()) {
      Step step = std::move(steps.back());
      steps.pop_back();
      if (step.cut) {
        const std::array<std::int32_t, 2> children{done[done.size() - 2], done.back()};
        done.resize(done.size() - 2);
        done.push_back(out.merge(*step.cut, children, step.task.region));
      } else if (is_flat(step.task)) {
        done.push_back(Surface::no_child);
      } else if (const std::optional<Plane> w = settle(step.task, out.counters); !w) {
        done.push_back(finish(step.task, share_of(step.task), out));
      } else {
        std::array<Task<V>, 2> tasks = divide(step.task, *w, out);
        step.task.items = {};
        step.task.boxes = {};
        step.task.tied = {};
        step.cut = w;
        steps.push_back(std::move(step));
        steps.push_back({std::move(tasks[1]), std::nullopt});
        steps.push_back({std::move(tasks[0]), std::nullopt});
      }
    }
    return done.back();
  }

  const V& view_;
  Chunks<V> chunks_;
  Cover_search<V> covers_;
  Choice cuts_;
  int threads_;
  Seen_faces<V> seen_;
  Share_done done_;
};

}  // namespace sightline::visible_detail
