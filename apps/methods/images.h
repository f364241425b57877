#pragma once
// The methods of sightline render, by their names, so that each is asked in one way.

#include "methods.h"

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/algorithms/image/blend.h>
#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/algorithms/point_visibility/exact_view.h>

#include <optional>
#include <string>
#include <vector>

namespace sightline::app {

inline const std::vector<std::string> image_methods{"exact",       "centres",     "depth",        "rays",
                                                    "painter-min", "painter-max", "painter-mean", "weighted",
                                                    "newell",      "scan-line",   "warnock",      "weiler-atherton",
                                                    "bsp2d",       "bsp",         "graph"};
inline const std::vector<std::string> image_kernels{"exact", "double", "float"};

/// Whether the method may be asked in any of the kernels.
bool has_image_kernels(const std::string& method);
/// Whether it is part of this build.
bool is_built(const std::string& method);
/// Whether it claims to show the truth, where its numbers are exact.
bool is_true_method(const std::string& method);

/// Whether it shows what is behind faces that let something through.
bool shows_through(const std::string& method);

struct Image_task {
  std::string method, kernel;
  int bits;  ///< of a depth buffer
  std::uint64_t seed;
  const std::vector<Tint>* tints = nullptr;  ///< of pieces; or all hide all
};

struct Image_outcome {
  std::optional<Piece_image> pieces;
  std::optional<Blended_image> blended;  ///< where there are tints
  std::optional<Depth_image> depth;      ///< all but its image
  double seconds = 0;

  const Image_counters* counters() const { return pieces ? &pieces->counters : blended ? &blended->counters : nullptr; }
  const std::vector<std::uint8_t>* ties() const { return pieces ? &pieces->tied : blended ? &blended->tied : nullptr; }
};

/// Any method but `exact`; with tints one that shows through. The scene takes no plane.
Image_outcome run_image(Scene& scene, const Pixel_view& pixels, const Image_task& task, const Image_options& options);
/// The method `exact`, of tints of pieces. Pre: the view has the field of the pixels.
void run_means(const Exact_view& view, const Pixel_view& pixels, const std::vector<Tint>& tints,
               const std::function<void(const Mean_row&)>& visit, const Image_options& options);

}  // namespace sightline::app
