#include <sightline/algorithms/image/blend.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/image_faces.h>
#include <sightline/algorithms/image/painted_cones.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sightline {

namespace image_detail {

void check_tints(const std::vector<Tint>& tints, std::size_t pieces) {
  if (tints.size() < pieces) throw std::invalid_argument("there is a tint for each piece");
  for (const Tint& tint : tints)
    if (!(tint.alpha >= 0 && tint.alpha <= 1) ||
        !std::all_of(tint.colour.begin(), tint.colour.end(), [](double c) { return std::isfinite(c); }))
      throw std::invalid_argument("a tint is a finite colour, and an alpha from 0 to 1");
}

namespace {

/// One of the faces that a ray meets.
struct Met_layer {
  Nearness nearness;
  bool on_border;
};

/// Layers at the centres of a row, column by column.
class Layered_row {
 public:
  Layered_row(const Image_faces& faces, std::size_t width) : faces_(faces), met_(width) {}

  void meet(std::uint32_t face, std::int64_t y, Image_counters& counters) {
    const Pixel_form& form = faces_.nearness(face);
    const double k = form.at_row(faces_.centres().upwards(y));
    faces_.cones().row(face, y, counters, [&](std::int64_t x, bool on_border) {
      met_[static_cast<std::size_t>(x)].push_back(
          {{form.a * faces_.centres().across(x) + k, form.bound, face}, on_border});
    });
  }

  /// Takes the layers of a column, nearest first, up to one that hides all. Returns whether a rule had to choose.
  template <class Take>
  bool take(std::int64_t x, std::int64_t y, Image_counters& counters, Take take_layer) {
    std::vector<Met_layer>& met = met_[static_cast<std::size_t>(x)];
    bool tied = false, hides_all = false;
    const auto is_later = [&](const Met_layer& a, const Met_layer& b) {
      const int nearer = faces_.nearer(a.nearness, b.nearness, x, y, counters);
      return nearer < 0 || (nearer == 0 && faces_.before(b.nearness.face, a.nearness.face));
    };
    std::make_heap(met.begin(), met.end(), is_later);
    for (auto last = met.end(); last != met.begin() && !hides_all; --last) {
      std::pop_heap(met.begin(), last, is_later);
      const Met_layer& nearest = *(last - 1);
      tied = tied || nearest.on_border ||
             (last - 1 != met.begin() && faces_.nearer(nearest.nearness, met.front().nearness, x, y, counters) == 0);
      hides_all = take_layer(faces_.piece(nearest.nearness.face));
    }
    met.clear();
    return tied;
  }

 private:
  const Image_faces& faces_;
  std::vector<std::vector<Met_layer>> met_;
};

}  // namespace

}  // namespace image_detail

Blended_image Blended_image::empty(const Pixel_view& pixels) {
  const image_detail::Pixel_centres checked(pixels);
  Blended_image image{pixels.width, pixels.height, {}, {}, {}};
  image.layers.resize(std::size_t{pixels.width} * pixels.height);
  return image;
}

Blended_image blended_centres(const Exact_view& view, const Pixel_view& pixels, const std::vector<Tint>& tints,
                              const Image_options& options) {
  using namespace image_detail;
  check_tints(tints, view.scene().pieces().size());
  Blended_image image = Blended_image::empty(pixels);
  image.tied.assign(image.layers.size(), 0);
  run_with_threads_for(options, pixels, view.scene().pieces().size(), [&] {
    const Image_faces faces(view, pixels, options);
    const Pixel_cones& cones = faces.cones();
    image.counters = faces.counters();
    image.counters += draw_bands(bands_of(cones), options, [&](const Band& band, Image_counters& counters) {
      Layered_row row(faces, pixels.width);
      for (std::int64_t y = band.top; y < band.bottom; ++y) {
        for (const std::uint32_t face : band.cones)
          if (cones[face].top <= y && y < cones[face].bottom) row.meet(face, y, counters);
        for (std::int64_t x = 0; x < pixels.width; ++x) {
          const std::size_t at = static_cast<std::size_t>(y) * pixels.width + static_cast<std::size_t>(x);
          image.tied[at] = row.take(x, y, counters, [&](std::uint32_t piece) {
            image.layers[at].put_behind(tints[piece]);
            return tints[piece].alpha >= 1;
          });
        }
      }
    });
  });
  return image;
}

Blended_image blended_painting(const std::vector<Painted_polygon>& polygons, const Pixel_view& pixels,
                               Image_kernel kernel, const std::vector<Tint>& tints, const Image_options& options) {
  using namespace image_detail;
  std::size_t pieces = 0;
  for (const Painted_polygon& polygon : polygons)
    pieces = std::max<std::size_t>(pieces, polygon.piece + std::size_t{1});
  check_tints(tints, pieces);
  Blended_image image = Blended_image::empty(pixels);
  const Pixel_centres centres(pixels);
  run_with_threads_for(options, pixels, polygons.size(), [&] {
    const Painted_cones painted(polygons, centres, kernel, options);
    image.counters = painted.paint(Painted_cones::Border::half, options, [&](std::size_t at, std::uint32_t piece) {
      image.layers[at].put_before(tints[piece]);
    });
  });
  return image;
}

}  // namespace sightline
