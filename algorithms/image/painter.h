#pragma once
// Images painted over and over, farthest first: in an order that somebody has, or in one of the three heedless ones.

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <cstdint>
#include <vector>

namespace sightline {

/// The numbers that an image is made in.
enum class Image_kernel { float_numbers, double_numbers, exact };

/// A convex polygon of the scene, and the piece that it shows.
struct Painted_polygon {
  std::uint32_t piece;
  std::vector<Exact_point> corners;
};

/// What shows where the polygons are painted in this order, each over those before it, at pixel centres. A centre on a
/// border belongs to the polygon. Degenerate: polygons in whose plane the eye is are not painted; nor are those that
/// the kernel's numbers cannot hold, or flatten. Errors: as centres(). Cost: polygons, rows of them, and centres that
/// they cover. Parallel. Exact: as the kernel is.
Piece_image paint(const std::vector<Painted_polygon>& polygons, const Pixel_view& pixels, Image_kernel kernel,
                  const Image_options& options = {});

/// What a visible surface shows at pixel centres. A centre on the border of several parts shows the last of them in
/// which something is seen. Pre: view.eye() is pixels.eye; the surface is the view's. Errors: as centres(). Cost:
/// parts, rows of them, and centres that they cover. Parallel. Exact: yes. Proof: P-80, P-83
Piece_image paint(const Exact_view& view, const Visible_surface<Exact_view>& surface, const Pixel_view& pixels,
                  const Image_options& options = {});

/// By which depth, along the direction that one looks in, the heedless painter sorts: of a polygon's nearest corner,
/// of its farthest one, or of all corners' mean.
enum class Painter_key { nearest, farthest, mean };

/// The scene's pieces, farthest first by the key; of equal ones in the scene's order. An order that hides the wrong
/// faces wherever depths overlap: that is its purpose. Exact: sorting is as the kernel is; the order is not. Ref: the
/// slides' painter.
std::vector<Painted_polygon> heedless_order(const Scene& scene, const Pixel_view& pixels, Painter_key key,
                                            Image_kernel kernel, const Image_options& options = {});
/// The same, painted.
Piece_image heedless_painter(const Scene& scene, const Pixel_view& pixels, Painter_key key, Image_kernel kernel,
                             const Image_options& options = {});

}  // namespace sightline
