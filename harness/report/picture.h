#pragma once
// A report as a picture.

#include <sightline/harness/report/report.h>

#include <string>

namespace sightline::report {

/// SVG: for each of the first two questions that have rows a plot of seconds against error, a mark for each method,
/// kernel and size, with a legend. Degenerate: without rows an empty frame.
std::string report_picture(const Report& report);

}  // namespace sightline::report
