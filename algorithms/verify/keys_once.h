#pragma once
// JSON in which no object has a key twice: readers take the first of them, or the last, and a checker must not choose.

#include <nlohmann/json.hpp>

namespace sightline {

/// For nlohmann::json::parse(): throws std::invalid_argument, in one line, where an object has a key twice, or where
/// objects and lists are more than 200 deep.
nlohmann::json::parser_callback_t refuse_keys_twice();

}  // namespace sightline
