#pragma once
// Threads of the checkers: their own, so that they share nothing with what makes certificates.

#include <sightline/algorithms/verify/verdict.h>

#include <cstddef>
#include <functional>

namespace sightline::certificate_check {

/// Who does the work of a check before it counts what is done with: so many threads (0: one for each processor), and
/// whom they ask before each step whether to go on, never two at once. What that throws ends the work.
struct Workers {
  int threads = 0;
  std::function<void()> go_on = {};

  Workers(int so_many) : threads(so_many) {}
  /// They tell `options.progress` that nothing of `total` is done with. Pre: the options outlive them.
  Workers(const Verify_options& options, std::size_t total);
  void ask() const {
    if (go_on) go_on();
  }
};

/// Calls body(i) for each i below `count`, on the threads of the workers, but on no more than one for each `enough` of
/// them. Errors: of what asking and bodies throw, what is thrown for the least i; all before it are called.
void for_each_below(std::size_t count, std::size_t enough, const Workers& workers,
                    const std::function<void(std::size_t)>& body);

}  // namespace sightline::certificate_check
