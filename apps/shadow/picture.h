#pragma once
// The picture of `sightline shadow`.

#include "shadow.h"

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/shadow/shadow.h>

#include <cstddef>
#include <vector>

namespace sightline::app {

/// Writes what an eye sees, each part cut by the shadows on it; but what is smaller than a pixel is drawn whole, in the
/// light of the largest part of it. Returns how many are.
std::size_t draw(const Shadow_arguments& arguments, const Scene& scene, const Piece_boxes& boxes,
                 const std::vector<Shadows>& all, const Exact_point& eye);

}  // namespace sightline::app
