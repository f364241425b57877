#include <sightline/harness/compare/image_errors.h>

#include <algorithm>
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

}  // namespace sightline
