#include "query.h"

#include <sightline/harness/judge/protocol.h>
#include <sightline/kernel/quoted.h>

namespace sightline::app {

harness::Posed_query read_query(const std::string& path, std::size_t faces) {
  const nlohmann::json value = parse_json(read_input(path), path);
  try {
    return harness::query_from_json(value, faces);
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + printable(error.what(), 400, true));
  }
}

}  // namespace sightline::app
