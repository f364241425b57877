#pragma once
// What events between two convex polygons are made of: the lines of edges, and for each piece the signs with which a
// line between the polygons is blocked by it.

#include <sightline/algorithms/weak_visibility/events/homogeneous.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

namespace sightline {

/// Which lines from the inside of a convex source to that of a convex target are blocked, as signs of their sides of
/// lines: of the edges, and of those in which planes of pieces meet source or target, as p is beyond such a plane iff
/// (p, q) passes the line in which it meets the source's plane on one side. Pre: the target is in front of the source's
/// plane, the source on one side of the target's; both may touch. Cost: O(n log n). Exact: yes. Proof: P-73
class Event_lines {
 public:
  struct Event_line {
    Exact_pluecker pluecker;
    bool in_source = false;          ///< in the source's plane
    bool real = false;               ///< whether some of it is an edge that an event may touch: then all of that is
    std::array<Filtered, 2> hull{};  ///< between these points, in the line's direction
    Near<6> near{};
  };
  /// sense * side > 0
  struct Literal {
    std::uint32_t line;
    int sense;
  };
  /// A piece blocks a line iff all literals hold.
  struct Blocker {
    std::uint32_t piece;
    std::vector<Literal> literals;
  };

  /// `beside`: the side of the target's plane, 1 or -1, on which the source is. Pieces come first that are large. Once
  /// out of time, lines are real that nothing from the source to the target touches.
  Event_lines(const Occluders& occluders, const Near_polygon& source, const Near_plane& source_plane,
              const Near_polygon& target, const Near_plane& target_plane, int beside,
              const std::function<bool()>& out_of_time = {})
      : Event_lines(occluders, source, source_plane, target, target_plane, beside, occluders.near_shaft(source, target),
                    out_of_time) {}
  /// Of some pieces only.
  Event_lines(const Occluders& occluders, const Near_polygon& source, const Near_plane& source_plane,
              const Near_polygon& target, const Near_plane& target_plane, int beside,
              std::span<const std::uint32_t> pieces, const std::function<bool()>& out_of_time = {});

  std::span<const Filtered> source() const { return source_; }
  std::span<const Filtered> target() const { return target_; }
  const Near_plane& near_source_plane() const { return near_source_plane_; }
  const Near_plane& near_target_plane() const { return near_target_plane_; }
  const Filtered& source_plane() const { return source_plane_; }
  const Filtered& target_plane() const { return target_plane_; }
  int beside() const { return beside_; }
  const std::vector<Event_line>& lines() const { return lines_; }
  const std::vector<Literal>& from() const { return from_; }  ///< hold iff a line leaves through the source
  const std::vector<Literal>& to() const { return to_; }      ///< hold iff it arrives within the target
  const std::vector<Blocker>& blockers() const { return blockers_; }
  /// Edges that no line from the source to the target touches, by the signs of lines through their ends: not real.
  std::size_t untouched() const { return untouched_; }

  /// Whether a point on a line's real part. Pre: it is on the line, and real.
  static bool in_hull(const Event_line& line, const Homogeneous& x);

  /// Whether some line through a point, or two, that goes from the source to the target may have all of these, given
  /// such lines between which it is: not where one fails on all of them. In doubles: true where these do not tell.
  bool may_pass(std::span<const Near<6>> between, const std::vector<Literal>& literals) const;

 private:
  /// The line's number, the same for all edges on it.
  std::uint32_t line(Exact_pluecker pluecker);
  std::uint32_t edge(const Homogeneous& a, const Homogeneous& b);
  int sense_of(const Homogeneous& a, const Homogeneous& b, std::uint32_t number) const;
  /// Whether both points are behind the source, or both beyond the target.
  bool is_outside(const Near_point& a, const Near_point& b) const;
  /// The line in which a piece's plane meets that of the source or the target; where the piece itself crosses, an edge.
  std::uint32_t trace(const Near_polygon& polygon, const Near_plane& plane, const Near_plane& other);

  void add_piece(const Occluders& occluders, std::uint32_t piece);

  bool is_touched(const Event_line& line) const;

  Near_polygon source_polygon_, target_polygon_;
  Near_plane near_source_plane_, near_target_plane_;
  Filtered source_plane_, target_plane_;
  std::vector<Filtered> source_, target_;
  std::size_t untouched_ = 0;
  int beside_;
  std::map<Exact_pluecker, std::uint32_t, Less_entries> numbers_;
  std::vector<Event_line> lines_;
  std::vector<Literal> from_, to_;
  std::vector<Blocker> blockers_;
};

/// Exact: yes
inline int side(const Joined_line& joined, const Event_lines::Event_line& line) {
  const int sure = certain_side(joined.near(), line.near);
  return sure != 0 ? sure : sgn(side(joined.exact(), line.pluecker));
}

}  // namespace sightline
