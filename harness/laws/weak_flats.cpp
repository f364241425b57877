#include <sightline/harness/laws/weak_flats.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <utility>

namespace sightline::harness::weak_flats {

using generate::Points;

Rational Level::height(const Exact_point& p) const { return Rational(dot(normal, p) - offset); }

Level Level::turned() const { return {minus({0, 0, 0}, normal), Rational(-offset)}; }

Level level_of(const Points& polygon) {
  Level level;
  for (std::size_t i = 2; i < polygon.size() && level.normal == Exact_point{0, 0, 0}; ++i)
    level.normal = cross(minus(polygon[1], polygon[0]), minus(polygon[i], polygon[0]));
  level.offset = dot(level.normal, polygon[0]);
  return level;
}

int position(const Level& level, const Points& polygon) {
  bool above = false, below = false;
  for (const Exact_point& p : polygon) {
    const int side = level.side(p);
    above |= side > 0;
    below |= side < 0;
  }
  return above && below ? 2 : int{above} - int{below};
}

Points clipped(const Points& polygon, const Level& level) {
  Points part;
  if (const int at = position(level, polygon); at != 2) return at > 0 ? polygon : part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational from = level.height(p), to = level.height(q);
    if (from >= 0) part.push_back(p);
    if (sgn(from) * sgn(to) < 0) part.push_back(generate::along(p, Rational(from / (from - to)), minus(q, p)));
  }
  return part;
}

std::vector<Points> cells(const Points& polygon, const std::vector<Level>& planes) {
  std::vector<Points> parts{polygon};
  for (const Level& plane : planes) {
    std::vector<Points> next;
    for (Points& part : parts)
      if (position(plane, part) == 2) {
        next.push_back(clipped(part, plane));
        next.push_back(clipped(part, plane.turned()));
      } else {
        next.push_back(std::move(part));
      }
    parts = std::move(next);
  }
  return parts;
}

std::vector<Points> polygons(const Scene& scene) {
  std::vector<Points> all;
  for (const Piece& piece : scene.pieces()) {
    all.push_back(scene.corner_points(piece));
  }
  return all;
}

Exact_point inner_point(const Points& corners, generate::Random& random) {
  Exact_point sum{0, 0, 0};
  long weights = 0;
  for (const Exact_point& p : corners) {
    const auto weight = static_cast<long>(random.between(1, 8));
    weights += weight;
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * p[k];
  }
  for (Rational& x : sum) x /= weights;
  return sum;
}

int location(const Points& polygon, const Level& level, const Exact_point& p) {
  int least = 1;
  for (std::size_t i = 0; i < polygon.size() && least >= 0; ++i) {
    const Exact_point edge = minus(polygon[(i + 1) % polygon.size()], polygon[i]);
    least = std::min(least, sgn(dot(cross(level.normal, edge), minus(p, polygon[i]))));
  }
  return least;
}

bool may_meet(const Points& polygon, const Exact_point& p, const Exact_point& q) {
  const Level level = level_of(polygon);
  const Rational from = level.height(p), to = level.height(q);
  if (sgn(from) * sgn(to) > 0) return false;
  if (from == to) return true;
  return location(polygon, level, generate::along(p, Rational(from / (from - to)), minus(q, p))) >= 0;
}

}  // namespace sightline::harness::weak_flats
