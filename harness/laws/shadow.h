#pragma once
// The subject `shadow`: what a light reaches, and what keeps it from the rest.

#include <sightline/algorithms/shadow/shadow.h>
#include <sightline/algorithms/shadow/volume.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <cstddef>
#include <string>

namespace sightline::harness {

/// The light is the scene's eye; checks ask for suns too.
Subject shadow();

/// What is wrong with shadows, by the definition: the pieces that are asked, those turned to the light and `two_sided`
/// those that turn their backs, have parts, which are convex and tile them; all that is between the middle of a part
/// and the light is met by rays (hits_by_definition), the nearest to the light being what shadows it; and faces are lit
/// or away by their parts. Empty: nothing. Pre: faces are planar.
std::string flaw_of(const Shadows& shadows, const Polygon_soup& soup, const Scene& scene, const Exact_point& light,
                    bool is_sun, bool two_sided);

/// What is wrong with a shadow volume: of its box, and at random points of it, which it winds once round where a face
/// is met on the way to the light, and else not at all; the surface's own rays count that. Empty: nothing. Pre: faces
/// are planar.
std::string flaw_of(const Shadow_volume& volume, const Polygon_soup& soup, const Scene& scene, const Exact_point& light,
                    bool is_sun, std::size_t points, generate::Random& random);

/// Twice the area of a polygon, seen along the axis that the plane of the first three corners is least steep to.
Rational area_of(const std::vector<Exact_point>& polygon, std::size_t axis);

}  // namespace sightline::harness
