#pragma once
// Checks a back-to-front order without trusting, or sharing a line with, whatever made it: rationals and integers only.
// Laws: proofs/order_certificate.md (P-20 .. P-22).

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstdint>
#include <vector>

namespace sightline {

/// Where a tree of planes cuts a sequence of fragments in two, and its parts again: at the least depth first. A plane
/// has on it or in front what comes before the cut, on it or behind what comes after, and the eye.
struct Order_cuts {
  /// For each fragment, the depth of a cut just before it, and after those next to it of the same depth, by its plane.
  /// Not looked at where they are not as many as fragments.
  std::vector<std::uint32_t> depths;
  /// A cut before fragment `place` by the plane (a, b, c, d): ax + by + cz + d = 0.
  struct Cut {
    std::uint32_t place = 0, depth = 0;
    std::array<Rational, 4> plane;
  };
  std::vector<Cut> others;
};

/// The claim "drawn in this order, every fragment covers only what is not nearer than itself, and the fragments are the
/// scene". Fragments are farthest first.
struct Order_certificate : Covering {
  Exact_point eye;
  /// Of the on-view pieces only: the others, which the eye is not strictly in front of, may be left out.
  bool on_view = false;
  /// What spares the check most pairs. The verdict is the same for any.
  Order_cuts cuts;
};

/// Whether the certificate proves a back-to-front order of the scene: (1) for each two fragments whose cones from the
/// eye overlap in an open set, the earlier one is nowhere nearer than the later one; (2) the fragments of each face
/// that is drawn tile it (its pieces, where it has such; a non-planar face must), but, if it says `on_view`, those that
/// the eye is not in front of may be left out; (3) each face is drawn, or set aside for a true reason. Degenerate:
/// fragments seen edge-on (the eye in their plane) may stand anywhere; contact in an edge or a point is no overlap;
/// equal distance is in order both ways. A face whose edges cross although it winds nowhere but 0 or 1 times may be
/// tiled or set aside. Pre: none on the certificate; rejects whatever is wrong with it. Post: `why` is one line. Cost:
/// about O(n log n) for n fragments and the pairs that overlap, each in the product of their corners at most; quadratic
/// at worst; a set-aside "self-intersecting" face is quadratic in its corners. Exact: yes, without filters. Proof:
/// P-20, P-21, P-22
Verdict verify_order(const Polygon_soup& soup, const Order_certificate& certificate,
                     const Verify_options& options = {});

}  // namespace sightline
