#pragma once
// Which faces of a scene are weakly visible from polygons: from some point of them, some point of the face is seen.

#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace sightline {

struct Weak_options {
  Weak_search_options search;
  std::vector<Face_id> faces = {};  ///< to look at, sorted; none: all
  /// Of one source: from how many cells on one search is to hide several pieces that hang together in one plane. It
  /// gets twice as many as they took by themselves, or were saved so, less those that such searches took in vain; 0: at
  /// once, as many as any search; none: never.
  std::optional<std::size_t> together_after = 64;
  int threads = 0;                                                  ///< 0: as many as there are processors
  std::function<void(std::size_t done, std::size_t all)> progress;  ///< faces; called by any thread
};

/// The faces that are weakly visible from at least one of the sources: for some p inside it and some q inside the face,
/// q strictly in front of the source and p strictly in front of the face (or off its plane, where two-sided), no closed
/// face meets the open segment from p to q. Grazing, and cracks of width zero, are not visibility. Degenerate: a face
/// in a source's plane is hidden; faces that coincide or overlap in a plane do not hide one another. Post: the same at
/// any number of threads, unless time runs out. Cost: one search for each pair of a source and a piece at
/// most, see Line_search, and from one source one for several pieces now and then. Exact: yes, or undecided. Ref:
/// Plantinga; design.md, sections 1 and 5. Proof: P-70, P-71, P-72
Weakly_visible weakly_visible(const Occluders& occluders, const std::vector<Weak_source>& sources,
                              const Weak_options& options = {});

}  // namespace sightline
