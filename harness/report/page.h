#pragma once
// A report as a page to look at.

#include <sightline/harness/report/report.h>

#include <string>

namespace sightline::report {

/// JSON as it stands in an element of a page, of a report or not: no tag begins or ends in it.
std::string in_element(const Json& json);

/// One self-contained HTML file, with plots that answer to the pointer; without a network. Rows beyond 30,000 are left
/// out evenly and counted on it; tables and examples are of all. `viewer`: what stands at its end and opens scenes that
/// a button with `data-view` asks for, of the element `views`, as scenes_within() of the program does; without it there
/// are no such buttons, nor where the views of smaller ones take 300 kB.
std::string report_page(const Report& report, const std::string& viewer = "");

}  // namespace sightline::report
