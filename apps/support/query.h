#pragma once
// What is asked of a scene, read from a file.

#include "common.h"

#include <sightline/harness/laws/query_json.h>

namespace sightline::app {

/// Reads a query as `generate --query` writes it, about a scene of so many faces. Errors: std::runtime_error naming the
/// file and what is wrong with it.
harness::Posed_query read_query(const std::string& path, std::size_t faces);

}  // namespace sightline::app
