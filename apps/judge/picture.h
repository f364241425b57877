#pragma once
// The picture of a case that is answered wrongly.

#include "../support/common.h"

#include <sightline/harness/judge/explain.h>

namespace sightline::app {

/// The scene from outside, from where the line that refutes is seen at length: faces that are missing, shown though
/// hidden, or right by their colours, the eye or the source, and the line, dashed beyond what it meets. SVG, 480 x 360.
std::string picture_of(const Polygon_soup& soup, const judge::Query& query, const judge::Grade& grade,
                       const judge::Explanation& why);

}  // namespace sightline::app
