#pragma once
// A face by its light: cells that are lit, in penumbra, in umbra, and their borders.

#include <sightline/algorithms/weak_visibility/partition/curve_arrangement.h>
#include <sightline/algorithms/weak_visibility/partition/plane_chart.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

/// What points of a face see of the sources: all of each, some of them, nothing; up to measure zero.
enum class Light : char { lit, penumbra, umbra, undecided };
inline constexpr std::size_t lights = 4;
const char* name_of(Light light);

/// A convex piece of a face, divided. Coordinates x, y are of its chart: a point is origin + x u + y v.
struct Light_partition {
  std::uint32_t piece;
  std::array<Exact_point, 3> chart;  ///< origin, u, v, in the file's coordinates
  std::vector<Plane_curve> curves;

  /// An open connected set from all of whose points, but for curves, the same is seen.
  struct Cell {
    Light light;
    std::array<Rational, 2> at;  ///< a point of it
    Bounded area;                ///< as a share of the piece
    /// The edges that bound what is seen of each source, where all borders are asked for: two points on each.
    std::vector<std::vector<std::array<Exact_point, 2>>> edges;
  };
  std::vector<Cell> cells;

  /// A part of a curve between two cells: over an interval of x the lower or the upper of its two values of y, or the
  /// only one. `none`: outside the piece.
  struct Border {
    std::size_t curve;
    bool upper;
    std::size_t below, above;     ///< cells
    std::array<Bounded, 2> x, y;  ///< of its ends
  };
  /// Where a curve is x = constant.
  struct Upright {
    Bounded x;
    std::size_t left, right;
    std::array<Bounded, 2> y;
  };
  static constexpr std::size_t none = ~std::size_t{0};
  std::vector<Border> borders;
  std::vector<Upright> uprights;

  /// What a cell consists of, between two values of x, for pictures: points of its lower and of its upper border.
  struct Strip {
    std::size_t cell;
    std::vector<std::array<double, 2>> lower, upper;
  };
  std::vector<Strip> strips;
  /// Points of borders, a part of one in each.
  std::vector<std::vector<std::array<double, 2>>> border_lines;

  Exact_point point(const Rational& x, const Rational& y) const;  ///< of the chart, in the file's coordinates
  std::array<Bounded, lights> shares() const;                     ///< of the piece
  /// The cell that a point is in. `none`: outside of the piece, on a border, or straight above or below an end of one
  /// as far as doubles tell; of a cell that is narrower than these tell, it may be the one beside it. Pre: no cell is
  /// undecided. Cost: all borders. Exact: yes, but for that
  std::size_t cell_at(const Rational& x, const Rational& y) const;
};

/// Of a face that consists of these pieces. Surfaces that are not planar have roots as areas. Exact: bounds
std::array<Bounded, lights> shares_of_face(const Scene& scene, std::span<const Light_partition> pieces);

}  // namespace sightline
