#pragma once
// Memory of a process, as Linux tells it; elsewhere all is 0.

#include <cstdint>
#include <string>

namespace sightline {

/// A value of /proc/PROCESS/status in bytes, such as "VmRSS" (in use now) or "VmHWM" (the most so far), or of another
/// file there; 0 where there is none. `process`: a number, or "self".
std::uint64_t process_memory(const std::string& process, const std::string& key, const char* file = "status");

/// The most memory that this process has in use from now on, above what it has now.
class Peak_memory {
 public:
  Peak_memory();  ///< forgets the peak so far, a parent's too
  std::uint64_t bytes() const;

 private:
  std::uint64_t before_;
};

}  // namespace sightline
