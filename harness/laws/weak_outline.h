#pragma once
// What bounds the part of a polygon that a point sees, by brute force in rationals. Shares nothing with partitions.

#include <sightline/harness/laws/weak_flats.h>

#include <array>
#include <vector>

namespace sightline::harness::weak_flats {

/// A line of a polygon's plane: where it is zero, c[0] + c[1] a + c[2] b is, of points corner + a (next - corner) + b
/// (the one after it - corner). Canonical: the first of c[1], c[2] that is not zero is 1.
using Flat_line = std::array<Rational, 3>;

/// In a polygon's plane, the lines on which edges of that part of it lie which an eye sees past some polygons, as far
/// as it is in front of a plane: sorted. All shadows are cast, and of each line each stretch between others is asked
/// whether one of its sides is seen and the other is not. Pre: the eye is strictly in front of the source, which is
/// convex. Degenerate: polygons whose plane holds the eye cast no shadow. Exact: yes
std::vector<Flat_line> seen_outline(const std::vector<generate::Points>& polygons, const generate::Points& source,
                                    const Level& front, const Exact_point& eye);

/// Where the plane through an eye and a line of space meets the polygon's plane. Pre: it does; the eye is not on it.
Flat_line image_of(const generate::Points& source, const Exact_point& eye, const std::array<Exact_point, 2>& line);

}  // namespace sightline::harness::weak_flats
