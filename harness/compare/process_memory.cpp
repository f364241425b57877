#include <sightline/harness/compare/process_memory.h>

#include <fstream>

namespace sightline {

std::uint64_t process_memory(const std::string& process, const std::string& key, const char* file) {
  std::ifstream in("/proc/" + process + "/" + file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key + ":")) return std::stoull(line.substr(key.size() + 1)) * 1024;
  return 0;
}

Peak_memory::Peak_memory() {
  std::ofstream("/proc/self/clear_refs") << 5;
  before_ = process_memory("self", "VmRSS");
}
std::uint64_t Peak_memory::bytes() const {
  const std::uint64_t peak = process_memory("self", "VmHWM");
  return peak > before_ ? peak - before_ : 0;
}

}  // namespace sightline
