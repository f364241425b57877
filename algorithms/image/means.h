#pragma once
// An image whose pixels are the means over their squares of what is seen: anti-aliased without samples.

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/colour.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/pixel_view.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sightline {

/// What is seen in the squares of a row's pixels, from the left; as long as what holds it.
struct Mean_row {
  std::uint32_t y;
  std::span<const Colour> colours;  ///< sums: each times its share of the square
  std::span<const double> covered;  ///< the share of the square in which something is seen, times what that hides
};

/// All rows, from the top.
struct Mean_image {
  std::uint32_t width = 0, height = 0;
  std::vector<Colour> colours;
  std::vector<double> covered;

  /// Nothing is seen yet. Errors: as centres(), for its size.
  static Mean_image empty(const Pixel_view& pixels);
  void set(const Mean_row& row);
  Mean_row row(std::uint32_t y) const {
    const std::size_t first = std::size_t{y} * width;
    return {y, std::span(colours).subspan(first, width), std::span(covered).subspan(first, width)};
  }
};

/// The four sides of what an image shows, for an Exact_view: its normals as field_of() gives them.
std::vector<std::array<Integer, 3>> field_of(const Pixel_view& pixels);

/// The colours of what is seen, summed over each pixel's square: each row once, in any order, from any thread. Pre: the
/// surface is that of field_of_view(view), with field_of(pixels). Errors: as centres(). Cost: parts, rows of them, and
/// pixels that they cover in part; those covered whole cost one sum; memory for one row a thread. Parallel. Exact:
/// regions are; their corners in the image are rounded to doubles, each within 2^-30 of a pixel. Proof: P-81
void visible_means(const Exact_view& view, const Visible_surface<Exact_view>& surface, const Pixel_view& pixels,
                   const std::function<Colour(std::uint32_t piece)>& colour,
                   const std::function<void(const Mean_row&)>& visit, const Image_options& options = {});
/// All rows: 32 bytes a pixel, which cost more than what is in them where a scene is small.
Mean_image visible_means(const Exact_view& view, const Visible_surface<Exact_view>& surface, const Pixel_view& pixels,
                         const std::function<Colour(std::uint32_t piece)>& colour, const Image_options& options = {});

/// The same of all layers down to those that hide all: of each its colour times alpha and what those before it let
/// through, over exactly the part of the square in which it is behind those. Pre: the view has field_of(pixels); a tint
/// for each piece of the scene, its alpha from 0 to 1. Degenerate: as visible_layers(). Errors: as blended_centres().
/// Cost: visible_layers(), and that of visible_means() for each of them; memory for the corners of all parts. Parallel.
/// Exact: as visible_means(). Proof: P-81, P-85
void blended_means(const Exact_view& view, const Pixel_view& pixels, const std::vector<Tint>& tints,
                   const std::function<void(const Mean_row&)>& visit, const Image_options& options = {});
/// All rows.
Mean_image blended_means(const Exact_view& view, const Pixel_view& pixels, const std::vector<Tint>& tints,
                         const Image_options& options = {});

}  // namespace sightline
