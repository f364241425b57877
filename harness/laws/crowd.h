#pragma once
// Scenes with many faces, of small ones.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>

namespace sightline::harness {

/// About so many faces: copies of a scene, each moved by that share of its size along the axes.
Polygon_soup crowd(const Polygon_soup& soup, std::size_t faces, const Rational& share);

}  // namespace sightline::harness
