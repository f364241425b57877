#pragma once
// What `sightline weak` writes besides: surfaces of events, and what stays open.

#include "../methods/weak.h"

#include <string>
#include <vector>

namespace sightline::app {

Json surfaces_json(const Scene& scene, const std::vector<Event_surface>& surfaces);

/// Strips of quadrilaterals between rulings in groups by kind, coordinates rounded.
std::string surfaces_obj(const std::vector<Event_surface>& surfaces);

/// The pairs of undecided faces with the first of their open cells: conditions on segments from a part of a source to a
/// part of a piece.
Json open_json(const Occluders& occluders, const Sources& sources, const Weakly_visible& found);

}  // namespace sightline::app
