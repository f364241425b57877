#pragma once
// What graphics hardware makes of faces that let through what is behind them, without sorting them.

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/algorithms/image/colour.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/scene.h>

#include <cstdint>
#include <vector>

namespace sightline {

/// Layers at pixels, row by row from the top left.
struct Blended_depth {
  std::vector<Layer> layers;
  float near = 0, far = 0;
  std::uint64_t triangles = 0;
  std::uint64_t not_finite = 0;  ///< pieces left out, because floats do not hold them, the eye or the planes
};

/// Faces drawn in the scene's order, each over what is there where its stored depth is less than the least so far: what
/// is drawn later and lies behind is lost, and what is drawn later and lies before is right only by chance. Pre: a tint
/// for each piece, its alpha from 0 to 1. Errors: as depth_image(), and for tints as
/// blended_centres(). Exact: no; that is its purpose.
Blended_depth depth_blended(const Scene& scene, const Pixel_view& pixels, const std::vector<Tint>& tints,
                            const Depth_buffer_options& options = {});

/// Faces that hide all by a depth buffer; over them the mean of those before it that do not, weighted by opacity and
/// depth, so that no order is needed: their opacity together is right, their colour is a guess. Pre, errors: as
/// depth_blended(). Exact: no; that is its purpose. Ref: McGuire, Bavoil, Weighted blended order-independent
/// transparency, JCGT 2013, equation 10.
Blended_depth weighted_blended(const Scene& scene, const Pixel_view& pixels, const std::vector<Tint>& tints,
                               const Depth_buffer_options& options = {});

}  // namespace sightline
