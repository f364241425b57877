#pragma once
// What an image of pieces shows that is not there.

#include <sightline/algorithms/image/blend.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/scene.h>

#include <cstdint>
#include <vector>

namespace sightline {

struct Image_errors {
  std::uint64_t pixels = 0;           ///< of the image
  std::uint64_t tied = 0;             ///< left out: a rule had to choose
  std::uint64_t wrong = 0;            ///< show another face than the truth, or none, or one where there is none
  std::uint64_t missing = 0;          ///< faces that the truth shows, off ties, and the image nowhere
  std::uint64_t largest_missing = 0;  ///< the pixels of the one with most
  std::vector<Face_id> covered;       ///< faces that some wrong pixel ought to show; sorted
  std::vector<Face_id> shown;         ///< faces that some wrong pixel shows; sorted
};

/// Against the truth, which says what is tied. Pre: both of one size. Exact: yes.
Image_errors image_errors(const Scene& scene, const Piece_image& truth, const Piece_image& image);

/// The same of images in which faces let through what is behind them.
struct Colour_errors {
  std::uint64_t pixels = 0;  ///< of the image
  std::uint64_t tied = 0;    ///< left out: a rule had to choose
  std::uint64_t wrong = 0;   ///< off by more than half a step of 255
  double largest = 0,
         mean = 0;  ///< differences of a pixel: of red, green, blue, or 255 times opacity, whichever is most
};

/// Against the truth, which says what is tied. Pre: both of one size. Exact: but for the rounding of colours.
Colour_errors colour_errors(const Blended_image& truth, const Blended_image& image);

/// How far colours and opacities are from the truth: of red, green, blue, or 255 times opacity, whichever is most.
double difference(const Layer& truth, const Layer& made);

/// The same of images whose pixels are means over their squares, pixel by pixel.
struct Mean_errors {
  std::uint64_t compared = 0;  ///< pixels
  std::uint64_t off = 0;       ///< by more than half a step of 255
  double largest = 0, sum = 0;

  void add(const Layer& truth, const Layer& made);
  double mean() const { return compared == 0 ? 0 : sum / static_cast<double>(compared); }
};

/// The area that each face has in an image, by its id, in pixels: what no sample may meet. Pre: the surface is that of
/// field_of_view(view), with the field of the pixels. Exact: which are 0; areas are doubles, of corners that are
/// rounded to the nearest.
std::vector<double> seen_areas(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                               const Pixel_view& pixels);

}  // namespace sightline
