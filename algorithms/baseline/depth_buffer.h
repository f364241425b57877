#pragma once
// The plain depth buffer, over the whole sphere: what graphics hardware answers to "what is visible from here?".

#include <sightline/algorithms/image/piece_image.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// A side of the cube around the eye, a view of 90 degrees: the axes (0, 1, 2) that run to the right, up and forward in
/// its image, and their senses. As in a photograph, right x up points back at the eye.
struct Cube_side {
  std::array<std::size_t, 3> axis;
  std::array<int, 3> sense;

  template <class Number>
  std::array<Number, 3> turned(const std::array<Number, 3>& v) const {
    const auto along = [&](std::size_t k) { return sense[k] > 0 ? v[axis[k]] : Number(-v[axis[k]]); };
    return {along(0), along(1), along(2)};
  }
};
/// Towards +x, -x, +y, -y with z up; then up, and down.
inline constexpr std::array<Cube_side, 6> cube_sides{{{{1, 2, 0}, {-1, 1, 1}},
                                                      {{1, 2, 0}, {1, 1, -1}},
                                                      {{0, 2, 1}, {1, 1, 1}},
                                                      {{0, 2, 1}, {-1, 1, -1}},
                                                      {{0, 1, 2}, {1, -1, 1}},
                                                      {{0, 1, 2}, {1, 1, -1}}}};

struct Depth_buffer_options {
  std::uint32_t size = 1024;  ///< pixels along each side of the six square images; 1 to 16384
  int bits = 24;              ///< of a depth: 1 to 31, rounded to nearest; or 32: floats
  float near = 0, far = 0;    ///< distances of the clipping planes; 0: from the scene's box, near at least far / 4096
};

/// The pieces seen at the pixel centres of six images. Pixel (x, y) is x-th from the left, y-th from below; its centre
/// is the direction
/// ((2 x + 1) / size - 1) right + ((2 y + 1) / size - 1) up + forward.
struct Depth_buffer {
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};

  std::uint32_t size = 0;
  int bits = 0;
  float near = 0, far = 0;
  std::vector<std::uint32_t> pieces,
      depths;                    ///< of each pixel: what is seen, and its depth as it was stored (of a float its bits)
  std::uint64_t triangles = 0;   ///< rasterized, each in every image that it meets
  std::uint64_t clipped = 0;     ///< pieces cut or lost at the near plane, in each image
  std::uint64_t not_finite = 0;  ///< pieces left out, because floats do not hold them, the eye or the planes

  std::size_t pixel(std::size_t side, std::uint32_t x, std::uint32_t y) const { return (side * size + y) * size + x; }
  std::uint32_t piece(std::size_t side, std::uint32_t x, std::uint32_t y) const { return pieces[pixel(side, x, y)]; }
};

/// What a depth buffer sees of a scene: six images of 90 degrees each, all pieces drawn in the scene's order, both
/// sides of them. As graphics hardware does it: positions, eye, perspective and depths in floats; corners snapped to
/// 256ths of a pixel; pixel centres tested by edge functions, a centre on an edge drawn with the left and top ones; the
/// smaller stored depth wins, of equal ones what was drawn first. Pieces are cut at the near plane, and what is nearer
/// is lost; what is beyond the far plane gets its depth. Pre: size and bits within their bounds, 0 < near < far where
/// they are given, or std::invalid_argument. Degenerate: pieces edge-on cover no pixel, but for rounding; an empty
/// scene shows nothing; where floats do not hold the eye or the distances, all pieces are counted as not finite, else
/// those that they do not hold. Cost: O(pieces + pixels covered). Exact: no; that is its purpose. Ref: Catmull 1974, as
/// in the slides.
Depth_buffer depth_buffer(const Scene& scene, const Exact_point& eye, const Depth_buffer_options& options = {});

struct Depth_image {
  Piece_image image;
  float near = 0, far = 0;
  std::uint64_t not_finite = 0;  ///< pieces left out, because floats do not hold them, the eye or the planes
};

/// The same in one image; its size stands in the view, the options' own is not asked. Depths are along the direction
/// that it looks in. Errors: std::invalid_argument also where its directions do not span the space, as doubles tell.
Depth_image depth_image(const Scene& scene, const Pixel_view& pixels, const Depth_buffer_options& options = {});

}  // namespace sightline
