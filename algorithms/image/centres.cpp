#include <sightline/algorithms/image/centres.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/image_faces.h>

#include <vector>

namespace sightline {

namespace image_detail {

namespace {

/// What was met first so far in a row.
struct Met {
  Nearness nearness;
  bool tied = false;
};

/// Row y as one face changes it.
void draw(const Image_faces& faces, std::vector<Met>& row, std::uint32_t face, std::int64_t y,
          Image_counters& counters) {
  const Pixel_form& form = faces.nearness(face);
  const double k = form.at_row(faces.centres().upwards(y));
  faces.cones().row(face, y, counters, [&](std::int64_t x, bool on_border) {
    Met& met = row[static_cast<std::size_t>(x)];
    const Nearness here{form.a * faces.centres().across(x) + k, form.bound, face};
    const int nearer = met.nearness.face == Nearness::nothing ? 1 : faces.nearer(here, met.nearness, x, y, counters);
    if (nearer > 0 || (nearer == 0 && faces.before(face, met.nearness.face))) met = {here, on_border};
    if (nearer == 0) met.tied = true;
  });
}

Piece_image image_at_centres(const Image_faces& faces, const Image_options& options) {
  Piece_image image = faces.empty_image();
  image.tied.assign(image.pieces.size(), 0);
  const Pixel_cones& cones = faces.cones();
  image.counters += draw_bands(bands_of(cones), options, [&](const Band& band, Image_counters& counters) {
    std::vector<Met> row;
    for (std::int64_t y = band.top; y < band.bottom; ++y) {
      row.assign(image.width, {});
      for (const std::uint32_t face : band.cones)
        if (cones[face].top <= y && y < cones[face].bottom) draw(faces, row, face, y, counters);
      for (std::uint32_t x = 0; x < image.width; ++x) {
        if (row[x].nearness.face == Nearness::nothing) continue;
        const std::size_t at = image.pixel(x, static_cast<std::uint32_t>(y));
        image.pieces[at] = faces.piece(row[x].nearness.face);
        image.tied[at] = row[x].tied;
      }
    }
  });
  return image;
}

}  // namespace

}  // namespace image_detail

Piece_image centres(const Exact_view& view, const Pixel_view& pixels, const Image_options& options) {
  Piece_image image;
  image_detail::run_with_threads_for(options, pixels, view.scene().pieces().size(), [&] {
    image = image_detail::image_at_centres(image_detail::Image_faces(view, pixels), options);
  });
  return image;
}

}  // namespace sightline
