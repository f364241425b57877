#pragma once
// Potentially visible sets, exactly: for each cell of a level the faces that some point of its inside sees.

#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace sightline {

struct Pvs_options {
  Weak_search_options search;
  std::size_t event_edges =
      300;               ///< what a search leaves undecided goes to events where no more edges are near; 0: not
  bool outside = false;  ///< cells too from which there is a way out of a level that has rooms without
  int threads = 0;       ///< 0: as many as there are processors
  std::function<void(std::size_t done, std::size_t all)> progress = {};  ///< faces; called by any thread
};

struct Pvs_counters {
  std::size_t cells = 0;                 ///< that are asked about
  std::size_t faces = 0;                 ///< that look into one of them
  std::size_t pairs = 0, visible = 0;    ///< of a cell and a face
  std::size_t within = 0;                ///< of these, of a cell and a face that looks into it
  std::size_t extended = 0;              ///< by a sightline of a neighbour's, made longer
  std::size_t searched = 0, hidden = 0;  ///< pairs of a portal and a face that were searched; that were found hidden
  std::size_t unreached = 0;             ///< pairs that no search was needed for: hidden from all neighbours
  std::size_t by_events = 0, undecided = 0;
  Weak_counters search;

  template <class Visit>
  static void each(Visit visit) {
    visit("cells", &Pvs_counters::cells, Largest{});
    visit("faces", &Pvs_counters::faces, Largest{});
    visit("pairs", &Pvs_counters::pairs);
    visit("visible", &Pvs_counters::visible);
    visit("within", &Pvs_counters::within);
    visit("extended", &Pvs_counters::extended);
    visit("searched", &Pvs_counters::searched);
    visit("hidden", &Pvs_counters::hidden);
    visit("unreached", &Pvs_counters::unreached);
    visit("by_events", &Pvs_counters::by_events);
    visit("undecided", &Pvs_counters::undecided);
    visit("", &Pvs_counters::search);
  }
};

/// By cell: faces that it sees, and that could not be decided, ascending; the others are hidden from it.
struct Pvs {
  std::vector<char> is_asked;  ///< by cell
  std::vector<std::vector<Face_id>> visible, undecided;
  Pvs_counters counters;
};

namespace levels_detail {
class Pvs_maker;
}

/// The question asked in parts: of the faces whose id is `shard` modulo `shards`. What parts have in common is made
/// once; where time runs out before, each part leaves undecided all but faces that look into a cell.
class Pvs_search {
 public:
  explicit Pvs_search(Level_cells&&, Pvs_options = {}) = delete;
  explicit Pvs_search(const Level_cells& level, Pvs_options options = {});
  ~Pvs_search();
  Pvs ask(std::uint32_t shard, std::uint32_t shards) const;

 private:
  std::unique_ptr<levels_detail::Pvs_maker> maker_;
};

/// By region, whether it has a cell without an end.
std::vector<char> regions_with_a_way_out(const Level_cells& level);

/// By cell, whether it is asked about: rooms without a way out; or all cells that are not solid, where there are none,
/// or `outside` asks for it.
std::vector<char> asked_cells(const Level_cells& level, bool outside);

/// The open parts of a cell's walls, as sources that look out of it.
std::vector<std::vector<Exact_point>> portals_of(const Level_cells& level, Cell_id cell);

/// For each cell that is not solid the faces of which some point of its inside sees a part, in front of them: those
/// that look into it, and those that are weakly visible from an open part of one of its walls, outwards. Asked face by
/// face, from the cells that it looks into on: a cell can only see what the neighbour sees that it looks through, so
/// beyond cells from which a face is hidden nothing is asked. Post: the same at any number of threads, and the union of
/// all parts of a Pvs_search, unless time runs out. Degenerate: grazing is not visibility, as everywhere. Cost: a
/// search for each pair of a cell and a face that is visible, and for each on the border of these. Exact: yes, or
/// undecided. Source: lecture slides "Visibility Computation" (PVS); Plantinga. Proof: P-89
Pvs potentially_visible(const Level_cells& level, const Pvs_options& options = {});

}  // namespace sightline
