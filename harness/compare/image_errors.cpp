#include <sightline/harness/compare/image_errors.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sightline {

Image_errors image_errors(const Scene& scene, const Piece_image& truth, const Piece_image& image) {
  constexpr Face_id nothing = Piece_image::nothing;
  const auto face = [&](std::uint32_t piece) { return piece == nothing ? nothing : scene.pieces()[piece].face; };
  Image_errors errors;
  errors.pixels = truth.pieces.size();
  std::vector<std::uint64_t> pixels(scene.counters().faces_read);  // of each face, where it is true
  std::vector<bool> shown(pixels.size()), is_covered(pixels.size()), is_wrong(pixels.size());
  for (std::size_t i = 0; i < truth.pieces.size(); ++i) {
    const Face_id expected = face(truth.pieces[i]), found = face(image.pieces[i]);
    if (found != nothing) shown[found] = true;
    if (truth.tied[i]) {
      ++errors.tied;
      continue;
    }
    if (expected != nothing) ++pixels[expected];
    if (expected == found) continue;
    ++errors.wrong;
    if (expected != nothing) is_covered[expected] = true;
    if (found != nothing) is_wrong[found] = true;
  }
  for (Face_id f = 0; f < pixels.size(); ++f) {
    if (is_covered[f]) errors.covered.push_back(f);
    if (is_wrong[f]) errors.shown.push_back(f);
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
    const double error = difference(truth.layers[i], image.layers[i]);
    errors.wrong += error > 0.5;
    errors.largest = std::max(errors.largest, error);
    sum += error;
  }
  if (errors.pixels > errors.tied) errors.mean = sum / static_cast<double>(errors.pixels - errors.tied);
  return errors;
}

double difference(const Layer& truth, const Layer& made) {
  double most = 255 * std::fabs(truth.alpha - made.alpha);
  for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::fabs(truth.colour[k] - made.colour[k]));
  return most;
}

void Mean_errors::add(const Layer& truth, const Layer& made) {
  const double error = difference(truth, made);
  ++compared;
  off += !(error <= 0.5);
  largest = std::max(largest, error);
  sum += error;
}

std::vector<double> seen_areas(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                               const Pixel_view& pixels) {
  const Image_places places(pixels);
  std::vector<double> areas(view.scene().counters().faces_read);
  for (const auto& part : surface.parts) {
    if (part.piece == surface.nothing) continue;
    std::vector<std::array<double, 2>> corners;
    for (const Exact_view::Ray& ray : surface.of(part)) corners.push_back(places(view.direction(ray)));
    double twice = 0;
    for (std::size_t k = 2; k < corners.size(); ++k) {
      const auto &o = corners[0], &p = corners[k - 1], &q = corners[k];
      twice += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    }
    // The image is 2 x 2; what doubles flatten is seen all the same.
    areas[view.scene().pieces()[part.piece].face] +=
        std::max(std::numeric_limits<double>::min(), std::fabs(twice) / 8 * pixels.width * pixels.height);
  }
  return areas;
}

}  // namespace sightline
