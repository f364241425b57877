#pragma once
// The scan-line algorithm: row by row, from edge to edge, what is nearest between them.

#include <sightline/algorithms/image/blend.h>
#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/scene.h>

#include <vector>

namespace sightline {

/// The piece that each pixel's centre shows: of those that the ray through it meets first, the one that centres()
/// chooses; nobody asks whether it is tied. Faces wait in a table by their first row. In each row the active ones are
/// kept with their two edges there, sorted from the order of the row before; between one edge and the next, one face is
/// first, or the span is split where two faces cross. Faces are cones of directions, so none is clipped, also where
/// one reaches behind the eye. Degenerate: pieces in whose plane the eye is are not seen; nor are those that the
/// kernel's numbers cannot hold, or flatten. Errors: as centres(). Cost: pieces; rows of them; and spans, each times
/// the faces that are there. Parallel. Exact: as the kernel is; exact, it equals centres(). Ref: Wylie, Romney, Evans,
/// Erdahl, Half-tone perspective drawings by computer, AFIPS 1967; Watkins, A real time visible surface algorithm,
/// 1970.
Piece_image scan_line(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel,
                      const Image_options& options = {});

/// All layers at each pixel's centre, down to one that hides all: between one edge and the next they are in one order,
/// or the span is split where two faces cross. Pre, degenerate, errors: as blended_centres(), in a kernel's numbers.
/// Parallel. Exact: as the kernel is; exact, it equals blended_centres(), ties too.
Blended_image blended_scan_line(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel,
                                const std::vector<Tint>& tints, const Image_options& options = {});

}  // namespace sightline
