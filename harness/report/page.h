#pragma once
// A report as a page to look at.

#include <sightline/harness/report/report.h>

#include <string>

namespace sightline::report {

/// One self-contained HTML file, with plots that answer to the pointer; without a network. Rows beyond 30,000 are left
/// out evenly and counted on it; tables and examples are of all.
std::string report_page(const Report& report);

}  // namespace sightline::report
