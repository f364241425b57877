#pragma once
// Ways from cell to cell: the open parts of walls, as sources that look onwards, and lines that come through them.

#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace sightline::levels_detail {

/// A way from one cell to the next: an open part of a wall, as a source that looks into that.
struct Way {
  Cell_id from, to;
  Weak_source source;
  std::vector<Pluecker> edges;
  std::vector<Ends> ends;
};

/// A line with a direction, through two points in near coordinates, each exact or rounded once.
struct Way_line {
  Pluecker pair;
  Ends ends;
  Way_line(const Triple& p, const Triple& q);
};

/// Whether a line comes through the inside of a way, from where it begins to where it leads, for certain. A line that
/// does is in both cells beside it, and on no face there: cells are convex and empty. In doubles, with bounds. P-89
bool comes_through(const Way& way, const Way_line& line);

/// The part of a wall as one sees it who looks out of `from`: counterclockwise from where it leads.
std::vector<Exact_point> looking_from(const Level_cells& level, const Cell_wall& wall,
                                      const std::vector<std::uint32_t>& part, Cell_id from);

/// The cells that are asked about, and all ways between them.
class Ways {
 public:
  /// Once out of time there are not all of them.
  Ways(const Level_cells& level, const Occluders& occluders, bool outside, const std::function<bool()>& out_of_time);

  const Way& operator[](std::size_t way) const { return ways_[way]; }
  std::size_t count() const { return ways_.size(); }
  bool is_whole() const { return is_whole_; }
  /// Ways that lead into a cell.
  const std::vector<std::size_t>& into(Cell_id cell) const { return into_[cell]; }
  /// The same open part the other way round.
  static std::size_t back(std::size_t way) { return way ^ 1u; }
  const std::vector<char>& is_asked() const { return is_asked_; }
  std::size_t cells_asked() const { return cells_asked_; }

 private:
  void add(Cell_id from, Cell_id to, Weak_source source);

  std::vector<Way> ways_;  // each beside its way back
  std::vector<std::vector<std::size_t>> into_;
  std::vector<char> is_asked_;
  std::size_t cells_asked_ = 0;
  bool is_whole_ = true;
};

/// Whether a face is visible from a source that searches left undecided: by events, and then by longer searches, for as
/// long as it takes. The sightline where it is.
Weak_answer visible_at_any_cost(const Occluders& occluders, const Weak_source& source, Face_id face,
                                const Pvs_options& options);

}  // namespace sightline::levels_detail
