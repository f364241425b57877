#pragma once
// Newell, Newell and Sancha's depth sort: an order to paint in, by five tests a pair, and by cutting what has no order.

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/scene.h>

#include <cstdint>
#include <vector>

namespace sightline {

/// Pairs (P, Q) by the first test that let P be painted before Q; and what was done about the others.
struct Newell_counters {
  std::uint64_t by_depth = 0;     ///< 1: all of P is farther than all of Q; pairs that the sorted list passes over are
                                  ///< not counted
  std::uint64_t by_extents = 0;   ///< 2: apart across or upwards in the image
  std::uint64_t by_behind = 0;    ///< 3: P is behind Q's plane or in it, as seen from the eye
  std::uint64_t by_in_front = 0;  ///< 4: Q is in front of P's plane or in it
  std::uint64_t by_apart = 0;     ///< 5: as seen, they do not overlap
  std::uint64_t swaps = 0;        ///< Q was marked and moved before P
  std::uint64_t splits = 0;       ///< they cross, or Q was marked already: one was cut
  std::uint64_t through_eye = 0;  ///< of these cuts those by a plane through the eye and an edge
  std::uint64_t unordered = 0;    ///< painted with a test failed: rounded numbers found no cut, or made too many
};

/// The polygons to paint, farthest first.
struct Newell_order {
  std::vector<Painted_polygon> polygons;
  Newell_counters counters;
  std::uint64_t edge_on = 0;  ///< pieces in whose plane the eye is, and those that the numbers cannot hold
};

/// Pieces and parts of pieces, none of them before one that it hides. They wait by their farthest depth, along the
/// normal of the image; the farthest one, P, is painted if each Q that is not nearer than all of it passes one of five
/// tests; else Q is marked and painted first, if it may be; else, or if it is marked already, one of the two is cut by
/// the other's plane, or by a plane through the eye and an edge, and both parts wait. Of overlapping pieces of one
/// plane the one that centres() chooses comes last. Nothing is clipped: what reaches behind the eye has no extents, and
/// depths below 0. Degenerate: pieces in whose plane the eye is, or that are beside the image, are left out. Floats and
/// doubles take what is within 16 units of rounding of a plane to be on it, and give up the order where cuts are more
/// than 64 times the pieces, and 4,096. Errors: as centres(). Cost: pairs of polygons whose depths overlap, mostly a
/// comparison of extents each. Exact: as the kernel is. Ref: Newell, Newell, Sancha, A solution to the hidden surface
/// problem, ACM 1972. Proof: P-82
Newell_order newell_order(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel,
                          const Image_options& options = {});

/// That order, painted: exact, it equals centres() but for ties. Errors, cost: as newell_order() and paint(). Parallel,
/// but for the order.
Piece_image newell(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel,
                   const Image_options& options = {});

}  // namespace sightline
