#pragma once
// Which parts of a curve of lines are surely of no use, in doubles: by halves of halves.

#include <sightline/algorithms/weak_visibility/events/event_curve.h>
#include <sightline/algorithms/weak_visibility/events/event_lines.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sightline {

/// A part of a curve is of no use if it is off its edges, does not go from source to target, or is blocked by one
/// piece. It refers to the lines. Exact: where it says so. Proof: P-73
class Curve_halves {
 public:
  /// Why, of all parts the last of these reasons; `no`: some part may be of use.
  enum class Idle : char { no, off_edges, off_polygons, covered };
  /// By line: the side, 1 or -1, on which all of a part passes it, as far as that was asked; else it is something else.
  using Courses = std::span<const signed char>;
  /// Whether pieces together block a part whose lines go from source to target in this direction.
  using Together = std::function<bool(std::span<const std::uint32_t> blockers, int turn, Courses courses)>;
  /// A part that may be of use, as small as they become; whether to go on.
  using Visit = std::function<bool(const Near_part&)>;

  /// `deepest`: how often a curve is halved.
  Curve_halves(const Event_lines& lines, int deepest);
  Idle search(const Event_curve& curve, const Visit& visit, const Together& together = {});

 private:
  Idle search(const Event_curve& curve, const Near_part& part, std::span<const std::uint32_t> blockers, int depth,
              const Visit& visit, const Together& together);
  /// As in Courses, or 0. What a part is sure of, its halves are.
  int course(const Near_part& part, std::uint32_t line, int depth);

  static constexpr signed char unset = 2;
  const Event_lines* lines_;
  int deepest_;
  std::vector<std::uint32_t> all_;
  std::vector<std::vector<signed char>> courses_;  // by depth
};

}  // namespace sightline
