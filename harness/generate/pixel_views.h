#pragma once
// Images of small degenerate scenes: across and along what is seen, through its corners, out of square.

#include <sightline/harness/generate/random.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/polygon_soup.h>

namespace sightline::generate {

/// A view of the scene from the eye, of 5 to 16 pixels each way: with dyadic directions along the axes, so that centres
/// meet lattice points; with the middle of the image at a corner and one axis along an edge; or any; one in
/// five with directions that are nearly in a plane, one in eight with directions of lengths 2^-300 to 2^300 of that.
/// They span the space, either way round. Pre: the scene has a point.
Pixel_view any_pixel_view(const Polygon_soup& soup, const Exact_point& eye, Random& random);

/// One of the directions moved close to the plane of the others: beside it by 2^-52 to 2^-5 of an entry.
void flatten(Pixel_view& view, Random& random);

/// Each direction times a power of two of its own, from 2^-300 to 2^300 or nearer to 1.
void stretch(Pixel_view& view, Random& random);

}  // namespace sightline::generate
