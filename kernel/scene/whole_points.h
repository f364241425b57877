#pragma once
// Points as whole numbers: what is computed of these needs no common divisors.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sightline {

using Whole_point = std::array<Integer, 3>;

struct Whole_points {
  std::vector<Whole_point> points;
  Integer scale = 1;  ///< by which all are multiplied: the least common multiple of all denominators
};
/// Exact: yes. Degenerate: of no points the scale is 1.
inline Whole_points made_whole(std::span<const Exact_point> points) {
  Whole_points whole;
  for (const Exact_point& p : points)
    for (const Rational& x : p)
      if (x.get_den() != whole.scale) whole.scale = lcm(whole.scale, x.get_den());
  for (const Exact_point& p : points) {
    Whole_point& at = whole.points.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) at[k] = p[k].get_num() * Integer(whole.scale / p[k].get_den());
  }
  return whole;
}

}  // namespace sightline
