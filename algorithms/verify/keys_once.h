#pragma once
// JSON in which no object has a key twice: readers take the first of them, or the last, and a checker must not choose.

#include <nlohmann/json.hpp>

#include <string_view>

namespace sightline {

/// What a text says. Errors: std::invalid_argument, in one line, where an object has a key twice, or where objects and
/// lists are more than 200 deep; else those of nlohmann::json::parse(). Cost: O(n log n): parse() with a callback looks
/// at all of a list each time that an object in it ends.
nlohmann::json json_with_keys_once(std::string_view text);

}  // namespace sightline
