#pragma once
// What is the same on every page of a report: its style, and the script that draws its plots.

namespace sightline::report {

extern const char* const page_style;   ///< CSS; dark and light
extern const char* const page_frame;   ///< HTML: the body, in which the script finds its places by id
extern const char* const page_script;  ///< JavaScript; reads the JSON in the element `data`

}  // namespace sightline::report
