#pragma once
// What an image of pieces shows that is not there.

#include <sightline/algorithms/image/piece_image.h>
#include <sightline/kernel/scene/scene.h>

#include <cstdint>

namespace sightline {

struct Image_errors {
  std::uint64_t pixels = 0;           ///< of the image
  std::uint64_t tied = 0;             ///< left out: a rule had to choose
  std::uint64_t wrong = 0;            ///< show another face than the truth, or none, or one where there is none
  std::uint64_t missing = 0;          ///< faces that the truth shows, off ties, and the image nowhere
  std::uint64_t largest_missing = 0;  ///< the pixels of the one with most
};

/// Against the truth, which says what is tied. Pre: both of one size. Exact: yes.
Image_errors image_errors(const Scene& scene, const Piece_image& truth, const Piece_image& image);

}  // namespace sightline
