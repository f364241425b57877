#pragma once
// Images of faces that let through some of what is behind them: "over", layer by layer, in the order of depth.

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/colour.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/kernel/scene/pixel_view.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// All layers at each pixel's centre, one over the other, row by row from the top left.
struct Blended_image {
  std::uint32_t width = 0, height = 0;
  std::vector<Layer> layers;
  std::vector<std::uint8_t> tied;  ///< 1 where a rule had to choose; empty where nobody asks
  Image_counters counters;

  /// Errors: as centres(), for its size.
  static Blended_image empty(const Pixel_view& pixels);
};

/// Each pixel's layers as the exact ray through its centre meets them, nearest first, up to the first that hides all.
/// Of pieces met at one point the order is that of centres(). A pixel is tied where that rule chose, or the ray meets
/// the border of a layer. Pre: view.eye() is pixels.eye; a tint for each piece of the scene, its alpha from 0 to 1.
/// Degenerate: as centres(). Errors: as centres(); std::invalid_argument where tints are too few or not numbers. Cost:
/// that of centres(), and depths compared to sort the layers that are used. Parallel. Exact: which layers, and their
/// order; colours are doubles. Ref: Porter and Duff 1984, "over". Proof: P-85
Blended_image blended_centres(const Exact_view& view, const Pixel_view& pixels, const std::vector<Tint>& tints,
                              const Image_options& options = {});

/// The polygons painted in this order, farthest first, each over those before it. A centre on the border of polygons
/// belongs to those that are to the right of it, or above it: so a piece in several polygons counts once on their cut.
/// Pre: as blended_centres(). Degenerate, errors, cost: as paint(). Parallel. Exact: as order and kernel are; off ties,
/// orders of the scene's fragments make blended_centres(), but for rounding of colours. Proof: P-85
Blended_image blended_painting(const std::vector<Painted_polygon>& polygons, const Pixel_view& pixels,
                               Image_kernel kernel, const std::vector<Tint>& tints, const Image_options& options = {});

namespace image_detail {

/// Errors: std::invalid_argument unless there are so many, all of them numbers, and alpha from 0 to 1.
void check_tints(const std::vector<Tint>& tints, std::size_t pieces);

}  // namespace image_detail

}  // namespace sightline
