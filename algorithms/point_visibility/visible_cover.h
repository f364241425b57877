#pragma once
// What covers a region nearest to the eye, and what is behind that: pieces and boxes that need no further look there.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/algorithms/point_visibility/visible_chunks.h>
#include <sightline/algorithms/point_visibility/visible_region.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/prepared_plane.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sightline::visible_detail {

/// What the cover of a region hides of boxes: those farther than all of it there, those beyond its plane.
struct Hiding {
  double farthest;
  Prepared_plane plane;  // the eye in front
  bool hides(const Piece_boxes::Box& box, double distance) const {
    return distance > farthest || Piece_boxes::is_behind(box, plane);
  }
  static bool any_hides(const std::vector<Hiding>& all, const Piece_boxes::Box& box, double distance) {
    return std::any_of(all.begin(), all.end(), [&](const Hiding& one) { return one.hides(box, distance); });
  }
};

template <View V>
class Cover_search {
 public:
  explicit Cover_search(const Chunks<V>& chunks) : chunks_(chunks), view_(chunks.view()) {}

  // ---- Which of two is nearer

  enum class Depth : char { nearer, tied, farther, crossing };
  /// How chunk f, which covers the region, is to chunk g there. `farther`: g is nearer, or comes first, in all of it.
  Depth compare(std::uint32_t f, std::uint32_t g, const Region<V>& region, Predicate_counts& counts) const {
    const std::uint32_t a = chunks_.piece_of(f), b = chunks_.piece_of(g);
    if (view_.same_plane(a, b)) return chunks_.comes_first(f, g) ? Depth::tied : Depth::farther;
    bool nearer = false, farther = false;
    for (const typename V::Ray& r : region.rays) {
      const Sign s = view_.nearer(a, b, r, counts);
      nearer = nearer || s == CGAL::POSITIVE;
      farther = farther || s == CGAL::NEGATIVE;
      if (nearer && farther) return Depth::crossing;
    }
    return farther ? Depth::farther : Depth::nearer;
  }

  // ---- The cover

  /// Keeps the nearest of what covers the region, apart from the items. Others stay there only where they cross it.
  /// `checked`: items before it have been compared with the cover. Returns whether another one is it.
  bool find_cover(Task<V>& task, std::size_t& checked, Visible_counters& counters) const {
    bool changed = false;
    for (std::size_t i = checked; i < task.items.size();) {
      const Item item = task.items[i];
      const Depth depth = !item.covers()      ? Depth::crossing
                          : !task.has_cover() ? Depth::farther
                                              : compare(task.cover, item.chunk, task.region, counters.predicates);
      const bool stays =
          !item.covers() || (depth == Depth::crossing && !has_side(task.region, crossing_of(task.cover, item.chunk)));
      if (stays) {
        ++i;
        continue;
      }
      task.remove_item(i);
      if (depth == Depth::tied) task.tied.push_back(item.chunk);
      if (depth != Depth::farther) continue;
      replace_cover(task, item.chunk);
      checked = i = 0;
      changed = true;  // all others once more
    }
    return changed;
  }

  /// Adds to `others` what else covers the region among the items from `checked` on, each crossing the cover there, the
  /// nearer of two that do not cross each other: in a lattice each direction of squares has its own. They hide as the
  /// cover does. Returns whether there are new ones.
  bool find_others(const Task<V>& task, std::size_t checked, std::vector<std::uint32_t>& others,
                   Visible_counters& counters) const {
    constexpr std::size_t most = 8;  // what does not hide costs only that more is looked at
    bool changed = false;
    for (std::size_t i = checked; i < task.items.size(); ++i) {
      if (!task.items[i].covers()) continue;
      const std::uint32_t chunk = task.items[i].chunk;
      const auto hides_chunk = [&](std::uint32_t other) {
        return chunks_.same_plane(other, chunk) ||
               compare(other, chunk, task.region, counters.predicates) == Depth::nearer;
      };
      if (std::any_of(others.begin(), others.end(), hides_chunk)) continue;
      std::erase_if(others, [&](std::uint32_t other) {
        return compare(chunk, other, task.region, counters.predicates) == Depth::nearer;
      });
      if (others.size() == most) continue;
      others.push_back(chunk);
      changed = true;
    }
    return changed;
  }

