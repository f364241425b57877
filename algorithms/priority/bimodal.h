#pragma once
// The corner of a convex polygon farthest in front of a plane, in O(log n): distances to a plane are bimodal around a
// convex polygon.

#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <concepts>
#include <cstdint>

namespace sightline {

/// Slope_traits: Partition_traits that know how edges run.
///
///   t.slope(polygon, k, cutter, counts)  whether edge k, from corner k to the next, gains height over the plane
///   (POSITIVE), loses it, or keeps it t.turn(polygon, k, l, counts)        the sign of the turn from edge k to edge l,
///   counterclockwise seen from the polygon's front; ZERO for parallel edges
/// Models: Exact_traits.
template <class T>
concept Slope_traits = Partition_traits<T> && requires(const T t, Convex_polygon<T> polygon, std::uint32_t k,
                                                       typename T::Cutter cutter, Predicate_counts counts) {
  { t.slope(polygon, k, cutter, counts) } -> std::same_as<Sign>;
  { t.turn(polygon, k, k, counts) } -> std::same_as<Sign>;
};

/// A corner of greatest height over an oriented plane. Degenerate: of several one; any, where the polygon is parallel
/// to the plane. Pre: a convex polygon without straight corners, as pieces of a scene and their parts are. Cost: O(log
/// n) slopes and turns. Exact: as the traits are. Source: Fuchs, Kedem, Naylor 1979 mention it and leave it out. Proof:
/// P-36
template <Slope_traits Traits>
std::uint32_t highest_corner(const Traits& traits, const Convex_polygon<Traits>& polygon,
                             const typename Traits::Cutter& cutter, Predicate_counts& counts) {
  const std::uint32_t n = polygon.size;
  const auto rises = [&](std::uint32_t k) { return traits.slope(polygon, k, cutter, counts) == CGAL::POSITIVE; };
  const auto turn = [&](std::uint32_t k) { return traits.turn(polygon, 0, k, counts); };

  // 1. An edge that rises, and one after it that does not. Edges turn once around, so those that rise are consecutive
  // but for where we begin.
  const bool begins_rising = rises(0);
  std::uint32_t low = 0, high = n;
  while (!begins_rising && high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (rises(middle)) {
      low = middle;
      break;
    }
    // What the first edge, which falls or is level, turns to by less than half a circle comes before the rise, the rest
    // after it.
    (turn(middle) == CGAL::NEGATIVE ? high : low) = middle;
  }

  // 2. The last edge of that run. From a first edge that rises, another one is in its run iff it is turned to by less
  // than half a circle.
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    (rises(middle) && !(begins_rising && turn(middle) == CGAL::NEGATIVE) ? low : high) = middle;
  }
  return high % n;
}

}  // namespace sightline
