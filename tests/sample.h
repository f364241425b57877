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

/// Whether it is a long run, for which `check` has no time: SIGHTLINE_LONG is set.
inline bool is_long() {
  static const bool is_said = std::getenv("SIGHTLINE_LONG") != nullptr;
  return is_said;
}

/// So many of `cases`, one at least: a third of them, and a twentieth under sanitizers, where each costs ten times as
/// much; all of them in a long run.
template <class Count>
Count sample(Count cases) {
  const Count parts = is_sanitized() ? 20 : is_long() ? 1 : 3;
  return cases < parts ? 1 : cases / parts;
}

/// What all cases have so many of, a sample has of: its share, as kinds come unevenly halved, and under sanitizers a
/// quarter of it.
template <class Count>
Count least(Count count) {
  return is_sanitized() ? count / 80 : is_long() ? count : count / 6;
}

}  // namespace test_scenes
