#pragma once
// What Weiler and Atherton's method stands on: polygons with holes clipped to a concave window with holes, into what is
// inside and what is outside.

#include <sightline/kernel/number.h>

#include <array>
#include <span>
#include <vector>

namespace sightline {

/// A point of an image's plane: across and upwards.
using Image_point = std::array<Rational, 2>;
using Image_loop = std::vector<Image_point>;

/// A polygon with holes. As results have it, the outer loop runs counterclockwise and holes clockwise, no corner is
/// straight, and no loop passes a point twice; loops may touch in points. Its inside need not be in one piece where
/// holes touch the outer loop and each other.
struct Image_polygon {
  Image_loop outer;
  std::vector<Image_loop> holes;
};

/// Pre: as results have it. Exact: yes.
Rational area(const Image_polygon& polygon);

struct Clipped_polygons {
  std::vector<Image_polygon> inside, outside;
};

/// The parts of some polygons in a window, and those that are not: both are regular, so what has no area, as where
/// borders touch, is in neither. Laws: areas of both add up to that of the polygons; exchanging polygons and window
/// leaves `inside` as it is. The window may be any number of polygons, concave, with holes, in which there may be
/// further polygons. Pre: loops in any sense, neither crossing themselves nor each other, but they may touch and share
/// edges; a hole is in its outer loop; polygons of one list overlap nowhere. Degenerate: loops of no area, repeated and
/// straight corners and spikes are nothing; no polygons, or no window, are no error. Errors: std::invalid_argument
/// where loops overlap otherwise. Cost: of n edges, those whose x overlap are compared, each pair in rationals, and as
/// many parts of them as come of it are asked what is below them: n² at worst. Coordinates of crossings are as wide as
/// four lines of the input; clipped again, they grow. Exact: yes. Ref: Weiler and Atherton, Hidden surface removal
/// using polygon area sorting, SIGGRAPH 1977; what decides at a crossing there are lists of entries and exits, which
/// borders that touch or coincide have none of, so here it is on which sides of each part of an edge something is, as
/// in Weiler, Polygon comparison using a graph representation, SIGGRAPH 1980. Proof: P-83b
Clipped_polygons clip_to_window(std::span<const Image_polygon> polygons, std::span<const Image_polygon> window);

}  // namespace sightline
