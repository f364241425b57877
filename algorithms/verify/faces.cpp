#include <sightline/algorithms/verify/faces.h>

#include <algorithm>

namespace sightline::certificate_check {

Face::Face(const Polygon_soup& soup, Face_id f) {
  for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
    Polygon loop;
    for (const Point_id p : soup.loop(f, k))
      if (Exact_point point = soup.point(p); loop.empty() || point != loop.back()) loop.push_back(std::move(point));
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    loops.push_back(std::move(loop));
  }
  if (loops[0].empty()) return;
  plane = {newell_normal(loops[0]), loops[0][0]};
  has_front = !is_zero(plane.normal);
  if (!has_front) plane.normal = some_normal();
  const Homogeneous front = plane_of(plane);
  for (const Polygon& loop : loops)
    for (const Exact_point& p : loop) planar = planar && side(front, homogeneous(p)) == 0;
  if (!planar) return;
  for (std::size_t k = 1; k < loops.size(); ++k)
    if (sgn(dot(plane.normal, newell_normal(loops[k]))) > 0) std::reverse(loops[k].begin(), loops[k].end());
}

Integer_vector Face::some_normal() const {  // of the first three points that are not collinear
  std::vector<Exact_point> arms;
  for (const Polygon& loop : loops)
    for (const Exact_point& p : loop) {
      if (p == loops[0][0]) continue;
      arms.push_back(minus(p, loops[0][0]));
      const Integer_vector normal = primitive(cross(arms.front(), arms.back()));
      if (!is_zero(normal)) return normal;
    }
  return {};
}

}  // namespace sightline::certificate_check
