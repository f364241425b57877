#pragma once
// Single shapes with a known answer: convex bodies, cycles, bundles and stacks.

#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace sightline::generate {

using Lattice_point = std::array<std::int64_t, 2>;

/// Point k of n on the circle of a radius, rounded to integers; point 0 is (radius, 0), counterclockwise, about equally
/// spaced. The same on every machine: integers only. In a quadrant the point at parameter u in [0, 1) is the rational
/// point
/// ((1 - t^2) / (1 + t^2), 2 t / (1 + t^2)) of the unit circle with t = u (11 + 3 u^2) / 14, which is tan(pi u / 4)
/// within 2%.
Lattice_point circle_point(std::uint64_t k, std::uint64_t n, std::int64_t radius);

/// A closed and exactly convex body near the unit sphere, of at least `faces` faces: trapezoids in 2 b rings of 4 a,
/// those at the poles triangles, fronts outwards; 8 a b is the least such number with b = floor(sqrt(faces / 8)), b
/// >= 1. The polygon of a ring and the meridian are rounded to a grid of 2^-w, w two more than the least with which
/// both are strictly convex; a vertex (radius of the ring x point of the polygon, height) is a multiple of 2^-2w, an
/// exact double. Why it is convex: all rings are scaled copies of one convex polygon, so a face's plane holds two
/// parallel sides of neighbouring rings, and a linear form m . (x, y) + c z with m normal to those sides is largest on
/// them: in each ring by the polygon's convexity, among rings by the meridian's. A seed other than 0 shuffles the
/// faces; with 0 they go from the south pole up. Pre: faces <= 10^7, or std::invalid_argument. Cost: 0.1 s for 10^6
/// faces. Exact: yes
Polygon_soup convex_sphere(std::size_t faces, std::uint64_t seed = 0);

/// Triangles near the unit sphere around (x, 0, 0), fronts outwards: two fans at its poles (x, 0, 1) and (x, 0, -1),
/// and strips between rings, 2 meridians (rings - 1) of them. Corners are multiples of 2^-20, but depend on the
/// machine's sine and cosine. Pre: meridians >= 3, rings >= 2.
Polygon_soup triangulated_sphere(int meridians, int rings, double x);

/// n flat bars along the sides of a convex polygon, each lying over the next at their common corner, the last over the
/// first: seen from above a cycle of n faces, fronts up, that no order of whole faces resolves. Pre: 3 <= n <= 10^6.
/// Post: bar k is above bar k + 1 wherever their projections along z meet, and meets no other but k - 1 and k + 1.
Polygon_soup bars(std::size_t n);

/// n rectangles that all contain the segment from (0, 0, -1) to (0, 0, 1): any two cross in it. Pre: n <= 10^5.
/// Post: n different planes; corners are multiples of 2^-18 (2^-36 for n > 1000).
Polygon_soup crossing(std::size_t n);

/// n unit squares above each other at distances of 2^-10, fronts up, the lowest first.
Polygon_soup stacked(std::size_t n);

}  // namespace sightline::generate
