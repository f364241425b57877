#pragma once
// The subject `shadow`: what a light reaches, and what keeps it from the rest.

#include <sightline/algorithms/shadow/shadow.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <optional>
#include <string>

namespace sightline::harness {

/// The light is the scene's eye; checks ask for suns too.
Subject shadow();

/// What is wrong with shadows, by the definition: parts are convex and tile their pieces, all that is between the
/// middle of a part and the light is met by rays (hits_by_definition), the nearest to the light being what shadows it.
/// Empty: nothing. Pre: faces are planar.
std::string flaw_of(const Shadows& shadows, const Polygon_soup& soup, const Scene& scene, const Exact_point& light,
                    bool is_sun);

/// Twice the area of a polygon, seen along the axis that the plane of the first three corners is least steep to.
Rational area_of(const std::vector<Exact_point>& polygon, std::size_t axis);

}  // namespace sightline::harness
