#pragma once
// Rays that Embree traces, in floats: what others take for the truth.

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/algorithms/rays/ray.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/scene.h>

#include <cstdint>
#include <functional>
#include <memory>

namespace sightline::app {

/// Whether the program was built with Embree.
bool has_rays();

/// What a ray in floats meets first.
struct Traced_hit {
  std::uint32_t piece = Piece_image::nothing;
  double t = 0;
  bool back = false;  ///< from behind
};

/// A scene's pieces in triangles, as Embree has it: corners in floats, and a hierarchy of boxes. `watertight`: its
/// robust mode, which is to let no ray pass between triangles that share an edge. Errors: Usage_error where the program
/// was built without Embree.
class Traced_scene {
 public:
  Traced_scene(const Scene& scene, int threads, bool watertight = false);
  Traced_scene(Traced_scene&&) noexcept;
  ~Traced_scene();

  /// What one ray meets first, at t > 0. Nothing where its numbers are 1.8e18 or more, which Embree does not take.
  Traced_hit first(const Double_ray& ray) const;
  /// What rays through pixel centres meet first, from an eye and directions in floats. Degenerate: as first().
  Piece_image image(const Pixel_view& pixels, const Image_options& options) const;
  /// The mean of n x n rays a pixel, through the centres of so many squares of it.
  Mean_image means(const Pixel_view& pixels, unsigned n, const std::function<Colour(std::uint32_t piece)>& colour,
                   const Image_options& options) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace sightline::app