  // ---- What is behind it

  /// Drops what is behind the cover of the items from `checked` on, and what is behind the others.
  void drop_hidden(Task<V>& task, std::size_t checked, const std::vector<std::uint32_t>& others,
                   Visible_counters& counters) const {
    if (!task.has_cover()) return;
    for (std::size_t i = checked; i < task.items.size();) {
      const Item item = task.items[i];
      const Depth depth = compare(task.cover, item.chunk, task.region, counters.predicates);
      const bool drop =
          depth == Depth::nearer || depth == Depth::tied ||
          (depth == Depth::crossing && !item.covers() && is_beyond(task.cover, item.chunk, counters.predicates)) ||
          std::any_of(others.begin(), others.end(), [&](std::uint32_t other) {
            return other != item.chunk && is_hidden_by(other, item, task.region, counters.predicates);
          });
      if (depth == Depth::tied) task.tied.push_back(item.chunk);
      counters.hidden += drop;
      if (drop) task.remove_item(i);
      else ++i;
    }
  }
  void drop_hidden_boxes(Task<V>& task, const std::vector<Hiding>& hiding, Visible_counters& counters) const {
    counters.hidden_boxes += std::erase_if(task.boxes, [&](const Closed_box& box) {
      return Hiding::any_hides(hiding, chunks_.node(box).box, box.distance);
    });
    std::make_heap(task.boxes.begin(), task.boxes.end());
  }
  /// Pre: the chunk covers the region.
  Hiding hiding_in(const Region<V>& region, std::uint32_t chunk) const {
    const std::uint32_t cover = chunks_.piece_of(chunk);
    double farthest = 0;  // of a polygon, so at a corner
    for (const typename V::Ray& r : region.rays) farthest = std::max(farthest, view_.farthest(cover, r));
    const Plane support = view_.scene().pieces()[cover].support;
    return {farthest * (1 + 0x1p-40) + 4 * chunks_.eye().error + 0x1p-900,
            view_.scene().prepared(view_.eye_side(cover) == CGAL::POSITIVE ? support : support.opposite())};
  }

 private:
  /// Whether an item is behind chunk f, which covers the region, and not in its plane: what is tied is noted with the
  /// cover only.
  bool is_hidden_by(std::uint32_t f, const Item& item, const Region<V>& region, Predicate_counts& counts) const {
    const Depth depth = compare(f, item.chunk, region, counts);
    return depth == Depth::nearer || (depth == Depth::crossing && !item.covers() && is_beyond(f, item.chunk, counts));
  }
  /// Whether chunk g is behind f, which covers the region, although their planes cross there: no corner of it is on the
  /// eye's side of f's plane.
  bool is_beyond(std::uint32_t f, std::uint32_t g, Predicate_counts& counts) const {
    const std::uint32_t piece = chunks_.piece_of(f);
    const std::span<const std::uint32_t> points = chunks_.points_of(g);
    return std::all_of(points.begin(), points.end(),
                       [&](std::uint32_t p) { return view_.beyond(piece, p, counts) != CGAL::NEGATIVE; });
  }
  Eye_plane_name crossing_of(std::uint32_t f, std::uint32_t g) const {
    return Eye_plane_name::crossing(chunks_.piece_of(f), chunks_.piece_of(g));
  }
  void replace_cover(Task<V>& task, std::uint32_t chunk) const {
    if (task.has_cover() && chunks_.same_plane(task.cover, chunk)) task.tied.push_back(task.cover);
    else task.tied.clear();
    task.cover = chunk;
  }

  const Chunks<V>& chunks_;
  const V& view_;
};

}  // namespace sightline::visible_detail
