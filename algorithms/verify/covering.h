#pragma once
// Checks that polygons are a scene: each face tiled by its fragments, or set aside for a reason that holds. What all
// certificates have in common. Rationals and integers only; shares nothing with what makes certificates. Laws:
// proofs/order_certificate.md (P-21, P-22).

#include <sightline/algorithms/verify/parallel.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sightline {

/// A convex part of a face (of piece `piece` of it, where the face has pieces).
struct Order_fragment {
  Face_id face = 0;
  std::uint32_t piece = 0;
  std::vector<Exact_point> vertices;  ///< counterclockwise as seen from the face's front; straight corners are welcome
};

/// The claim "the fragments are the scene".
struct Covering {
  std::vector<Order_fragment> fragments;

  /// A planar convex polygon on a face's own vertices. A non-planar face must have pieces, a planar one may.
  struct Piece {
    Face_id face = 0;
    std::uint32_t piece = 0;
    std::vector<Exact_point> vertices;
  };
  std::vector<Piece> pieces;

  /// A face that is not drawn. `why` begins with the text of a Set_aside_reason (kernel/scene/set_aside.h).
  struct Set_aside {
    Face_id face = 0;
    std::string why;
  };
  std::vector<Set_aside> set_aside;
};

namespace certificate_check {

class Numbered_polygons;

/// What a verdict says of the scene, whatever it is about.
struct Covered {
  std::size_t set_aside = 0, not_planar = 0;  ///< faces
  std::string text() const;                   ///< "0 faces set aside, 0 not planar"
};

/// Where fragments and pieces are in the lists that they are taken from, by which a verdict's text names them.
struct Covering_places {
  std::vector<std::size_t> fragments, pieces;
};

/// Rejects unless the fragments are the scene: they refer to it, tile each face piece by piece, and all else is set
/// aside rightly. With an eye, polygons that it is not strictly in front of may be left out, whole. Faces that are
/// `known` to be tiled need no fragments. With `places` text names these; the verdict's numbers are of the covering's
/// own list. Post: the corners of the fragments are in `numbered`. Pre: nothing is. Proof: P-21, P-22
Covered check_covering(const Polygon_soup& soup, const Covering& covering, const Workers& workers,
                       const Exact_point* eye = nullptr, const std::vector<bool>& known = {},
                       Numbered_polygons* numbered = nullptr, const Covering_places* places = nullptr);

}  // namespace certificate_check

}  // namespace sightline
