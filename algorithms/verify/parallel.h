#pragma once
// Threads of the checkers: their own, so that they share nothing with what makes certificates.

#include <cstddef>
#include <functional>

namespace sightline::certificate_check {

/// Calls body(i) for each i below `count`, on that many threads (0: one for each processor), but on no more than one
/// for each `enough` of them. Errors: of what bodies throw, what the one with the least i throws; all before it are
/// called.
void for_each_below(std::size_t count, std::size_t enough, int threads, const std::function<void(std::size_t)>& body);

}  // namespace sightline::certificate_check
