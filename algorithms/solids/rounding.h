#pragma once
// What becomes of an exact surface whose points are rounded to floating-point numbers, as most formats hold them.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace sightline {

enum class Rounding { to_double, to_float };

/// A rounded surface, and all that it is not any more. Faces are the rounded soup's.
struct Rounded_surface {
  Polygon_soup soup;
  std::vector<Face_id> face_of;     ///< the face before that each is, or is a triangle of
  std::size_t moved = 0;            ///< points
  double farthest = 0;              ///< no coordinate was moved by more
  std::vector<Face_id> not_planar;  ///< faces before, now triangles
  std::vector<Face_id> collapsed;   ///< without area now
  std::vector<Face_id> turned;      ///< whose normals point to the other side of their planes now
  /// Pairs that have a segment in common inside one of them, though the faces before had not.
  std::vector<std::pair<Face_id, Face_id>> crossing;
};

/// Rounds each coordinate to the nearest number, ties to even. Faces stay as they are if they are planar still, else
/// they become the triangles that they would be cut into exactly. `triangulate`: all faces become triangles.
/// Pre: a planar soup without holes; coordinates within the numbers' range, or std::domain_error.
/// Cost: O(n log n) and the pairs whose boxes meet. Exact: yes, all that it says of the rounded surface
Rounded_surface rounded(const Polygon_soup& soup, Rounding to, bool triangulate = false);

}  // namespace sightline
