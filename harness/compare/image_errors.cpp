#include <sightline/harness/compare/image_errors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sightline {

Image_errors image_errors(const Scene& scene, const Piece_image& truth, const Piece_image& image) {
  constexpr Face_id nothing = Piece_image::nothing;
  const auto face = [&](std::uint32_t piece) { return piece == nothing ? nothing : scene.pieces()[piece].face; };
  Image_errors errors;
  errors.pixels = truth.pieces.size();
  std::vector<std::uint64_t> pixels(scene.counters().faces_read);  // of each face, where it is true
  std::vector<bool> shown(pixels.size());
  for (std::size_t i = 0; i < truth.pieces.size(); ++i) {
    const Face_id expected = face(truth.pieces[i]), found = face(image.pieces[i]);
    if (found != nothing) shown[found] = true;
    if (truth.tied[i]) {
      ++errors.tied;
      continue;
    }
    errors.wrong += expected != found;
    if (expected != nothing) ++pixels[expected];
  }
  for (std::size_t f = 0; f < pixels.size(); ++f) {
    if (pixels[f] == 0 || shown[f]) continue;
    ++errors.missing;
    errors.largest_missing = std::max(errors.largest_missing, pixels[f]);
  }
  return errors;
}

Colour_errors colour_errors(const Blended_image& truth, const Blended_image& image) {
  Colour_errors errors;
  errors.pixels = truth.layers.size();
  double sum = 0;
  for (std::size_t i = 0; i < truth.layers.size(); ++i) {
    if (truth.tied[i]) {
      ++errors.tied;
      continue;
    }
    const Layer &right = truth.layers[i], &made = image.layers[i];
    double error = 255 * std::fabs(right.alpha - made.alpha);
    for (std::size_t k = 0; k < 3; ++k) error = std::max(error, std::fabs(right.colour[k] - made.colour[k]));
    errors.wrong += error > 0.5;
    errors.largest = std::max(errors.largest, error);
    sum += error;
  }
  if (errors.pixels > errors.tied) errors.mean = sum / static_cast<double>(errors.pixels - errors.tied);
  return errors;
}

}  // namespace sightline
