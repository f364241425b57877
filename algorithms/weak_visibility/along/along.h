#pragma once
// What an eye that moves along a segment sees, and exactly when that changes.

#include <sightline/algorithms/weak_visibility/along/piece_along.h>
#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sightline {

struct Along_options {
  bool two_sided = false;
  bool with_proofs = false;  ///< what a certificate needs is kept
  int threads = 0;           ///< 0: as many as there are processors; the result is the same for any number
  std::function<void(std::size_t done, std::size_t all)> progress = {};  ///< by any thread
};

/// A moment of [0, 1] at which what is seen is not what is seen just before and just after. At 0 and 1 what is seen
/// there stands for what there is not.
struct Along_event {
  /// A face that changes, and by what: the kind of event, and edges that the eye sees through one point.
  struct Change {
    Face_id face;
    bool before, at, after;  ///< whether it is seen
    Along_kind kind;
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< each a piece and the corner that it begins at
  };
  Quadratic_root t;
  std::vector<Change> changes;  ///< by face
};

struct Visible_along {
  struct Face {
    Face_id face;
    std::vector<Parameter_range> seen;  ///< open, in order, disjoint
    std::vector<Rational> moments;      ///< at which it is seen, within none of these ranges: contacts and ends
  };
  std::vector<Face> faces;                         ///< kept ones, by id
  std::vector<Along_event> events;                 ///< in order
  std::vector<Face_id> at_start, at_end, visible;  ///< at 0, at 1, at some moment between them
  Along_counters counters;
  std::vector<Along_proof> proofs;  ///< if asked for
};

/// The faces that an eye sees on its way from one point to another, by the law of what is visible from a point
/// (`see`), at every moment t: the eye is at from + t (to - from). Degenerate: where the path is in a face's plane, the
/// face is edge-on; where it touches faces or passes through them, these do not hide what the eye at that moment sees;
/// all of it may be events at once, or none. Errors: std::invalid_argument where the path has no length. Cost: follows
/// what is in front of each face and how often that changes. Parallel. Exact: yes. Ref: Plantinga. Proof: P-87
Visible_along visible_along(const Occluders& occluders, const Exact_point& from, const Exact_point& to,
                            const Along_options& options = {});

}  // namespace sightline
