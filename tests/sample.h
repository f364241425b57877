#pragma once
// How many cases a test takes.

#include <cstdlib>

namespace test_scenes {

/// Whether it runs under sanitizers: compiled with them, or with a library that is; `check` says so.
inline bool is_sanitized() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return true;
#else
  static const bool is_said = std::getenv("SIGHTLINE_SANITIZED") != nullptr;
  return is_said;
#endif
}

/// The library's sanitizers come with LD_PRELOAD; other programs that a test starts do without.
inline const bool is_for_this_process_alone = [] {
  if (is_sanitized()) unsetenv("LD_PRELOAD");
  return true;
}();

/// So many of `cases`: all of them, and a tenth under sanitizers, where each costs ten times as much.
template <class Count>
Count sample(Count cases) {
  return is_sanitized() ? cases / 10 : cases;
}

/// What all cases have so many of, a sample has of: a quarter of its share at least, as kinds come unevenly.
template <class Count>
Count least(Count count) {
  return is_sanitized() ? count / 40 : count;
}

}  // namespace test_scenes
