#pragma once
// Which faces of a scene are weakly visible from polygons: from some point of them, some point of the face is seen.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sightline {

/// A convex polygon that looks to one side: counterclockwise as seen from there. It may be a face of the scene, touch
/// faces or cross them.
struct Weak_source {
  Near_polygon polygon;
  Near_plane plane;
};

/// A source from points in the file's coordinates. Straight corners and repeated points are dropped. Exact: yes.
/// Errors: std::invalid_argument where it has no inside, is not planar or not convex, saying what to do.
Weak_source weak_source(const Occluders& occluders, const std::vector<Exact_point>& points);

/// A piece that a face of the scene consists of, as a source: it looks to the face's front.
inline Weak_source weak_source(const Occluders& occluders, std::uint32_t piece) {
  return {occluders.polygon(piece), occluders.plane(piece)};
}

struct Weak_options {
  Weak_search_options search;
  int threads = 0;                                                  ///< 0: as many as there are processors
  std::function<void(std::size_t done, std::size_t all)> progress;  ///< faces; called by any thread
};

/// Every kept face is in one of the three lists, which are sorted.
struct Weak_faces {
  std::vector<Face_id> visible, hidden, undecided;

  std::vector<Face_id>& of(Weak_status status) {
    return status == Weak_status::visible ? visible : status == Weak_status::hidden ? hidden : undecided;
  }
};

/// What was found, and what proves it.
struct Weakly_visible : Weak_faces {
  struct Pair {
    std::uint32_t piece, source;
    Weak_answer answer;
  };
  std::vector<Pair> pairs;  ///< of a visible face the one pair with a sightline, of a hidden one all pairs; faces in
                            ///< order, then pieces, then sources
  std::vector<Pair> open;   ///< of an undecided face the pairs that are so, in the same order
  std::vector<Face_id> unproved;  ///< faces among the visible and the hidden ones that no pairs prove, sorted: other
                                  ///< methods leave some, weakly_visible() none
  Weak_counters counters;
};

/// The first piece of each face that is kept; pieces of a face are neighbours.
std::vector<std::uint32_t> first_pieces(const std::vector<Piece>& pieces);

/// Calls decide(f, begin, end) for each kept face, the f-th in order, of the pieces from `begin` to before `end`: on so
/// many threads, in any order. After each, progress(done, all) by any thread.
void for_each_face(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& first, int threads,
                   const std::function<void(std::size_t, std::size_t)>& progress,
                   const std::function<void(std::size_t f, std::uint32_t begin, std::uint32_t end)>& decide);

/// The faces that are weakly visible from at least one of the sources: for some p inside it and some q inside the face,
/// q strictly in front of the source and p strictly in front of the face (or off its plane, where two-sided), no closed
/// face meets the open segment from p to q. Grazing, and cracks of width zero, are not visibility. Degenerate: a face
/// in a source's plane is hidden; faces that coincide or overlap in a plane do not hide one another. Post: the same at
/// any number of threads, unless time runs out. Cost: one search for each pair of a source and a piece, see
/// Line_search. Exact: yes, or undecided. Ref: Plantinga; design.md, sections 1 and 5. Proof: P-70, P-71, P-72
Weakly_visible weakly_visible(const Occluders& occluders, const std::vector<Weak_source>& sources,
                              const Weak_options& options = {});

}  // namespace sightline
