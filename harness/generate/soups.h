#pragma once
// Triangles: in random places, and as a landscape.

#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>

namespace sightline::generate {

/// The integer r with r^3 <= n < (r + 1)^3. Exact: yes
std::uint64_t cube_root(std::uint64_t n);

/// n random triangles in the unit cube with corners on the grid of step 2^-bits, none of zero area. Each corner is
/// uniform in an axis-parallel cube of side 3/2 `edge_steps`, so that edges are 0.99 `edge_steps` long on average (the
/// mean distance of two points of a unit cube is 0.6617). Pre: 4 <= edge_steps, bits <= 30. Cost: 0.3 s and 190 MB for
/// n = 10^6.
Polygon_soup soup_on_grid(std::size_t n, std::int64_t edge_steps, std::uint64_t seed, int bits);

/// n random triangles with edges about `edge` long in the unit cube, coordinates on the grid of step 2^-bits.
/// Pre: edge is at least 4 steps, bits <= 30, or std::invalid_argument. Post: no zero area; three points for each face.
Polygon_soup soup(std::size_t n, double edge, std::uint64_t seed, int bits = 26);

/// n random triangles in the unit cube, one for each cube of their own edge length: edge = n^(-1/3). A sightline then
/// meets as many triangles per edge length for any n, and the number of faces seen from a point stays bounded.
Polygon_soup soup_constant_density(std::size_t n, std::uint64_t seed);

/// n triangles in the unit cube on the grid of step 2^-26, none of zero area: n / 10 slivers, last, and before them a
/// soup_constant_density(). A sliver runs from a corner to another at least 1/2 away along an axis; its third one is
/// where the grid comes nearest to a place between them, so its length is beyond 2^24 times its width.
Polygon_soup slivers(std::size_t n, std::uint64_t seed);

/// The queries that weak visibility is measured with elsewhere: from the square [-1, 1]^2 at z = 0, face 0, looking up,
/// to the same at z = 10, face 1, looking down, and between them n random triangles, faces 2 to n + 1, about 2 wide.
/// Query t of size n is drawn from the 32-bit Mersenne twister of seed 1000 n + t (modulo 2^32), in float arithmetic: u
/// = 2 (draw / 2^32) - 1, the centre (1.2 u, 1.2 u, 5 + 4 u), each corner moved by 1.05 u along each axis, z clamped to
/// [0.1, 9.9]. Post: three points for each triangle, coordinates are floats. A triangle may have no area, with a
/// probability that is none in practice.
Polygon_soup triangles_between_squares(std::size_t n, std::uint64_t t);

/// A landscape of at least n triangles over a square lattice of step 2^-10, front up: two for each of m x m cells, m
/// the least. Heights are multiples of 2^-20, the sum of octaves whose amplitude and wave length halve. Post: a height
/// field, every inner edge in two triangles, diagonals in random directions.
Polygon_soup terrain(std::size_t n, std::uint64_t seed);

}  // namespace sightline::generate
