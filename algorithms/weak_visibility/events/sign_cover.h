#pragma once
// Conjunctions of signs, of which one at least holds whatever the signs are.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// Holds iff numbers k of which bit k is set in `positive` are > 0, and those in `negative` < 0.
struct Sign_clause {
  std::uint64_t positive, negative;
};

/// Whether some clause holds for all signs of the numbers, none of them zero. May say no where it would take more than
/// so many cases to see. Degenerate: a clause that wants both signs of a number never holds, one that wants nothing
/// always does. Exact: where it says yes. Proof: P-73
bool some_clause_holds(std::vector<Sign_clause>& clauses, int cases = 64);

}  // namespace sightline
