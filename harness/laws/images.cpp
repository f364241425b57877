#include <sightline/harness/laws/images.h>

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/harness/generate/pixel_views.h>

namespace sightline::harness::images {

Image_options serial() {
  Image_options options;
  options.threads = 1;
  return options;
}

std::string place(const Pixel_view& pixels, std::size_t i) {
  return "pixel " + std::to_string(i % pixels.width) + "," + std::to_string(i / pixels.width);
}
std::string name(std::uint32_t piece) {
  return piece == Piece_image::nothing ? "nothing" : "piece " + std::to_string(piece);
}

/// Both show the same off ties; everywhere, where `ties` says that rules are the same.
Outcome same(const Pixel_view& pixels, const Piece_image& truth, const Piece_image& image, const std::string& method,
             bool ties) {
  for (std::size_t i = 0; i < truth.pieces.size(); ++i)
    if ((ties || !truth.tied[i]) && truth.pieces[i] != image.pieces[i])
      return Outcome::failed(place(pixels, i) + " shows " + name(truth.pieces[i]) + " to an exact ray, " +
                             name(image.pieces[i]) + " by " + method);
  return {};
}

Seen::Seen(const generate::Posed_scene& posed, generate::Random& random)
    : soup(posed.soup), scene(posed.soup), pixels(generate::any_pixel_view(posed.soup, posed.eye, random)) {}

Piece_image Seen::truth() const { return centres(Exact_view(scene, pixels.eye), pixels, serial()); }

Check check_of(const std::string& name, const std::string& what, Image_check run) {
  return {name, what, [run](const Posed_scene& posed, const Answer&, Random& random) {
            if (posed.soup.point_count() == 0) return Outcome::not_applicable();
            return run(Seen(posed, random));
          }};
}

}  // namespace sightline::harness::images
