#include "query.h"

#include <sightline/harness/judge/protocol.h>
#include <sightline/kernel/quoted.h>

#include <fstream>

namespace sightline::app {

harness::Posed_query read_query(const std::string& path, std::size_t faces) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path + ": cannot be read; check the name");
  try {
    return harness::query_from_json(parse_json(in), faces);
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + printable(error.what(), 400, true));
  }
}

}  // namespace sightline::app
