#pragma once
// Pictures of what is weakly visible, and its groups of polygons.

#include "weak.h"

#include <sightline/io/grouped_polygons.h>

#include <string>
#include <vector>

namespace sightline::app {

/// visible, hidden, undecided or "source", by face; sources are numbered after the faces.
std::vector<std::string> names_of(const Scene& scene, const Weak_faces& found, std::size_t sources);

/// The fronts of faces, as a painter paints them: what has its back to the eye is left out, so that one looks into
/// rooms.
void draw(const Weak_arguments& arguments, Polygon_soup soup, const Occluders& occluders, const Sources& sources,
          const std::vector<std::string>& names);

/// The scene's pieces in groups "visible", "hidden", "undecided", and the sources.
Grouped_polygons drawing_of(const Scene& scene, const Sources& sources, const std::vector<std::string>& names);

}  // namespace sightline::app
