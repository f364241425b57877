#include <sightline/algorithms/solids/without_holes.h>

#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/vectors.h>

#include <cstddef>
#include <stdexcept>

namespace sightline {

std::vector<std::vector<Point_id>> triangles_of(const Polygon_soup& soup, Face_id f) {
  // 1. The axis to project along: one that the face's normal has a part of; from its front.
  Exact_point normal;
  const std::span<const Point_id> outer = soup.loop(f);
  const Exact_point origin = soup.point(outer[0]);
  for (std::size_t i = 1; i + 1 < outer.size(); ++i) {
    const Exact_point part = cross(minus(soup.point(outer[i]), origin), minus(soup.point(outer[i + 1]), origin));
    for (std::size_t k = 0; k < 3; ++k) normal[k] += part[k];
  }
  const std::size_t axis = sgn(normal[2]) != 0 ? 2 : sgn(normal[1]) != 0 ? 1 : 0;
  std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (sgn(normal[axis]) < 0) std::swap(x, y);
  // 2. Its points as integers there.
  std::vector<Point_id> ids;
  std::vector<std::vector<std::uint32_t>> loops(soup.loop_count(f));
  Integer common = 1;
  for (std::size_t k = 0; k < loops.size(); ++k)
    for (const Point_id p : soup.loop(f, k)) {
      loops[k].push_back(static_cast<std::uint32_t>(ids.size()));
      ids.push_back(p);
      const Exact_point at = soup.point(p);
      common = lcm(lcm(common, at[x].get_den()), at[y].get_den());
    }
  std::vector<Planar_point> planar;
  for (const Point_id p : ids) {
    const Exact_point at = soup.point(p);
    planar.push_back({at[x].get_num() * (common / at[x].get_den()), at[y].get_num() * (common / at[y].get_den())});
  }
  const Convex_parts parts = triangles(planar, loops);
  if (parts.contour != Contour::simple) throw std::logic_error("a face that is not simple");
  std::vector<std::vector<Point_id>> result;
  for (const auto& piece : parts.pieces) {
    result.emplace_back();
    for (const std::uint32_t i : piece) result.back().push_back(ids[i]);
  }
  return result;
}

Hole_free without_holes(const Polygon_soup& soup) {
  Hole_free result;
  result.soup.file = soup.file;
  result.soup.coordinates = soup.coordinates;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    if (soup.loop_count(f) == 1) {
      result.soup.add_face(soup.loop(f));
      result.face_of.push_back(f);
      continue;
    }
    for (const std::vector<Point_id>& triangle : triangles_of(soup, f)) {
      result.soup.add_face(triangle);
      result.face_of.push_back(f);
    }
  }
  return result;
}

}  // namespace sightline
