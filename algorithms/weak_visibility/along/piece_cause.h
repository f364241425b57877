#pragma once
// Why what an eye sees changes: the kind of event, and edges that it sees through one point.

#include <sightline/algorithms/weak_visibility/along/piece_view.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

enum class Along_kind : std::uint8_t {
  plane,        ///< the eye passes the face's plane
  contact,      ///< the eye is on a face
  edge_vertex,  ///< two of the edges are in a plane
  triple        ///< three edges, no two in a plane
};
/// "horizon", "contact", "edge and vertex", "triple"
const char* name(Along_kind kind);

/// Why something changes: edges that the eye sees through one point, each a piece and a corner.
struct Along_cause {
  Along_kind kind = Along_kind::plane;
  std::vector<std::array<std::uint32_t, 2>> edges;
};

/// The cause, at a moment, among determinants of three lines that are zero then: of the first kind, edges of three
/// lines, not concurrent all along, that one ray of the eye to the closed target meets, closed, before it. Lines in the
/// target's plane in which other pieces meet it have no edge. Where cuts went on beyond edges all lines are asked that
/// go through the same ray; a triple without edges if there are none. Exact: yes. Proof: P-87
Along_cause cause_of(const Piece_view& view, const Quadratic_root& t,
                     std::span<const std::array<std::uint32_t, 3>> zero);

}  // namespace sightline
