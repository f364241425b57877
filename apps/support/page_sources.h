#pragma once
// The text, style and script of pages, and what opens one within another: the files of apps/page, as the build puts
// them into the program.

#include <string_view>

namespace sightline::app {

extern const std::string_view page_text, page_style, page_script, turn_style, turn_script;

}  // namespace sightline::app
