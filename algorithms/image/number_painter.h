#pragma once
// Images of visible surfaces in floats and doubles. Apart from painter.h, as CGAL's numbers come along.

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/scene/pixel_view.h>

namespace sightline {

/// What a visible surface in floats or doubles shows at pixel centres, as paint() has it of an exact one: cones through
/// rounded rays, in the numbers that they are in. Where two parts of it do not fit, a centre may be in both, or in
/// none.
Piece_image paint(const Number_view<float>& view, const Visible_surface<Number_view<float>>& surface,
                  const Pixel_view& pixels, const Image_options& options = {});
Piece_image paint(const Number_view<double>& view, const Visible_surface<Number_view<double>>& surface,
                  const Pixel_view& pixels, const Image_options& options = {});

}  // namespace sightline
