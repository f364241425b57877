#pragma once
// A solid's surface into a file, and what its format breaks.

#include "common.h"
#include "options.h"

#include <sightline/algorithms/solids/rounding.h>

#include <optional>
#include <string>

namespace sightline::app {

/// The name of a file that a surface can be written to.
Check surface_ending();

/// Writes a surface, exactly if the format can hold it; else, or if floats are asked for, rounded, or snapped in so
/// many rounds at most, which is returned. Pre: no holes. Errors: as write_scene. `progress` is told of rounding; what
/// it throws comes before anything is written.
std::optional<Rounded_surface> write_solid(const Polygon_soup& soup, const std::string& out, bool to_float,
                                           std::size_t snap_rounds, const Rounding_progress& progress = {});

/// Of a .qoff of a surface whose common denominator is too long for commands: that, and how they read it; the one that
/// reads it as it is, if there is one, by its name. Else empty.
std::string warning_of_denominator(const Polygon_soup& soup, const std::string& file, const std::string& reads_it = "");

/// `soup`: before it was rounded.
Json rounding_json(const Rounded_surface& near, const Polygon_soup& soup);
std::string rounding_text(const Rounded_surface& near);

}  // namespace sightline::app
