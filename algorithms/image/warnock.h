#pragma once
// Warnock's subdivision: windows of the image, each cut into four until one face is first in all of it.

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/scene.h>

namespace sightline {

/// The piece that each pixel's centre shows: of those that the ray through it meets first, the one that centres()
/// chooses; nobody asks whether it is tied. A window is the convex hull of the centres of its pixels. Each face that
/// comes down to it surrounds it, is contained in it or intersects it, or is disjoint from it: that is dropped, and so
/// is what is behind a surrounder at all four corners. A window is cut into four until nothing is left in it, or one
/// surrounder in front of all else; a single pixel is decided by depth at its centre. Faces are cones of directions, so
/// none is clipped, also where one reaches behind the eye. Degenerate: pieces in whose plane the eye is are not seen;
/// nor are those that the kernel's numbers cannot hold, or flatten. Errors: as centres(). Cost: windows, each times the
/// faces that come down to it; there are about as many as pixels along visible edges. Parallel. Exact: as the kernel
/// is; exact, it equals centres().
/// Ref: Warnock, A hidden surface algorithm for computer generated halftone pictures, 1969.
Piece_image warnock(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel,
                    const Image_options& options = {});

}  // namespace sightline
