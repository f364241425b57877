#pragma once
// What the square of a pixel shows, from the definition alone: rationals, and no code of those that make pictures.

#include <sightline/algorithms/image/colour.h>
#include <sightline/harness/compare/flat_polygon.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace sightline {

/// A scene's pieces in the plane of an image, ready to be asked about its pixels.
class Pixel_squares {
 public:
  /// Pre: finite directions that span the space; they outlive this. Degenerate: pieces in whose plane the eye is are
  /// not seen. Cost: 10 microseconds an edge.
  Pixel_squares(const Scene& scene, const Pixel_view& pixels);
  Pixel_squares(Scene&&, const Pixel_view&) = delete;
  Pixel_squares(const Scene&, Pixel_view&&) = delete;

  /// All layers over a pixel's square: of each its colour times alpha and what those before it let through, times the
  /// area in which it is there. Pre: a tint for each piece of the scene. Degenerate: of pieces met at once the one seen
  /// from its front is before the one seen from behind, then the lower face id, then the lower number. Cost: the
  /// pieces, once in doubles, and convex cells of the square, as many as outlines and crossings of what is not hidden
  /// make there. Exact: areas are; sums of colours are doubles.
  Layer mean(std::uint32_t x, std::uint32_t y, const std::vector<Tint>& tints) const;

 private:
  using Form = std::array<Rational, 3>;  // a across + b upwards + c
  struct Seen_piece {
    std::vector<Flat_polygon::Flat_line> edges;  // inside in their fronts
    std::vector<std::array<double, 3>> about;    // the same; the largest coefficient 1 or -1
    Form nearness;                               // 1 / t
    std::tuple<bool, Face_id, std::uint32_t> rank;
    std::uint32_t piece;
  };
  using Members = std::vector<std::uint32_t>;  // pieces, by their places in `seen_`

  struct Corner {
    Flat_polygon::Point exact;
    std::array<double, 2> about;
  };
  using Corners = std::vector<Corner>;

  /// Adds what the members show in a convex cell of a square of the area `whole`.
  void show(const Flat_polygon& cell, const Members& members, const Rational& whole, const std::vector<Tint>& tints,
            Layer& sum) const;
  static bool has_area(const Seen_piece& seen, const Flat_polygon& cell, const Corners& corners);

  Pixel_view pixels_;
  std::vector<Seen_piece> seen_;
};

}  // namespace sightline
