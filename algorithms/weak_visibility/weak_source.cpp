#include <sightline/algorithms/weak_visibility/weak_source.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/whole_points.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace sightline {

namespace {

/// Which way points of one plane turn, seen from the side that its normal points to. Doubles tell it but for points
/// that are nearly in line.
class Turns {
 public:
  /// Pre: the points are in a plane of this normal, which is not 0.
  Turns(const std::vector<Whole_point>& points, const Whole_point& normal) {
    std::size_t axis = 0;
    while (sgn(normal[axis]) == 0) ++axis;
    is_turned_ = sgn(normal[axis]) < 0;
    const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
    for (const Whole_point& p : points) {
      exact_.push_back({Integer(p[x] - points[0][x]), Integer(p[y] - points[0][y])});
      near_.push_back({exact_.back()[0].get_d(), exact_.back()[1].get_d()});
      for (const double c : near_.back()) size_ = std::max(size_, std::fabs(c));
    }
  }
  /// 1 to the left, 0 straight on or back, -1 to the right.
  int of(std::size_t a, std::size_t b, std::size_t c) const {
    const int sign = seen_along_the_axis(a, b, c);
    return is_turned_ ? -sign : sign;
  }
  /// Whether a loop of points, each of which turns to the same side, goes around once: of the edges' directions one
  /// half of all is left once and entered once.
  bool go_around_once(const std::vector<std::size_t>& loop) const {
    const auto is_upward = [&](std::size_t i) {
      const Flat_point<Integer>&from = exact_[loop[i]], &to = exact_[loop[(i + 1) % loop.size()]];
      return to[1] != from[1] ? to[1] > from[1] : to[0] > from[0];
    };
    std::size_t changes = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (is_upward(i) != is_upward((i + 1) % loop.size())) ++changes;
    return changes == 2;
  }

 private:
  template <class Number>
  using Flat_point = std::array<Number, 2>;
  template <class Number>
  static Number area(const Flat_point<Number>& a, const Flat_point<Number>& b, const Flat_point<Number>& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  int seen_along_the_axis(std::size_t a, std::size_t b, std::size_t c) const {
    // Coordinates are within 2^-52 of the largest, differences of at most twice its size within 3 * 2^-52: in all less
    // than 32 * 2^-52 of its square.
    if (size_ < 0x1p400) {
      const double doubled = area(near_[a], near_[b], near_[c]), error = 0x1p-46 * size_ * size_;
      if (doubled > error) return 1;
      if (doubled < -error) return -1;
    }
    return sgn(area(exact_[a], exact_[b], exact_[c]));
  }

  std::vector<Flat_point<Integer>> exact_;
  std::vector<Flat_point<double>> near_;
  double size_ = 0;
  bool is_turned_ = false;
};

}  // namespace

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
  const std::vector<Whole_point> whole = made_whole(corners).points;
  Whole_point normal{0, 0, 0};
  for (std::size_t i = 1; i + 1 < whole.size(); ++i) {
    const Whole_point part = cross(minus(whole[i], whole[0]), minus(whole[i + 1], whole[0]));
    for (std::size_t k = 0; k < 3; ++k) normal[k] += part[k];
  }
  if (is_zero(normal))
    throw std::invalid_argument(
        "a source has no area; give the corners of a convex polygon, counterclockwise as seen from the side it looks "
        "to");
  for (const Whole_point& p : whole)
    if (sgn(dot(normal, minus(p, whole[0]))) != 0)
      throw std::invalid_argument("a source is not planar; cut it into triangles and give each of them");
  const char* const not_convex = "a source is not convex; cut it into convex polygons and give each of them";
  const Turns turns(whole, normal);
  const std::size_t count = corners.size();
  std::vector<std::size_t> strict;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count, after = (i + 1) % count;
    const int turn = turns.of(before, i, after);
    if (turn < 0 || (turn == 0 && sgn(dot(minus(whole[i], whole[before]), minus(whole[after], whole[i]))) < 0))
      throw std::invalid_argument(not_convex);
    if (turn > 0) strict.push_back(i);
  }
  if (!turns.go_around_once(strict)) throw std::invalid_argument(not_convex);  // a star turns left everywhere too
  std::vector<Exact_point> kept;
  for (const std::size_t i : strict) kept.push_back(corners[i]);
  return kept;
}

Weak_source weak_source(const Occluders& occluders, const std::vector<Exact_point>& points) {
  Weak_source source;
  for (const Exact_point& p : strict_corners(points)) source.polygon.push_back(occluders.located(p));
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
