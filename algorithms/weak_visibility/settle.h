#pragma once
// What a search among lines leaves open: its cells, a second search that decides most of them, and events for the rest.

#include <sightline/algorithms/weak_visibility/events/event_search.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// A cell of lines that a search left open: from a part of the source to a part of the target, passing edges on given
/// sides.
struct Open_cell {
  std::vector<Exact_point> source, target;  ///< convex, in the file's coordinates
  /// The side of the line through a corner of a piece and the next one: 1 or -1, the sign of det[p, q, corner, next]
  /// for p in the source and q in the target.
  struct Side {
    Weak_line edge;
    int sign;
  };
  std::vector<Side> sides;
};

/// The first open cells of a pair, as many as are asked for, in the order of its search. Degenerate: none where the
/// pair is decided. Cost: steps of the proof, times its depth. Exact: yes
std::vector<Open_cell> open_cells(const Occluders& occluders, const Weak_source& source,
                                  const Weakly_visible::Pair& pair, std::size_t most);

/// The edges of the pieces that may come between a source and a target, with their own: what the cost of events goes
/// by.
std::size_t edges_between(const Occluders& occluders, const Near_polygon& source, const Near_polygon& target);
inline std::size_t edges_between(const Occluders& occluders, const Weak_source& source, std::uint32_t piece) {
  return edges_between(occluders, source.polygon, occluders.polygon(piece));
}

/// What events say of a pair that a search left open: of the whole, or, where more than so many edges are near that, of
/// the parts of source and target that open cells have: each free line is in a cell that is open. Post: undecided where
/// too many edges are near a part too. Cost: at most one Event_search for each part. Exact: yes
Events_answer open_pair_by_events(const Occluders& occluders, const Weak_source& source,
                                  const Weakly_visible::Pair& pair, std::size_t most_edges,
                                  const Events_options& options, Event_counters& counters);

/// What events found of a pair, as a search among lines would say it; where hidden, without a proof.
Weak_answer weak_answer(const Events_answer& found);

/// With more edges near, events take longer than anybody waits.
inline constexpr std::size_t usual_event_edges = 300;

/// Takes what a search left undecided to a second one, by dearer means (Weak_search_options::thorough): of 56 faces
/// that the first one leaves in 3,003 degenerate scenes it decides all, with their proofs. It gives up a pair with the
/// first cell that stays open; what it leaves undecided keeps the open cells of the first search. Pre: found by
/// weakly_visible(..., search). Post: as of weakly_visible(). Cost: at most 300 cells a pair, with programs in
/// rationals: milliseconds as a rule, seconds where edges are a few ulps from concurrent. Exact: yes. Proof: P-71,
/// P-71h
void search_thoroughly(const Occluders& occluders, const std::vector<Weak_source>& sources, Weak_options search,
                       Weakly_visible& found);

/// Takes what is undecided to events, pair by pair, where the pieces that may come between, or between the parts that
/// are open, have no more than so many edges. A face that is found visible gets its pair; one that is found hidden is
/// unproved; a face of which some pair stays open stays undecided. Pre: each undecided face has its open pairs, as
/// weakly_visible() leaves them. Post: the same at any number of threads, unless time runs out. Exceptions of
/// `progress` end it. Cost: at most one Event_search for each open pair, or for each open part of it. Exact: yes.
/// Proof: P-73
Event_counters settle_by_events(const Occluders& occluders, const std::vector<Weak_source>& sources,
                                std::size_t most_edges, const Events_options& options, Weakly_visible& found);

/// Goes on with what searches and events left undecided, for as long as it takes: in each round events however many
/// edges are near, but only a million of them, in the next sixteen times as many; and then four times the cells, and
/// cells that may stay open. It ends when nothing is undecided, time runs out, or, after as many rounds as double
/// `most_edges` to all edges, events without a bound leave something. `search`, `most_edges`: what was tried before.
/// Post: as of settle_by_events. Exact: yes. Proof: P-71, P-73
Event_counters decide_the_rest(const Occluders& occluders, const std::vector<Weak_source>& sources, Weak_options search,
                               std::size_t most_edges, Events_options events, Weakly_visible& found);

}  // namespace sightline
