#include <sightline/algorithms/priority/pair_code.h>

#include <sightline/kernel/vectors.h>

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

std::optional<Normal_and_point> plane_between(const std::vector<Exact_point>& p, const std::vector<Exact_point>& q) {
  const auto side = [](const std::vector<Exact_point>& points, const Exact_point& normal,
                       const Exact_point& origin) -> std::optional<int> {
    int found = 0;
    for (const Exact_point& point : points) {
      const int s = sgn(dot(normal, minus(point, origin)));
      if (s * found < 0) return std::nullopt;
      if (s != 0) found = s;
    }
    return found;
  };
  for (const auto& [edges, corners] : {std::pair(&p, &q), std::pair(&q, &p)})
    for (std::size_t k = 0; k < edges->size(); ++k) {
      const Exact_point &origin = (*edges)[k], arm = minus((*edges)[k + 1 == edges->size() ? 0 : k + 1], origin);
      for (const Exact_point& corner : *corners) {
        const Exact_point normal = cross(arm, minus(corner, origin));
        const std::optional<int> of_p = side(p, normal, origin);
        if (!of_p || *of_p == 0) continue;
        const std::optional<int> of_q = side(q, normal, origin);
        if (!of_q || *of_q != -*of_p) continue;
        return Normal_and_point{*of_p > 0 ? normal : minus(Exact_point{0, 0, 0}, normal), origin};
      }
    }
  return std::nullopt;
}

}  // namespace priority_detail
}  // namespace sightline
