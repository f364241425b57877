#pragma once
// What an eye sees of faces that let light through: what is first, and what is seen through that, layer by layer.

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>

#include <functional>
#include <vector>

namespace sightline {

struct Visible_layer {
  Visible_surface<Exact_view> surface;
  std::vector<double> light;  ///< of each part: which share of its light comes through all that is before it
};

/// The surface that is visible in the cones; then what is visible in each of its parts without the piece that is seen
/// there, where that lets light through; and so on, until nothing more is seen: visit(layer) for each, nearest first.
/// Pre: as visible_surface(); an alpha for each piece of the scene, from 0 to 1. Degenerate: pieces of one plane that
/// overlap are layers in the order in which they would be seen. Cost: that of visible_surface() for each layer, and
/// its parts: in the worst case as many as the faces' outlines have regions, all together, in the image. Parallel.
/// Exact: the parts; light is a product of doubles. Proof: P-85
void visible_layers(const Exact_view& view, const Piece_boxes& boxes, Cones<Exact_view> cones,
                    const std::vector<double>& alpha, const std::function<void(const Visible_layer&)>& visit,
                    const Visible_options& options = {});

}  // namespace sightline
