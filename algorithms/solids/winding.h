#pragma once
// How often each operand winds round the points on either side of a fragment.

#include <sightline/algorithms/solids/box_tree.h>
#include <sightline/algorithms/solids/fragments.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/kernel/sign.h>

#include <cstdint>
#include <vector>

namespace sightline {

/// An operand's winding number at a point.
struct Winding {
  std::uint32_t operand;
  int number;
  friend bool operator==(const Winding&, const Winding&) = default;
};
/// By operand, ascending; of those that are not named it is 0.
using Windings = std::vector<Winding>;

/// Both sides of a fragment.
struct Fragment_sides {
  Windings front, behind;
};

/// The winding numbers just before and just behind a fragment, by one ray along an axis from a point inside it. Which
/// point does not matter; points whose ray meets an edge are passed over, and all but a few are others.
/// Pre: no piece in another plane has points inside the fragment, but for single ones. Thread-safe.
/// Cost: O(log n + pieces along the ray). Exact: yes. Proof: P-112
Fragment_sides sides_of(const Operands& operands, const Predicates& predicates, const Box_tree& tree,
                        const Solid_fragment& fragment, Predicate_counts& counts);

}  // namespace sightline
