#pragma once
// Which cells of a level see each other, exactly.

#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace sightline {

/// Pairs are of two different cells that are asked about, and count once.
struct Cell_pvs_counters {
  std::size_t cells = 0;  ///< that are asked about
  std::size_t pairs = 0, visible = 0;
  std::size_t adjacent = 0;              ///< of these, with a portal between them
  std::size_t by_lines = 0;              ///< along random lines through portals
  std::size_t extended = 0;              ///< along a sightline of another pair's, made longer
  std::size_t told = 0;                  ///< pairs that an earlier cell's flood had decided when they were needed again
  std::size_t searched = 0, hidden = 0;  ///< pairs of portals that were searched; that were found hidden
  std::size_t implied = 0;               ///< pairs of portals hidden since cells beside them are
  std::size_t unreached = 0;             ///< pairs that no search was needed for: hidden from all neighbours
  std::size_t by_events = 0, undecided = 0;
  Weak_counters search;

  template <class Visit>
  static void each(Visit visit) {
    visit("cells", &Cell_pvs_counters::cells, Largest{});
    visit("pairs", &Cell_pvs_counters::pairs);
    visit("visible", &Cell_pvs_counters::visible);
    visit("adjacent", &Cell_pvs_counters::adjacent);
    visit("by_lines", &Cell_pvs_counters::by_lines);
    visit("extended", &Cell_pvs_counters::extended);
    visit("told", &Cell_pvs_counters::told);
    visit("searched", &Cell_pvs_counters::searched);
    visit("hidden", &Cell_pvs_counters::hidden);
    visit("implied", &Cell_pvs_counters::implied);
    visit("unreached", &Cell_pvs_counters::unreached);
    visit("by_events", &Cell_pvs_counters::by_events);
    visit("undecided", &Cell_pvs_counters::undecided);
    visit("", &Cell_pvs_counters::search);
  }
};

/// By cell: the other cells that it sees, and those with which it could not be decided, ascending; symmetric.
struct Cell_pvs {
  std::vector<char> is_asked;  ///< by cell
  std::vector<std::vector<Cell_id>> visible, undecided;
  Cell_pvs_counters counters;
};

/// The question asked in parts: of pairs whose lower cell is `shard` modulo `shards`. Parts asked of one object tell
/// each other what they found; parts asked of several find again what they need. Cells whose flood, or its last search,
/// ran out of time are flooded anew when their part is asked again.
class Cell_pvs_search {
 public:
  explicit Cell_pvs_search(Level_cells&&, Pvs_options = {}) = delete;
  explicit Cell_pvs_search(const Level_cells& level, Pvs_options options = {});
  ~Cell_pvs_search();
  Cell_pvs ask(std::uint32_t shard, std::uint32_t shards);

  /// A point inside of each of two cells that are asked about, between which no closed face is; nothing where they do
  /// not see each other, or it is undecided. Exact: yes.
  std::optional<std::array<Exact_point, 2>> sightline(Cell_id from, Cell_id to) const;

 private:
  class Maker;
  std::unique_ptr<Maker> maker_;
};

/// The pairs of cells of which some point of the one's inside sees some point of the other's: no closed face meets the
/// segment between them. Portals hide nothing. Asked cell by cell, outwards: a cell can only see what the neighbour
/// sees that it looks through. Most that is visible is so along random lines through portals; the rest is searched,
/// from portal to portal. Post: symmetric; the same at any number of threads, and the union of all parts, unless
/// something is undecided. Degenerate: cells that touch in faces, edges or corners alone may be hidden from each other;
/// a way of no width is none. Cost: as many searches as pairs of portals of visible pairs that no line shows, and of
/// pairs on the border of these; in parts that are asked of several objects up to twice as many. Exact: yes, or
/// undecided. Source: lecture slides "Visibility Computation" (PVS). Proof: P-90
Cell_pvs mutually_visible_cells(const Level_cells& level, const Pvs_options& options = {});

/// Which leaves of the tree that space was divided by see each other: rows[a][b] for leaves a and b, of `leaves`. Each
/// sees itself; two do where some cell of the one and some cell of the other do, or could not be decided. Exact: yes,
/// or more where something is undecided.
std::vector<std::vector<bool>> visible_leaves(const Level_cells& level, const Cell_pvs& pvs, std::size_t leaves);

}  // namespace sightline
