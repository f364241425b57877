#pragma once
// What an eye sees, as a partition of its directions.

#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/sign.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace sightline {

struct Visible_options {
  int threads = 0;  ///< 0: as many as there are processors; the result is the same for any number
  std::function<void(std::size_t done, std::size_t all)> progress =
      {};  ///< directions done, of 2^20; called from any thread
};

/// What was modelled, and what was not.
struct Visible_counters {
  std::uint64_t pieces = 0;                    ///< of the scene
  std::uint64_t opened = 0, looked_at = 0;     ///< boxes opened; pieces that were looked at in a region, each time
  std::uint64_t hidden = 0, hidden_boxes = 0;  ///< pieces and boxes dropped behind what covers a region
  std::uint64_t
      regions = 0,
      splits = 0, crossings = 0,
      merged = 0;  ///< leaves; cuts, of them along a line where two pieces cross; pairs of leaves put together again
  std::uint64_t depth = 0;
  Predicate_counts predicates;  ///< but those that tell which faces in one plane are seen where another is shown
  /// Each by its key in reports, in their order, but for what the scene has and predicates.
  template <class Visit>
  static void each(Visit visit) {
    visit("boxes_opened", &Visible_counters::opened);
    visit("looked_at", &Visible_counters::looked_at);
    visit("hidden", &Visible_counters::hidden);
    visit("hidden_boxes", &Visible_counters::hidden_boxes);
    visit("regions", &Visible_counters::regions);
    visit("cuts", &Visible_counters::splits);
    visit("crossings", &Visible_counters::crossings);
    visit("merged", &Visible_counters::merged);
    visit("depth", &Visible_counters::depth, Largest{});
    visit("", &Visible_counters::predicates);
  }
};

/// A partition of the directions around an eye (of a field of view) into convex cones, in each of which one piece is
/// seen, or none.
template <View V>
struct Visible_surface {
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};
  struct Part {
    std::uint32_t piece;  ///< what is seen, from its front or from behind, or `nothing`
    std::uint32_t size;
    /// Rays [first, first + size): each positive determinant of two consecutive ones and one inside.
    std::size_t first;
  };
  /// A cut of a cone, as in a BSP tree: a child is a node, or ~part where it is negative, or `no_child` (of inexact
  /// kernels only).
  struct Node {
    typename V::Plane plane;
    std::int32_t front, behind;
  };
  static constexpr std::int32_t no_child = std::numeric_limits<std::int32_t>::min();
  std::vector<Part> parts;
  std::vector<typename V::Ray> rays;
  std::vector<Node> nodes;
  /// A convex cone: side k holds rays k and k + 1, the inside in its front.
  struct Cone {
    std::vector<typename V::Ray> rays;
    std::vector<typename V::Plane> sides;
  };
  std::vector<Cone> cones;          ///< that one began with
  std::vector<std::int32_t> roots;  ///< of their trees
  /// Sorted: faces of which the eye sees an open part from the front by the law, ties included.
  std::vector<Face_id> visible;
  std::vector<Face_id> from_behind;  ///< the same from behind
  Visible_counters counters;

  std::span<const typename V::Ray> of(const Part& part) const { return {rays.data() + part.first, part.size}; }
};

}  // namespace sightline
