#pragma once
// The law `rounding` of the subject `boolean`: what becomes of surfaces in floating-point numbers.

#include <sightline/algorithms/solids/rounding.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <string>
#include <vector>

namespace sightline::harness {

/// That what is said of a surface in floats or doubles is so; empty: it is. It is closed still; what is turned, what
/// crosses that did not, pair by pair, and what has not its inside behind it, face by face, are told; and where it is
/// said to be sound, or was snapped until it was, it winds once round what it did, and nothing else, farther off than
/// anything moved. What crosses is asked of surfaces of few faces, without those that are not convex and pairs in one
/// plane.
std::string flaw_of_rounded(const Polygon_soup& exact, Rounding to, generate::Random& random);

/// flaw_of_rounded() of the result of a set operation far from the origin, of a thin tetrahedron, and, every
/// other time, of one that stands upon a box on an edge.
std::string flaw_of_rounding(const std::vector<Polygon_soup>& solids, generate::Random& random);

}  // namespace sightline::harness
