#pragma once
// Planar polygons with holes, cut into convex pieces without a new coordinate.
//
// The contour's edges become constraints of a Delaunay triangulation (CGAL). Each edge of the triangulation counts how
// often the contour runs along it, so the winding number of each triangle follows from its neighbour's, starting with 0
// outside. The triangles of winding number 1 are the polygon; merging them while they stay convex gives the pieces.
//
// Laws, for every input:
//   L1  contour == simple  iff  no two edges cross, unless in a point that a loop uses (all others would be new
//   coordinates),
//       every winding number is 0 or 1, and some is 1.
//   L2  contour == simple: the pieces have disjoint interiors and their union is the closure of {winding number == 1}.
//   L3  Every corner of a piece is an index that a loop uses. Of indices with equal coordinates the least stands for
//   all. L4  Beginning a loop at another point, reversing a hole and reordering holes change neither the contour's kind
//   nor the union.

#include <sightline/kernel/number.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

/// A point of the plane with exact coordinates of any size.
struct Planar_point {
  Integer x, y;
};

/// What the loops of a polygon bound.
enum class Contour {
  simple,  ///< weakly simple: spikes, keyholes, straight and repeated points, touching vertices and edges are welcome
  zero_area,         ///< nothing: the area inside is empty
  self_intersecting  ///< two edges cross at a point of no loop, or some area is wound clockwise or more than once
};

struct Convex_parts {
  Contour contour = Contour::zero_area;
  /// Corners of each piece, counterclockwise from the least index, in lexicographic order; empty unless contour ==
  /// simple.
  std::vector<std::vector<std::uint32_t>> pieces;
};

/// Cuts a polygon with holes into convex pieces, counterclockwise and without straight corners, that use only its
/// points. Loop 0 is the outer contour and runs counterclockwise; the others are holes of either sense. Pre: indices <
/// points.size(), or std::out_of_range. Post: the laws L1 to L4 above. Degenerate: repeated and straight points,
/// spikes, keyholes, points with equal coordinates, edges that overlap, and holes that touch are welcome; a clockwise
/// outer contour and a hole outside it are self_intersecting; no loops are zero_area; where edges cross and no area is
/// left, the crossing wins. Cost: O(n log n) on usual input, 0.03 to 0.3 s for 10^4 points, 6 us for an L; one pass for
/// convex polygons. Exact: filtered Ref: S. Hertel, K. Mehlhorn, Fast triangulation of simple polygons, FCT 1983.
Convex_parts convex_parts(std::span<const Planar_point> points, std::span<const std::vector<std::uint32_t>> loops);

/// The same polygon as triangles, every point of the contour a corner of those that touch it (straight points too): the
/// constrained Delaunay triangulation, in which polygons with all corners on one circle are cut from the least index.
/// So it is the only one for the contour and the order of its points. For faces that are not planar, cut through their
/// projection. Pre, Post, Degenerate, Cost, Exact: as convex_parts(); points with equal projections count as one, the
/// least index. Proof: P-22
Convex_parts triangles(std::span<const Planar_point> points, std::span<const std::vector<std::uint32_t>> loops);

}  // namespace sightline
