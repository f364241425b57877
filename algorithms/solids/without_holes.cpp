#include <sightline/algorithms/solids/without_holes.h>

#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/vectors.h>

#include <cstddef>
#include <deque>
#include <map>
#include <stdexcept>
#include <utility>

namespace sightline {

/// Triangles of one face put together to simple polygons: outwards from a triangle, with each next one whose far corner
/// is none of the polygon's yet. No corner is inside the face, so what has two sides in common with the polygon closes
/// round a hole, and its far corner is there already.
static std::vector<std::vector<Point_id>> put_together(const std::vector<std::vector<Point_id>>& triangles) {
  using Side = std::pair<Point_id, Point_id>;
  std::map<Side, std::size_t> triangle_at;  // by side, as it runs there
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) triangle_at[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
  std::vector<bool> done(triangles.size());
  std::vector<std::vector<Point_id>> polygons;
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (done[first]) continue;
    done[first] = true;
    std::map<Point_id, Point_id> next;
    std::deque<Side> sides;
    for (std::size_t i = 0; i < 3; ++i) {
      sides.emplace_back(triangles[first][i], triangles[first][(i + 1) % 3]);
      next.insert(sides.back());
    }
    for (; !sides.empty(); sides.pop_front()) {
      const auto [from, to] = sides.front();
      const auto beyond = triangle_at.find({to, from});
      if (beyond == triangle_at.end() || done[beyond->second]) continue;
      const std::vector<Point_id>& corners = triangles[beyond->second];
      std::size_t k = 0;
      while (corners[k] == from || corners[k] == to) ++k;
      if (!next.try_emplace(corners[k], to).second) continue;
      done[beyond->second] = true;
      next[from] = corners[k];
      sides.emplace_back(from, corners[k]);
      sides.emplace_back(corners[k], to);
    }
    std::vector<Point_id>& polygon = polygons.emplace_back();
    Point_id at = triangles[first][0];
    do {
      polygon.push_back(at);
      at = next[at];
    } while (at != triangles[first][0]);
  }
  return polygons;
}

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
    for (const std::vector<Point_id>& polygon : put_together(triangles_of(soup, f))) {
      result.soup.add_face(polygon);
      result.face_of.push_back(f);
    }
  }
  return result;
}

}  // namespace sightline
