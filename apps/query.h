#pragma once
// What is asked of a scene, as a file: an eye, a source polygon, and what is known of the answer.

#include "common.h"

#include <sightline/algorithms/generate/families.h>

namespace sightline::app {

/// {"format": "sightline query 1", "name", "seed", "distance": "exact", "beside" or "far", "eye": [x, y, z], "source": [[x, y, z], ...], "visible": [faces], "hidden": [faces]}; numbers are exact
/// strings, p or p/q. No source: an empty list. `visible` and `hidden` are what is known by construction of what the source sees; of other faces nothing is known. `seed` is of a checker's choices.
Json query_json(const generate::Posed_scene& scene, std::uint64_t seed);

struct Query {
  generate::Posed_scene scene;  ///< without its soup
  std::uint64_t seed = 1;
};
/// Reads such a file. Errors: std::runtime_error naming the file and what is wrong with it.
Query read_query(const std::string& path);

/// 2^K, or an exact number > 0. Errors: Usage_error naming the option.
Rational parse_scale(const std::string& text, const std::string& option);

}  // namespace sightline::app
