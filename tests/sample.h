#pragma once
// How many cases a test takes.

namespace test_scenes {

/// So many of `cases`: all of them, and a tenth under sanitizers, where each costs ten times as much. For what is
/// counted among them too.
template <class Count>
constexpr Count sample(Count cases) {
#if defined(__SANITIZE_ADDRESS__)
  return cases / 10;
#else
  return cases;
#endif
}

}  // namespace test_scenes
