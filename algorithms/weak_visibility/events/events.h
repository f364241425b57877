#pragma once
// Which faces are weakly visible, by Plantinga's events.

#include <sightline/algorithms/weak_visibility/events/event_search.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace sightline {

/// A strip of lines from source to target that touch edges and are not blocked, but for what they touch: at a few
/// places of an active subrange.
struct Event_surface {
  Event_kind kind;
  std::uint32_t piece, source;
  std::vector<std::array<Exact_point, 2>> rulings;  ///< p_1(s), p_2(s), in the file's coordinates
};

/// Whether a part of a piece is weakly visible from a source: what they have in front of each other, some lines at
/// random, then events. Post and exactness as of weakly_visible_by_events. Pre: a strictly convex part, with the
/// piece's orientation.
Events_answer part_visible_by_events(const Occluders& occluders, const Weak_source& source, const Near_polygon& part,
                                     std::uint32_t piece, const Events_options& options, Event_counters& counters,
                                     const std::function<void(const Event_search::Surface&)>& keep = {});
inline Events_answer weakly_visible_by_events(const Occluders& occluders, const Weak_source& source,
                                              std::uint32_t piece, const Events_options& options,
                                              Event_counters& counters,
                                              const std::function<void(const Event_search::Surface&)>& keep = {}) {
  return part_visible_by_events(occluders, source, occluders.polygon(piece), piece, options, counters, keep);
}

/// What was found, and a sightline for what is visible.
struct Weakly_visible_by_events : Weak_faces {
  struct Pair {
    std::uint32_t piece, source;
    Events_answer answer;
  };
  std::vector<Pair> sightlines;  ///< one for each visible face, in their order
  std::vector<Event_surface> surfaces;
  Event_counters counters;
};

/// The faces that are weakly visible from at least one of the sources, in the sense of weakly_visible, found by events:
/// another method, slower where there are many edges, that needs no case left open where edges are parallel, coplanar,
/// concurrent or the same. It stops at the first source and piece that show a face, unless surfaces are kept. Post: the
/// same at any number of threads, unless time runs out; each visible face has a sightline that was tested against all
/// pieces. Cost: one Event_search for each pair of a source and a piece. Exact: yes, or undecided where the budget ran
/// out. Ref: Plantinga; design.md, section 4. Proof: P-73
Weakly_visible_by_events weakly_visible_by_events(const Occluders& occluders, const std::vector<Weak_source>& sources,
                                                  const Events_options& options = {});

}  // namespace sightline
