#pragma once
// Which pieces of the operands meet, and in what: the segments that cut each piece, the pieces that it lies upon, and
// the edges over which two pieces meet each other and nothing else.

#include <sightline/algorithms/solids/box_tree.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/vertex.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

/// A segment in a piece along which it is to be cut: it has points inside the piece, and lies in `plane`, which is not
/// the piece's own. Its ends are on the piece.
struct Cut {
  std::uint32_t piece, other;  ///< of which the other has the segment, too
  Plane plane;
  Vertex from, to;
};

/// A point of a piece where another one touches it or ends.
struct Touch {
  std::uint32_t piece;
  Vertex at;
};

/// What pieces have to do with each other.
/// Post: `cuts` of a piece hold all points inside it that are on pieces in other planes, but for single points, and all
/// points inside it that are on edges of pieces in its plane that share area with it; `upon` those pieces. `touches`
/// holds the ends of all that the piece shares with others, where `cuts` does not have them.
struct Contacts {
  std::vector<Cut> cuts;
  std::vector<Touch> touches;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> upon;    ///< both ways: (i, j) and (j, i)
  std::vector<std::size_t> first_cut, first_touch, first_upon;  ///< of each piece; one more at the end
  /// By piece: it meets another one in more than a common corner or a whole common edge.
  std::vector<bool> touched;
  /// Pairs of pieces that are not touched, with edges that run against each other and lie on no other piece.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> joined;
  std::size_t pairs = 0;  ///< of which boxes meet
  Predicate_counts predicates;

  std::span<const Cut> cuts_of(std::size_t piece) const {
    return {cuts.data() + first_cut[piece], first_cut[piece + 1] - first_cut[piece]};
  }
  std::span<const Touch> touches_of(std::size_t piece) const {
    return {touches.data() + first_touch[piece], first_touch[piece + 1] - first_touch[piece]};
  }
  std::span<const std::pair<std::uint32_t, std::uint32_t>> upon_of(std::size_t piece) const {
    return {upon.data() + first_upon[piece], first_upon[piece + 1] - first_upon[piece]};
  }
};

/// Looks at all pairs of pieces whose boxes meet, of one operand too; makes the edges of those that doubles do not tell
/// apart, so of all that are touched. The same for any number of threads.
/// Degenerate: pieces that share a corner or an edge, touch, or lie in one plane are the main case; see Contacts.
/// `progress` may be called by any thread; what it throws is thrown. Cost: O(n log n + pairs). Exact: yes. Proof: P-110
Contacts contacts(Operands& operands, const Box_tree& tree,
                  const std::function<void(std::size_t done, std::size_t all)>& progress = {});

}  // namespace sightline
