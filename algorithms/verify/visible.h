#pragma once
// Checks the visible surfaces from a point without trusting, or sharing a line with, whatever made them: rationals and
// integers only. Laws: proofs/see_certificate.md (P-63).

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// The claim "in the field, the eye sees these parts of the scene's faces and, in the empty cones, none of them". Parts
/// and empty cones share out the field: each direction of it, but for a set of measure zero, is in one of them. The
/// fragments are the convex pieces of the scene; parts refer to them.
struct Visible_certificate : Covering {
  Exact_point eye;

  /// The extreme rays of a convex pointed cone with an inside, one after the other, in either sense; any lengths but
  /// zero.
  using Directions = std::vector<Exact_point>;
  Directions field;  ///< none: all directions

  Directions rays;  ///< that parts refer to

  /// What is seen of a fragment in one convex cone, from the front or from behind.
  struct Part {
    std::size_t fragment = 0;  ///< its place in the list
    std::vector<Exact_point>
        vertices;     ///< convex, inside the fragment, in its sense: counterclockwise as seen from the face's front
    Exact_point ray;  ///< a direction strictly inside the part's cone, of any length but zero
    /// Instead of these two, where there are any: places in `rays` of the cone's extreme rays, which meet the fragment
    /// in the vertices; one after the other in either sense.
    std::vector<std::uint32_t> rays = {};
  };
  std::vector<Part> parts;
  std::vector<Directions> empty;
};

/// Whether the certificate proves what the eye sees of the scene in the field: (1) the fragments are the scene (as for
/// orders); (2) each part is a convex polygon of positive area inside its fragment, and its ray meets no other before
/// it; (3) where a part's cone and a fragment's overlap in an open set, the fragment is nowhere strictly nearer, and if
/// it is in the part's plane the part's own fragment is preferred; (4) no fragment is in an empty cone; (5) the cones
/// tile the field. Preferred are fragments that the eye is strictly in front of, then those of lower faces, then of
/// lower pieces. Degenerate: fragments seen edge-on (the eye in their plane) are passed over and have no parts; contact
/// in an edge or a point is no overlap; T-junctions of cones are welcome. Pre: none on the certificate; rejects
/// whatever is wrong with it. Post: `why` is one line. Cost: about O(n log n) for n parts, empty cones and fragments,
/// and the pairs that overlap; quadratic at worst. Exact: yes, without filters. Proof: P-63
Verdict verify_visible(const Polygon_soup& soup, const Visible_certificate& certificate,
                       const Verify_options& options = {});

}  // namespace sightline
