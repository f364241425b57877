#pragma once
// Which program this is, and what it stands on.

#include <string>

namespace sightline::app {

std::string program_version();

/// "(CGAL 5.5.1, GMP 6.2.1, ...)": of headers as they were compiled, of libraries as they are found when it runs.
std::string library_versions();

}  // namespace sightline::app
