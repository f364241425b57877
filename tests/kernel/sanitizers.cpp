// What the sanitizers of `check` are there for: they see it.

#include <sightline/kernel/number.h>

#include "../sample.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include <dlfcn.h>

namespace sightline {
namespace {

/// What a process that was asked for leaks ends with.
constexpr int numbers_leaked = 7, numbers_kept = 8;

/// Makes numbers and asks for leaks, after they were let go of where `leaks`. The stack may still hold one or the
/// other, but not all.
[[noreturn]] void look_for_leaks(bool leaks) {
  static std::array<Rational*, 100> numbers;
  for (Rational*& number : numbers) number = new Rational(1, 3);
  if (leaks) numbers.fill(nullptr);
  const auto finds_leaks =
      reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "__lsan_do_recoverable_leak_check"));  // its library is preloaded
  std::_Exit(finds_leaks != nullptr && finds_leaks() != 0 ? numbers_leaked : numbers_kept);
}

TEST(Sanitizers, find_what_leaks) {
  if (!test_scenes::is_sanitized()) GTEST_SKIP() << "no sanitizer looks for leaks";
  EXPECT_EXIT(look_for_leaks(false), testing::ExitedWithCode(numbers_kept), "");
  EXPECT_EXIT(look_for_leaks(true), testing::ExitedWithCode(numbers_leaked), "LeakSanitizer");
}

}  // namespace
}  // namespace sightline
