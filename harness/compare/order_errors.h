#pragma once
// How wrong an order of fragments is that an inexact method made, measured exactly.

#include <sightline/algorithms/verify/covering.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace sightline {

/// Errors of a back-to-front order against the exact scene. Areas are shares of the area of all faces, each face
/// measured in its projection along the dominant axis of its normal.
struct Order_errors {
  std::uint64_t fragments = 0, degenerate = 0;  ///< given; those that have no area on their face
  std::uint64_t pairs = 0;                      ///< compared; 0 where there were too many
  std::uint64_t wrong = 0;  ///< the earlier one is nearer somewhere, be it by one rounding error at its rim
  std::uint64_t wrong_beyond_rounding = 0;  ///< nearer by more than 2^-20 of the distance somewhere
  Rational lost = 0, overlapping = 0, outside = 0;
};

/// Judges fragments whose vertices may lie off their faces by rounding: each is moved onto the exact plane of its piece
/// along the dominant axis, and stands for its convex hull there. Pairs are compared as `verify` does it, if there are
/// at most max_fragments of them. Cost: quadratic in the fragments, and in the fragments of each piece. Exact: yes.
Order_errors order_errors(const Scene& scene, const Exact_point& eye, std::span<const Order_fragment> fragments,
                          std::size_t max_fragments);

}  // namespace sightline
