#include <sightline/algorithms/image/painter.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/number_cones.h>
#include <sightline/algorithms/image/number_painter.h>
#include <sightline/algorithms/image/painted_cones.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>

namespace sightline {

namespace image_detail {

namespace {

/// Pieces farthest first.
template <class Number>
std::vector<std::uint32_t> sorted(const Scene& scene, const Pixel_view& pixels, Painter_key key,
                                  const Image_options& options) {
  unsigned asked = 0;
  const auto ask = [&] {
    if (options.progress && ++asked % 64 == 0) options.progress(0, scene.pieces().size());
  };
  const Vector_of<Number> eye = rounded<Number>(pixels.eye), look = converted<Number>(pixels.look);
  std::vector<Number> depths;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) {
    ask();
    depths.push_back(dot(minus(rounded<Number>(scene.position(p)), eye), look));
  }
  std::vector<Number> keys;
  for (const Piece& piece : scene.pieces()) {
    ask();
    const std::span<const Piece_corner> corners = scene.corners(piece);
    Number least = depths[corners[0].point], most = least, sum = 0;
    for (const Piece_corner& corner : corners) {
      const Number& depth = depths[corner.point];
      if (depth < least) least = depth;
      if (depth > most) most = depth;
      sum += depth;
    }
    sum /= Number(static_cast<unsigned>(corners.size()));
    keys.push_back(key == Painter_key::nearest ? least : key == Painter_key::farthest ? most : sum);
  }
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    ask();
    return keys[a] > keys[b];
  });
  return order;
}

std::vector<std::uint32_t> sorted(const Scene& scene, const Pixel_view& pixels, Painter_key key, Image_kernel kernel,
                                  const Image_options& options) {
  switch (kernel) {
    case Image_kernel::float_numbers: return sorted<float>(scene, pixels, key, options);
    case Image_kernel::double_numbers: return sorted<double>(scene, pixels, key, options);
    case Image_kernel::exact: break;
  }
  return sorted<Rational>(scene, pixels, key, options);
}

}  // namespace

}  // namespace image_detail

/// What shows if the cones that `make` gives, some `count`, are painted in their order.
template <class Make>
static Piece_image painted(const image_detail::Pixel_centres& centres, std::size_t count, const Image_options& options,
                           Make make) {
  const Pixel_view& pixels = centres.view();
  Piece_image image{pixels.width, pixels.height, {}, {}, {}};
  image.pieces.assign(std::size_t{pixels.width} * pixels.height, Piece_image::nothing);
  image_detail::run_with_threads_for(options, pixels, count, [&] {
    const image_detail::Painted_cones cones = make();
    image.counters = cones.paint(image_detail::Painted_cones::Border::whole, options,
                                 [&](std::size_t at, std::uint32_t piece) { image.pieces[at] = piece; });
  });
  return image;
}

Piece_image paint(const std::vector<Painted_polygon>& polygons, const Pixel_view& pixels, Image_kernel kernel,
                  const Image_options& options) {
  const image_detail::Pixel_centres centres(pixels);
  return painted(centres, polygons.size(), options,
                 [&] { return image_detail::Painted_cones(polygons, centres, kernel, options); });
}

Piece_image paint(const Exact_view& view, const Visible_surface<Exact_view>& surface, const Pixel_view& pixels,
                  const Image_options& options) {
  const image_detail::Pixel_centres centres(pixels);
  return painted(centres, surface.parts.size(), options,
                 [&] { return image_detail::Painted_cones(view, surface, centres, options); });
}

template <class Number>
static Piece_image paint_rounded(const Number_view<Number>& view, const Visible_surface<Number_view<Number>>& surface,
                                 const Pixel_view& pixels, const Image_options& options) {
  const image_detail::Pixel_centres centres(pixels);
  return painted(centres, surface.parts.size(), options,
                 [&] { return image_detail::Painted_cones(view, surface, centres, options); });
}

Piece_image paint(const Number_view<float>& view, const Visible_surface<Number_view<float>>& surface,
                  const Pixel_view& pixels, const Image_options& options) {
  return paint_rounded(view, surface, pixels, options);
}
Piece_image paint(const Number_view<double>& view, const Visible_surface<Number_view<double>>& surface,
                  const Pixel_view& pixels, const Image_options& options) {
  return paint_rounded(view, surface, pixels, options);
}

std::vector<Painted_polygon> heedless_order(const Scene& scene, const Pixel_view& pixels, Painter_key key,
                                            Image_kernel kernel, const Image_options& options) {
  std::vector<Painted_polygon> polygons;
  for (const std::uint32_t i : image_detail::sorted(scene, pixels, key, kernel, options)) {
    if (options.progress) options.progress(0, scene.pieces().size());
    Painted_polygon& polygon = polygons.emplace_back(Painted_polygon{i, {}});
    polygon.corners = scene.corner_points(scene.pieces()[i]);
  }
  return polygons;
}

Piece_image heedless_painter(const Scene& scene, const Pixel_view& pixels, Painter_key key, Image_kernel kernel,
                             const Image_options& options) {
  return paint(heedless_order(scene, pixels, key, kernel, options), pixels, kernel, options);
}

}  // namespace sightline
