#pragma once
// How much a closed surface holds, and how large it is.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>

namespace sightline {

/// The volume inside a closed soup, each part as often as it is wound round; negative where fronts look inwards.
/// Faces that are not planar count as fans from their first corners. Cost: O(n), and sums as long as the denominators
/// of different points together. Exact: yes
Rational volume(const Polygon_soup& soup);

/// Twice the area vector of a face, in front of which its loops run counterclockwise; holes are taken off. Exact: yes
Exact_point doubled_area_vector(const Polygon_soup& soup, Face_id face);

/// The sum of all faces' areas, as an interval of doubles that holds it, with infinity where doubles end. Pre: faces
/// are planar.
std::array<double, 2> area(const Polygon_soup& soup);

}  // namespace sightline
