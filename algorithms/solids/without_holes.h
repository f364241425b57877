#pragma once
// What formats can hold: faces of one loop each.

#include <sightline/kernel/scene/polygon_soup.h>

#include <cstdint>
#include <vector>

namespace sightline {

/// A soup without holes, and which face of the one before each of its faces is a part of.
struct Hole_free {
  Polygon_soup soup;
  std::vector<Face_id> face_of;
};

/// Cuts each face with holes into simple polygons on its own points, all of them: so edges are shared wholly, as
/// before. They are few, if not as few as can be: two of a face with one hole, usually. Other faces stay as they are,
/// in their order. Pre: faces with holes are planar, their holes inside, touching nothing but at points. Exact: yes.
/// Cost: O(k log k) for a face of k points with holes.
Hole_free without_holes(const Polygon_soup& soup);

/// One face as triangles on its own points, all of them. Pre, Exact, Cost: as above.
std::vector<std::vector<Point_id>> triangles_of(const Polygon_soup& soup, Face_id face);

}  // namespace sightline
