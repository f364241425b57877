#pragma once
// What the faces of a scene became: convex pieces on interned planes, or a place in the list of what was set aside.

#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/set_aside.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sightline {

/// A convex polygon of the scene: a face, or one of the convex pieces that a face was cut into.
struct Piece {
  Face_id face;
  std::uint32_t number;  ///< 0-based within the face
  Plane support;         ///< supporting plane; its front is the face's front
  std::uint32_t first;   ///< corners [first, first + size) of the scene, counterclockwise seen from the front
  std::uint32_t size;
};

/// A corner of a piece, and the bounding plane through the edge to the next corner: not the supporting plane, interior
/// in its front.
struct Piece_corner {
  std::uint32_t point;
  Plane edge;
};

/// A face that is not modelled, and why: the reason, and its text, such as "zero area" or "duplicate of 7".
struct Set_aside {
  Face_id face;
  Set_aside_reason reason;
  std::string why;
};

/// What the scene was made of and what became of it.
struct Scene_counters {
  std::size_t points_read = 0, points = 0, faces_read = 0, faces = 0, pieces = 0;
  std::size_t zero_area = 0, duplicates = 0, self_intersecting = 0, no_simple_projection = 0;  ///< set aside
  std::size_t non_planar = 0, concave = 0, with_holes = 0, fanned = 0;
  /// What became of faces, each by its key in reports, in their order.
  template <class Visit>
  static void each(Visit visit) {
    visit("zero_area", &Scene_counters::zero_area);
    visit("duplicates", &Scene_counters::duplicates);
    visit("self_intersecting", &Scene_counters::self_intersecting);
    visit("no_simple_projection", &Scene_counters::no_simple_projection);
    visit("non_planar", &Scene_counters::non_planar);
    visit("concave", &Scene_counters::concave);
    visit("with_holes", &Scene_counters::with_holes);
    visit("fanned", &Scene_counters::fanned);
  }
};

/// All of it.
struct Scene_faces {
  Plane_table planes;
  std::vector<Piece> pieces;
  std::vector<Piece_corner> corners;
  std::vector<Set_aside> set_aside;
  std::vector<Face_id> non_planar, concave;
  Scene_counters counters;
};

}  // namespace sightline
