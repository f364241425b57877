#pragma once
// The result of `sightline judge` as a page to look at.

#include "../support/common.h"

namespace sightline::app {

/// One HTML page that needs no other file: verdict, limits, a bar and a row for each family and distance, and what
/// broke the contract, its scenes to turn around. Pre: `document` is what --json writes.
std::string judge_page(const Json& document);

}  // namespace sightline::app
