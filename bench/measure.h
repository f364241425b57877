#pragma once
// Measuring in a process of its own: seconds by the caller, peak memory by the system.

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <functional>
#include <string>

namespace bench {

inline double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A value of /proc/self/status in bytes.
inline std::uint64_t process_memory(const std::string& key) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key + ":")) return std::stoull(line.substr(key.size() + 1)) * 1024;
  return 0;
}

/// What a function returns, run in a child process, so that its memory is its own; the function gets the bytes in use
/// at its start.
template <class Result>
bool in_child(Result& result, const std::function<Result()>& work) {
  static_assert(std::is_trivially_copyable_v<Result>);
  int ends[2];
  if (pipe(ends) != 0) return false;
  const pid_t child = fork();
  if (child == 0) {
    std::ofstream("/proc/self/clear_refs") << 5;  // forget the parent's peak
    const Result made = work();
    const bool sent = write(ends[1], &made, sizeof made) == static_cast<ssize_t>(sizeof made);
    _exit(sent ? 0 : 1);
  }
  close(ends[1]);
  const bool received = read(ends[0], &result, sizeof result) == static_cast<ssize_t>(sizeof result);
  close(ends[0]);
  int how = 0;
  waitpid(child, &how, 0);
  return received;
}

}  // namespace bench
