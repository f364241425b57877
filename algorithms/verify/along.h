#pragma once
// Checks when an eye that moves along a segment sees which faces, without trusting, or sharing a line with, whatever
// found it: rationals and integers only. Laws: proofs/along_certificate.md (P-127).

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/moments.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <vector>

namespace sightline {

/// The claim "an eye at from + t (to - from), t from 0 to 1, sees these faces then, and at no other t". The fragments
/// are the convex pieces of the scene, in any order; all else refers to them, and to the moments, by their places.
struct Along_certificate : Covering {
  Exact_point from, to;
  bool two_sided = false;            ///< a fragment's back counts as visible too
  std::vector<Path_moment> moments;  ///< in order, from 0 to 1

  /// From a moment to another one, without these two; or one moment, both being the same.
  struct Range {
    std::size_t low = 0, high = 0;
  };
  /// When a face is seen. One that is not listed is not seen.
  struct Face {
    Face_id face = 0;
    std::vector<Range> seen;  ///< in order, without a place in common
  };
  std::vector<Face> faces;

  /// A plane that the eye takes along, through a line and itself: the line from a corner of a fragment to the next one;
  /// or where a fragment's plane meets that of the fragment that a proof is about.
  struct Side {
    enum class Kind { edge, meet } kind = Kind::edge;
    std::size_t fragment = 0, corner = 0;
    int sign = 1;  ///< which side of it is meant
  };
  /// A cut has first the part on the side that is meant, then the other one. A leaf is behind a fragment.
  struct Node {
    bool is_cut = false;
    Side cut;
    std::size_t blocked = 0;
  };
  /// Proves, for a range, that a fragment is seen: in a cone that nothing is in front of, given by its sides in order;
  /// or that it is not, by a tree of cones in preorder.
  struct Proof {
    std::size_t fragment = 0;
    bool from_behind = false;
    Range range;
    std::vector<Side> cone;  ///< none: it is not seen
    std::vector<Node> tree;
  };
  std::vector<Proof> proofs;
};

/// Whether the certificate proves when each face is seen: (1) the fragments are the scene (as for orders); (2) the
/// moments are roots in order; (3) each cone is, throughout its range, one in which the eye sees its fragment, and each
/// tree shows that there is none; (4) for each face that is drawn, at each moment and between each two that follow each
/// other, this is shown of what is claimed. Degenerate: a fragment whose plane the eye is in, or strictly before on the
/// wrong side, is not seen, and needs no proof; where the path is in a plane all along, what is in it hides nothing. At
/// a moment at which the eye is on no fragment, what is not seen just before or just after is not seen. Pre: none on
/// the certificate; rejects whatever is wrong with it. Post: `why` is one line. Cost: of a cone, the fragments; of a
/// tree, its nodes; each times the sides of cones. Cones of more than 1000 sides are rejected. Parallel. Exact: yes,
/// without filters. Proof: P-21, P-22, P-127
Verdict verify_along(const Polygon_soup& soup, const Along_certificate& certificate,
                     const Verify_options& options = {});

}  // namespace sightline
