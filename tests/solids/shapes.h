#pragma once
// Boxes and the like, as closed surfaces.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <string>
#include <vector>

namespace test_solids {

using sightline::Exact_point;
using sightline::Polygon_soup;
using sightline::Rational;

/// A box, fronts outwards, added to a soup.
inline void add_box(Polygon_soup& soup, const Exact_point& low, const Exact_point& high) {
  std::array<sightline::Point_id, 8> p;
  for (std::size_t k = 0; k < 8; ++k)
    p[k] = soup.add_point((k & 4) != 0 ? high[0] : low[0], (k & 2) != 0 ? high[1] : low[1],
                          (k & 1) != 0 ? high[2] : low[2]);
  for (const std::array<std::size_t, 4>& face :
       {std::array<std::size_t, 4>{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}})
    soup.add_face({p[face[0]], p[face[1]], p[face[2]], p[face[3]]});
}
inline Polygon_soup box(const Exact_point& low, const Exact_point& high) {
  Polygon_soup soup;
  add_box(soup, low, high);
  return soup;
}

}  // namespace test_solids
