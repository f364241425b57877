#pragma once
// Small models, of which answers are known by hand.

#include <sightline/sightline.h>

#include <array>
#include <cstdint>
#include <vector>

namespace sightline {

using Points = std::vector<std::array<double, 3>>;

/// The cube [-1, 1]^3, its faces seen from outside: -x, +x, -y, +y, -z, +z.
inline Model cube() {
  const Points points{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                      {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const std::vector<std::uint32_t> corners{0, 4, 7, 3, 1, 2, 6, 5, 0, 1, 5, 4, 3, 7, 6, 2, 0, 3, 2, 1, 4, 5, 6, 7};
  return Model::of_polygons(points, corners, std::vector<std::uint32_t>(6, 4));
}

/// A floor, a lid above it that hides it in part, a lamp above both that looks down, and a sliver that is none.
inline Model lamp_and_lid() {
  const Points points{{-4, -4, 0}, {4, -4, 0}, {4, 4, 0},   {-4, 4, 0}, {-1, -1, 1}, {1, -1, 1},
                      {1, 1, 1},   {-1, 1, 1}, {-1, -1, 3}, {1, -1, 3}, {1, 1, 3},   {-1, 1, 3}};
  const std::vector<std::uint32_t> corners{0, 1, 2, 3, 4, 5, 6, 7, 11, 10, 9, 8, 0, 1, 1};
  const std::vector<std::uint32_t> sizes{4, 4, 4, 3};
  return Model::of_polygons(points, corners, sizes);
}

}  // namespace sightline
