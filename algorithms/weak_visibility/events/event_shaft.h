#pragma once
// The lines between two convex polygons in parts, each from a part of the one to a part of the other: those that pieces
// surely block are left out before any event is made, those that are left have few edges each.

#include <sightline/algorithms/weak_visibility/events/event_lines.h>
#include <sightline/algorithms/weak_visibility/events/event_search.h>
#include <sightline/algorithms/weak_visibility/events/homogeneous.h>
#include <sightline/algorithms/weak_visibility/events/sign_cover.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

/// Halves source and target again and again, the longer one first, until pieces block all lines of a part, or it has so
/// few edges that its events are cheaper than its halves. Where a line in its middle is free, the pair is visible. In
/// doubles with bounds: what these do not tell stays. Degenerate: where edges meet in a line that stays in parts, these
/// are put together again as far as that is cheaper. Cost: no more than what is expected of the events that it may
/// save. Exact: yes. Proof: P-73
class Event_shaft {
 public:
  struct Part {
    Near_polygon source, target;
    std::vector<std::uint32_t> pieces;  ///< all that may block any of its lines
  };
  struct Parts {
    std::vector<Part> left;                              ///< all free lines are in these, up to a set of measure zero
    bool is_whole = false;                               ///< nothing is left out: `left` is empty
    std::optional<std::array<Near_point, 2>> sightline;  ///< then nothing else counts
  };

  Event_shaft(const Occluders& occluders, const Event_lines& scene, const Events_options& options,
              Event_counters& counters);

  Parts divided();

 private:
  /// A quadrilateral, as that of a polygon at k/2^n and (k+1)/2^n in both directions. Two corners may be one.
  struct Patch {
    std::array<const Homogeneous*, 4> whole;
    std::array<unsigned long, 2> at;
    std::array<unsigned long, 2> halvings;
    std::array<Near<4>, 4> corners;  // from (0, 0) counterclockwise

    double length(std::size_t axis) const;
    std::array<Patch, 2> halves(std::size_t axis) const;
    /// The point at (u, v) / 2^more within it.
    Homogeneous point(unsigned long u, unsigned long v, unsigned long more) const;
    Near_polygon polygon(const Near_frame& frame) const;
  };
  struct Cell {
    Patch source, target;
  };
  /// All joins of corners, with one bound of their size and of their error.
  struct Joins {
    std::array<std::array<double, 16>, 6> at;
    double size, error;
  };
  using Numbers = std::vector<std::uint32_t>;

  static std::vector<Patch> patches(std::span<const Filtered> polygon);
  static Joins joins(const Cell& cell);
  /// The side on which all lines of a cell pass a line; 0 where they differ or doubles do not tell.
  static int common_side(const Joins& joins, const Near<6>& line);

  /// What is left of a cell costs so much; its parts are kept. `open`: lines of which the side is not known for all of
  /// it; `blockers`: those that may block some of it.
  double divide(const Cell& cell, const Numbers& open, const Numbers& blockers, double allowance);
  bool is_covered(const Joins& joins, const Numbers& open, const Numbers& blockers, Numbers& still_open,
                  Numbers& still_blocking);
  bool try_middle(const Cell& cell, const Numbers& blockers);
  Part part(const Cell& cell, const Numbers& blockers) const;

  const Occluders* occluders_;
  const Event_lines* scene_;
  const Events_options* options_;
  Event_counters* counters_;
  std::vector<signed char> sides_;  // of all lines of the cell at hand, 0 where open
  std::vector<char> used_;
  Blocked_together together_;
  double spent_ = 0;
  std::vector<std::pair<Cell, Numbers>> left_;
  std::optional<std::array<Near_point, 2>> sightline_;
};

/// Whether some line of the whole shaft is free: by its parts, and events in what is left of them. Post, exactness: as
/// of Event_search.
Events_answer search_shaft(const Occluders& occluders, const Near_polygon& source, const Near_plane& source_plane,
                           const Near_polygon& target, const Near_plane& target_plane, int beside,
                           const Events_options& options, Event_counters& counters);

}  // namespace sightline
