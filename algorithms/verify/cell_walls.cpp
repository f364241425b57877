#include <sightline/algorithms/verify/cell_walls.h>

#include <sightline/algorithms/verify/faces.h>
#include <sightline/algorithms/verify/verdict.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>

namespace sightline::level_check {

using namespace certificate_check;
using weak_check::reaches;

std::vector<Homogeneous> edge_planes(const Outline& polygon) {
  const Integer_vector normal{polygon.plane[0], polygon.plane[1], polygon.plane[2]};
  std::vector<Homogeneous> planes;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Homogeneous& a = polygon.corners[i];
    const Integer_vector inward = primitive(cross(normal, minus(polygon.corners[(i + 1) % polygon.corners.size()], a)));
    planes.push_back({Integer(inward[0] * a[3]), Integer(inward[1] * a[3]), Integer(inward[2] * a[3]),
                      Integer(-dot(inward, Integer_vector{a[0], a[1], a[2]}))});
  }
  return planes;
}

std::vector<Outline> outlines_of_walls(const std::vector<Polygon>& walls) {
  if (walls.empty()) reject("it has no walls");
  std::vector<Outline> outlines;
  Boundary_chain boundary;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (!canonical(walls[w])) reject(name("wall", w) + " has a number that is not in lowest terms");
    const certificate_check::Plane plane{newell_normal(walls[w]), walls[w].empty() ? Exact_point{} : walls[w][0]};
    if (is_zero(plane.normal)) reject(name("wall", w) + " has zero area");
    if (const std::string why = not_convex(walls[w], plane); !why.empty()) reject(name("wall", w) + ' ' + why);
    outlines.emplace_back(walls[w]);
    boundary.add(walls[w], 1);
  }
  if (const std::optional<Exact_point> open = boundary.nonzero())
    reject("its walls do not close up at " + exact_name(*open));
  // Sides may be in many walls, which have planes and corners in common.
  std::set<Homogeneous> all, planes;
  for (const Outline& outline : outlines) all.insert(outline.corners.begin(), outline.corners.end());
  const weak_check::Corners corners(all.begin(), all.end());
  for (std::size_t w = 0; w < outlines.size(); ++w) {
    if (!planes.insert(outlines[w].plane).second) continue;
    if (reaches(outlines[w].plane, corners, 1)) reject("it is not convex: a corner is outside of " + name("wall", w));
    if (!reaches(outlines[w].plane, corners, -1))
      reject("it has no inside: all corners are in the plane of " + name("wall", w));
  }
  return outlines;
}

bool is_within(const Outline& polygon, const Outline& wall) {
  if (!wall.in_plane(polygon.plane)) return false;
  const std::vector<Homogeneous> edges = edge_planes(wall);
  return std::none_of(edges.begin(), edges.end(),
                      [&](const Homogeneous& edge) { return reaches(edge, polygon.corners, -1); });
}

}  // namespace sightline::level_check
