#pragma once
// What a point of a receiver sees of a source: all of it, a part, nothing; and the edges that bound what it sees.

#include <sightline/algorithms/weak_visibility/events/event_lines.h>
#include <sightline/algorithms/weak_visibility/events/homogeneous.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

/// Up to measure zero.
enum class Seen_share : char { all, some, none };

/// The part of a source, the target of event lines, that a point of the receiver, their source, sees past blockers.
class Seen_part {
 public:
  struct Corner {
    Homogeneous at;
    std::uint32_t line;  ///< on whose image the edge to the next corner lies
  };
  using Polygon = std::vector<Corner>;

  /// `blockers`: those of the event lines that may block lines from the point. Pre: the point is in the receiver. Cost:
  /// each blocker is taken from each of the convex parts that are left. Exact: yes. Proof: P-86
  Seen_part(const Event_lines& lines, const Homogeneous& point, std::span<const std::uint32_t> blockers);

  Seen_share seen() const { return parts_.empty() ? Seen_share::none : cut_ ? Seen_share::some : Seen_share::all; }
  /// Convex, apart from each other, in the source's plane.
  const std::vector<Polygon>& parts() const { return parts_; }
  /// The lines, by number, whose images bound what is seen, in order. Pre: images of two lines are not one.
  std::vector<std::uint32_t> outline() const;

 private:
  std::vector<Polygon> parts_;
  bool cut_ = false;
};

}  // namespace sightline
