#include <sightline/algorithms/levels/wall_polygon.h>

#include <algorithm>
#include <utility>

namespace sightline::levels_detail {

Wall_halves Wall_cutter::cut(const Wall_polygon& polygon, Plane plane) {
  Wall_halves halves;
  if (polygon.empty()) return halves;
  if (polygon.plane.id() == plane.id()) {
    halves.is_in_plane = true;
    return halves;
  }
  const Prepared_plane cutter = predicates_.prepare(plane);
  const std::size_t n = polygon.corners.size();
  sides_.clear();
  for (const Wall_polygon::Corner& corner : polygon.corners)
    sides_.push_back(predicates_.side(corner.vertex, cutter, counts_));
  const bool front = std::count(sides_.begin(), sides_.end(), CGAL::POSITIVE) > 0,
             behind = std::count(sides_.begin(), sides_.end(), CGAL::NEGATIVE) > 0;
  contacts_ += static_cast<std::size_t>(std::count(sides_.begin(), sides_.end(), CGAL::ZERO));
  if (!front && !behind) {
    halves.is_in_plane = true;
    return halves;
  }
  if (!front || !behind) {
    (front ? halves.front : halves.behind) = polygon;
    return halves;
  }
  ++splits_;
  halves.front.plane = halves.behind.plane = polygon.plane;
  for (std::size_t i = 0; i < n; ++i) {
    const Wall_polygon::Corner& corner = polygon.corners[i];
    const Sign here = sides_[i], next = sides_[i + 1 == n ? 0 : i + 1];
    if (here == CGAL::ZERO) {
      halves.front.corners.push_back({corner.vertex, next == CGAL::POSITIVE ? corner.bound : plane});
      halves.behind.corners.push_back({corner.vertex, next == CGAL::NEGATIVE ? corner.bound : plane.opposite()});
      continue;
    }
    std::vector<Wall_polygon::Corner>&own = here == CGAL::POSITIVE ? halves.front.corners : halves.behind.corners,
    &other = here == CGAL::POSITIVE ? halves.behind.corners : halves.front.corners;
    own.push_back(corner);
    if (next != -here) continue;
    const Vertex crossing = predicates_.meet(polygon.plane.id(), corner.bound.id(), plane.id());
    own.push_back({crossing, here == CGAL::POSITIVE ? plane : plane.opposite()});
    other.push_back({crossing, corner.bound});
  }
  return halves;
}

Wall_polygon Wall_cutter::section(Plane plane, const std::array<std::array<Plane, 2>, 3>& box) {
  // 1. Between the planes across two axes, the third being where the normal is longest.
  const std::array<Integer, 4> h = predicates_.coefficients(plane);
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (abs(h[i]) > abs(h[k])) k = i;
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  std::array<Plane, 4> bounds{box[j][0], box[i][1], box[j][1], box[i][0]};  // counterclockwise as seen from above k
  if (sgn(h[k]) < 0) std::swap(bounds[0], bounds[2]);
  Wall_polygon polygon{plane, {}};
  for (std::size_t e = 0; e < 4; ++e)
    polygon.corners.push_back({predicates_.meet(plane.id(), bounds[(e + 3) % 4].id(), bounds[e].id()), bounds[e]});

  // 2. Between the planes across that.
  for (const Plane bound : box[k])
    if (bound.id() != plane.id()) polygon = in_front(polygon, bound);
  return polygon;
}

}  // namespace sightline::levels_detail
