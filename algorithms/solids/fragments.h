#pragma once
// Pieces that meet others, cut into convex fragments that nothing crosses.

#include <sightline/algorithms/solids/contacts.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/vertex.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// A corner of a fragment, and the plane through the edge to the next corner: not the fragment's own, interior in its
/// front.
struct Fragment_corner {
  Vertex vertex;
  Plane edge;
};

/// A convex part of a piece, counterclockwise seen from the piece's front, strictly convex.
struct Solid_fragment {
  std::uint32_t piece;
  std::vector<Fragment_corner> corners;
  /// Other pieces in its plane that hold all of it; where others hold its inside, they do.
  std::vector<std::uint32_t> upon;
};

/// A point that splits what runs through it: on the fragments' edges in the meet of the piece's plane with another one.
struct Fragment_mark {
  Plane edge;
  Vertex at;
};

struct Piece_fragments {
  std::vector<Solid_fragment> fragments;
  std::vector<Fragment_mark> marks;
};

/// The whole piece as one fragment.
Solid_fragment whole(const Operands& operands, const Predicates& predicates, std::uint32_t piece);

/// A piece cut along its contacts. Of pieces that lie upon each other the least keeps what they share, and its
/// fragments name the others; theirs are left out. Post: the fragments of all pieces have disjoint insides, and tile
/// the union of all pieces; no point of a piece that is in another plane is inside one, but for single points. Cost:
/// O(k log k) fragments for k cuts, usually. Exact: yes. Proof: P-111
Piece_fragments cut_piece(const Operands& operands, const Predicates& predicates, const Contacts& contacts,
                          std::uint32_t piece, Predicate_counts& counts);

}  // namespace sightline
