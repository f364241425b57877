#pragma once
// The integer grid that a scene's points lie on, and the way from the file's coordinates to it and back.

#include <sightline/kernel/coordinates.h>
#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/located_point.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace sightline {

/// The coarsest grid that holds all points, centred, so that 26-bit detail a million units from the origin stays 26-bit
/// detail. The file's coordinate x is (offset + unit * grid) / scale for an integer grid coordinate. Exact: yes.
class Scene_grid {
 public:
  Scene_grid() = default;
  /// Places the points. `ids` becomes, for each of them, its point of the grid: equal points are one.
  /// Cost: O(n) hashing.
  Scene_grid(const Coordinates& coordinates, std::vector<std::uint32_t>& ids);

  const Grid_points& points() const { return points_; }

  /// Bit length of the largest coordinate once all are scaled to integers, and of that scale.
  int bits() const { return bits_read_; }
  int scale_bits() const { return static_cast<int>(bit_length(scale_)) - 1; }

  /// A plane of grid coordinates in the file's coordinates, up to a positive factor.
  std::array<Rational, 4> file_coefficients(const std::array<Integer, 4>& h) const;

  /// A point of the file's coordinates as predicates take it.
  Located_point locate(const Exact_point& p) const;

  /// The file's coordinates of a point in homogeneous grid coordinates. Pre: h[3] != 0.
  Exact_point position(const std::array<Integer, 4>& h) const;
  Exact_point position(std::uint32_t point) const;
  /// Appends a point of the grid to a soup. Cost: no allocation where numbers fit a machine's.
  Point_id add_point(std::uint32_t point, Polygon_soup& soup) const;
  /// The bounding box of all points, in the file's coordinates. Pre: there is one.
  std::array<Exact_point, 2> box() const;

 private:
  /// The file's coordinates of a point times scale_, where these and their parts fit a machine's numbers.
  std::optional<std::array<std::int64_t, 3>> small_position(std::uint32_t point) const;

  Integer scale_ = 1, unit_ = 1;
  std::array<Integer, 3> offset_;
  std::array<std::array<Integer, 3>, 2> box_;
  int bits_read_ = 0;
  Grid_points points_;
};

}  // namespace sightline
