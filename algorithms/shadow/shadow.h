#pragma once
// Which parts of faces a light reaches, and what keeps it from the others.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/sign.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sightline {

struct Shadow_options {
  bool two_sided = false;  ///< backs that the light is behind are parted too
  int threads = 0;         ///< 0: as many as there are processors; the result is the same for any number
  std::function<void(std::size_t done, std::size_t all)> progress = {};  ///< called from any thread
};

struct Shadow_counters {
  std::uint64_t pieces = 0;            ///< that are turned to the light
  std::uint64_t cuts = 0, merged = 0;  ///< of parts; pairs of parts put together again
  template <class Visit>
  static void each(Visit visit) {
    visit("parted_pieces", &Shadow_counters::pieces);
    visit("cuts", &Shadow_counters::cuts);
    visit("merged", &Shadow_counters::merged);
  }
};

/// A convex part of a piece that is lit all over, or that one piece shadows all over.
struct Shadow_part {
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};
  std::uint32_t piece;
  std::uint32_t by;  ///< the piece that the light meets first on its way there, or `nothing`: it is lit
  Sign side;         ///< of the light to the piece: POSITIVE, or NEGATIVE where its back is turned to the light
  std::vector<Exact_point> vertices;  ///< counterclockwise as seen from the face's front
  bool is_lit() const { return by == nothing; }
};

struct Shadows {
  std::vector<Shadow_part> parts;  ///< of the pieces that are turned to the light, by piece
  std::vector<Face_id> lit;        ///< faces of which an open part is lit, ascending
  std::vector<Face_id>
      away;  ///< kept faces without a piece that is turned to the light: it is behind, or in their plane
  Shadow_counters counters;
};

/// The parts of all pieces that are turned to a light, which is the view's eye: a point, or a sun. Lit is what the eye
/// sees, by the law of `proofs/semantics.md`; so the parts of a piece tile it, and of the faces at one place in one
/// plane all are lit. Degenerate: faces in whose plane the light is are not lit and shadow nothing, also where it is on
/// them; a scene without faces has no parts. Pre: view, boxes: of one scene. Cost: what the eye sees (visible_surface),
/// and what is shadowed: each piece is cut by the parts of the view that it is behind. Parallel. Exact: yes. Proof:
/// P-96
Shadows shadows(const Exact_view& light, const Piece_boxes& boxes, const Shadow_options& options = {});

}  // namespace sightline
