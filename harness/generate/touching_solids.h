#pragma once
// Pairs of solids that meet as one wants: faces in one plane, edges on edges, corners on faces, one within the other.

#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>

namespace sightline::generate::touching_solids {

/// Coordinates are below 2^4, so that a gap of whole ulps leaves them doubles.
inline constexpr int bits = 4;

/// Makes pairs of one sort. Both are closed, wind once round their insides, fronts outwards; gap 0: they meet exactly
/// as `what` says. Where they are on two sides, a gap > 0 is left between them, and one < 0 is how far they go into
/// each other; elsewhere the second one is moved by the gap off the plane that they meet in. Exact: yes.
struct Drafter {
  const char* name;
  const char* what;
  Solid_pair (*draft)(Random& random, const Rational& gap);
};
extern const std::array<Drafter, 9> drafters;

/// The second solid with tetrahedra beside it, which neither meets, until both have so many faces.
void enlarge(Solid_pair& pair, std::size_t faces);

}  // namespace sightline::generate::touching_solids
