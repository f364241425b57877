#pragma once
// What is asked of a scene of a family, and what is known of the answer, as JSON: `sightline generate --query` writes
// it, `fuzz` and `reduce` read it.

#include <sightline/harness/generate/families.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>

namespace sightline::harness {

/// {"format": "sightline query 1", "name", "seed", "distance": "exact", "beside" or "far", "eye": [x, y, z], "source":
/// [[x, y, z], ...], "visible": [faces], "hidden": [faces]}, and of a pair of solids "first": how many faces
/// are the first one's; numbers are exact strings, p or p/q; JSON numbers are read
/// too, as the doubles that they are. No source: an empty list. `visible` and `hidden` are what is known by
/// construction of what the source sees; of other faces nothing is known. `seed` is of a checker's choices.
nlohmann::ordered_json query_json(const generate::Posed_scene& scene, std::uint64_t seed);

struct Posed_query {
  generate::Posed_scene scene;  ///< without its soup
  std::uint64_t seed = 1;
};

/// The query that a JSON value holds, about a scene of so many faces. All but "format" and "eye" may be left out. The
/// source is taken as it is: its convexity is for weak_source() to ask. Errors: std::invalid_argument that says in one
/// line what is wrong. Exact: yes.
Posed_query query_from_json(const nlohmann::json& value, std::size_t faces);

}  // namespace sightline::harness
