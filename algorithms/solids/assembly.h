#pragma once
// Fragments that are kept, put together to faces that share whole edges.

#include <sightline/algorithms/solids/fragments.h>
#include <sightline/algorithms/solids/set_operation.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sightline {

/// A fragment of the result's boundary, and whether it is turned round there.
struct Kept_fragment {
  std::uint32_t piece;
  bool turned;
  std::vector<Fragment_corner> corners;  ///< empty: the whole piece, which meets no other in its inside or on an edge
};

/// Faces, points, and edges of other than two faces of a result. `marks`, by piece: where others end on its edges.
/// What `progress` throws is thrown. Pre: kept is in the order of pieces. Exact: yes. Proof: P-114
void assemble(const Operands& operands, const std::vector<Kept_fragment>& kept,
              const std::vector<std::pair<std::uint32_t, Fragment_mark>>& marks, Set_result& result,
              const std::function<void(std::size_t done, std::size_t all)>& progress = {});

}  // namespace sightline
