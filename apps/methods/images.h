#pragma once
// The methods of sightline render, by their names, so that each is asked in one way.

#include "methods.h"

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/algorithms/point_visibility/exact_view.h>

#include <optional>
#include <string>
#include <vector>

namespace sightline::app {

inline const std::vector<std::string> image_methods{"exact",       "centres",      "depth",  "painter-min",
                                                    "painter-max", "painter-mean", "newell", "scan-line",
                                                    "warnock",     "bsp",          "graph"};
inline const std::vector<std::string> image_kernels{"exact", "double", "float"};

/// Whether the method may be asked in any of the kernels.
bool has_image_kernels(const std::string& method);
/// Whether it claims to show the truth, where its numbers are exact.
bool is_true_method(const std::string& method);

struct Image_task {
  std::string method, kernel;
  int bits;  ///< of a depth buffer
  std::uint64_t seed;
};

struct Image_outcome {
  std::optional<Piece_image> pieces;
  std::optional<Depth_image> depth;  ///< all but its image
  double seconds = 0;
};

/// Any method but `exact`. The scene takes no plane.
Image_outcome run_image(Scene& scene, const Pixel_view& pixels, const Image_task& task, const Image_options& options);
/// The method `exact`. Pre: the view has the field of the pixels.
Mean_image run_means(const Exact_view& view, const Pixel_view& pixels,
                     const std::function<Colour(std::uint32_t piece)>& colour, const Image_options& options);

}  // namespace sightline::app
