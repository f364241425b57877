#include <sightline/algorithms/priority/pair_code.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace sightline {

std::optional<bool> Pair_code::first_is_nearer(const Exact_point& eye) const {
  if (precedence == Precedence::first || precedence == Precedence::second) return precedence == Precedence::first;
  if (precedence == Precedence::never) return std::nullopt;
  const int side = sgn(dot(plane->normal, minus(eye, plane->point)));
  return side == 0 ? std::nullopt : std::optional(side > 0);
}

namespace priority_detail {

/// The coordinates, least and most, of what a convex polygon has of a line in a plane that it crosses. `heights`: of
/// its corners over the plane, of both signs.
static std::array<Rational, 2> chord(const std::vector<Exact_point>& points, const std::vector<Rational>& heights,
                                     std::size_t axis) {
  std::optional<std::array<Rational, 2>> found;
  const auto add = [&](const Rational& x) {
    if (!found) found = {x, x};
    (*found)[0] = std::min((*found)[0], x);
    (*found)[1] = std::max((*found)[1], x);
  };
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t next = k + 1 == points.size() ? 0 : k + 1;
    if (heights[k] == 0) add(points[k][axis]);
    if (sgn(heights[k]) * sgn(heights[next]) >= 0) continue;
    const Rational share = heights[k] / (heights[k] - heights[next]);
    add(Rational(points[k][axis] + share * (points[next][axis] - points[k][axis])));
  }
  return *found;
}

/// Whether convex polygons have a point inside both, across each other: then no plane is between them.
static bool cross_inside(const std::vector<Exact_point>& p, const std::vector<Exact_point>& q) {
  const auto normal_of = [](const std::vector<Exact_point>& points) {
    Exact_point sum{0, 0, 0};
    for (std::size_t k = 2; k < points.size(); ++k) {
      const Exact_point part = cross(minus(points[k - 1], points[0]), minus(points[k], points[0]));
      for (std::size_t i = 0; i < 3; ++i) sum[i] += part[i];
    }
    return sum;
  };
  const auto heights_of = [](const std::vector<Exact_point>& points, const Exact_point& normal,
                             const Exact_point& origin) {
    std::vector<Rational> heights;
    for (const Exact_point& point : points) heights.push_back(dot(normal, minus(point, origin)));
    return heights;
  };
  const auto both_signs = [](const std::vector<Rational>& heights) {
    const auto [least, most] = std::minmax_element(heights.begin(), heights.end());
    return *least < 0 && *most > 0;
  };
  const Exact_point of_p = normal_of(p), of_q = normal_of(q), along = cross(of_p, of_q);
  const std::vector<Rational> p_over_q = heights_of(p, of_q, q[0]), q_over_p = heights_of(q, of_p, p[0]);
  if (!both_signs(p_over_q) || !both_signs(q_over_p)) return false;
  const std::size_t axis = along[0] != 0 ? 0 : along[1] != 0 ? 1 : 2;
  const std::array<Rational, 2> in_p = chord(p, p_over_q, axis), in_q = chord(q, q_over_p, axis);
  return std::max(in_p[0], in_q[0]) < std::min(in_p[1], in_q[1]);
}

std::optional<Normal_and_point> plane_between(const std::vector<Exact_point>& p, const std::vector<Exact_point>& q) {
  if (cross_inside(p, q)) return std::nullopt;
  // Of points of which one, that is left out, is on the plane: outwards from it, as those next to it tell of most
  // planes that they are on both sides.
  const auto side = [](const std::vector<Exact_point>& points, std::size_t on, const Exact_point& normal,
                       const Exact_point& origin) -> std::optional<int> {
    const std::size_t n = points.size();
    int found = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t away = k / 2 + 1, at = on + (k % 2 == 0 ? away : n - away);
      const int s = sgn(dot(normal, minus(points[at % n], origin)));
      if (s * found < 0) return std::nullopt;
      if (s != 0) found = s;
    }
    return found;
  };
  for (const auto& [edges, corners] : {std::pair(&p, &q), std::pair(&q, &p)})
    for (std::size_t k = 0; k < edges->size(); ++k) {
      const Exact_point &origin = (*edges)[k], arm = minus((*edges)[k + 1 == edges->size() ? 0 : k + 1], origin);
      for (std::size_t l = 0; l < corners->size(); ++l) {
        const Exact_point normal = cross(arm, minus((*corners)[l], origin));
        const std::optional<int> other = side(*corners, l, normal, origin);
        if (!other || *other == 0) continue;
        int own = 0;  // of any corner, as all are on one side of the edge
        for (std::size_t c = 0; own == 0 && c < edges->size(); ++c) own = sgn(dot(normal, minus((*edges)[c], origin)));
        if (own != -*other) continue;
        const std::optional<int> of_p = edges == &p ? own : other;
        return Normal_and_point{*of_p > 0 ? normal : minus(Exact_point{0, 0, 0}, normal), origin};
      }
    }
  return std::nullopt;
}

}  // namespace priority_detail
}  // namespace sightline
