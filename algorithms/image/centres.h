#pragma once
// What an exact ray through each pixel's centre meets first: the truth for methods that ask at centres.

#include <sightline/algorithms/image/piece_image.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/kernel/scene/pixel_view.h>

#include <cstddef>
#include <functional>

namespace sightline {

struct Image_options {
  int threads = 0;  ///< 0: as many as there are processors, or one for little; the result is the same for any number
  std::function<void(std::size_t done, std::size_t all)> progress = {};  ///< called from any thread
};

/// The piece that the ray through each pixel's centre meets first, from its front or from behind. Pieces are closed;
/// where several are met first at one point, it is the one seen from the front before from behind, then by face id,
/// then by number. A pixel is tied where that rule chose, or the ray meets the border of what it shows. Degenerate:
/// pieces in whose plane the eye is are not met. Pre: view.eye() is pixels.eye. Errors: std::invalid_argument for no
/// pixels, more than 2^20 each way, or directions that do not span the space. Cost: pieces, rows of them, and centres
/// that they cover; 1 / t is linear in an image, so a depth is a product and a sum. Parallel. Exact: yes. Proof: P-80
Piece_image centres(const Exact_view& view, const Pixel_view& pixels, const Image_options& options = {});

}  // namespace sightline
