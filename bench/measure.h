#pragma once
// Measuring in a process of its own: seconds by the caller, peak memory by the system.

#include <sightline/harness/compare/process_memory.h>

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <functional>

namespace bench {

inline double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What a function returns, run in a child process, so that its memory is its own. False where it does not end by
/// itself, or not in `limit` seconds of wall time (0: any).
template <class Result>
bool in_child(Result& result, const std::function<Result()>& work, unsigned limit = 0) {
  static_assert(std::is_trivially_copyable_v<Result>);
  int ends[2];
  if (pipe(ends) != 0) return false;
  const pid_t child = fork();
  if (child == 0) {
    alarm(limit);  // whose signal ends it
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
