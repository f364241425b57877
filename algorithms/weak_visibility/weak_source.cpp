#include <sightline/algorithms/weak_visibility/weak_source.h>

#include <sightline/kernel/located_point.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <cstddef>
#include <stdexcept>

namespace sightline {

std::vector<Exact_point> strict_corners(const std::vector<Exact_point>& points) {
  std::vector<Exact_point> corners;
  for (const Exact_point& p : points)
    if (corners.empty() || corners.back() != p) corners.push_back(p);
  while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
  if (corners.size() < 3)
    throw std::invalid_argument(
        "a source has fewer than three points; give the corners of a convex polygon, counterclockwise as seen from the "
        "side it looks to");
  // Newell's normal; then each corner turns left around it, and all turn around once.
  Exact_point normal{0, 0, 0};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Exact_point part = cross(minus(corners[i], corners[0]), minus(corners[i + 1], corners[0]));
    for (std::size_t k = 0; k < 3; ++k) normal[k] += part[k];
  }
  if (is_zero(normal))
    throw std::invalid_argument(
        "a source has no area; give the corners of a convex polygon, counterclockwise as seen from the side it looks "
        "to");
  for (const Exact_point& p : corners)
    if (sgn(dot(normal, minus(p, corners[0]))) != 0)
      throw std::invalid_argument("a source is not planar; cut it into triangles and give each of them");
  const char* const not_convex = "a source is not convex; cut it into convex polygons and give each of them";
  std::vector<Exact_point> strict;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Exact_point &before = corners[(i + corners.size() - 1) % corners.size()],
                      &after = corners[(i + 1) % corners.size()];
    const Exact_point in = minus(corners[i], before), out = minus(after, corners[i]);
    const int turn = sgn(dot(normal, cross(in, out)));
    if (turn < 0 || (turn == 0 && sgn(dot(in, out)) < 0)) throw std::invalid_argument(not_convex);
    if (turn > 0) strict.push_back(corners[i]);
  }
  for (std::size_t i = 0; i < strict.size();
       ++i)  // a star turns left everywhere too, but has corners outside its edges
    for (const Exact_point& p : strict)
      if (sgn(dot(normal, cross(minus(strict[(i + 1) % strict.size()], strict[i]), minus(p, strict[i])))) < 0)
        throw std::invalid_argument(not_convex);
  return strict;
}

Weak_source weak_source(const Occluders& occluders, const std::vector<Exact_point>& points) {
  Weak_source source;
  for (const Exact_point& p : strict_corners(points)) {
    const Located_point at = occluders.scene().locate(p);
    source.polygon.push_back(near_point(occluders.frame(), {at.x, at.y, at.z, at.w}));
  }
  const auto &a = source.polygon[0].exact, &b = source.polygon[1].exact, &c = source.polygon[2].exact;
  const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) {  // of the rows a, b, c
    return Integer(a[i] * (b[j] * c[k] - b[k] * c[j]) - a[j] * (b[i] * c[k] - b[k] * c[i]) +
                   a[k] * (b[i] * c[j] - b[j] * c[i]));
  };
  source.plane = near_plane(occluders.frame(),
                            {minor(1, 2, 3), Integer(-minor(0, 2, 3)), minor(0, 1, 3), Integer(-minor(0, 1, 2))});
  return source;
}

}  // namespace sightline
