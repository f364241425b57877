#pragma once
// How many threads work on something.

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <optional>

namespace sightline {

/// Runs a function whose oneTBB tasks get that many threads, also where there are fewer processors. 0: as many as there
/// are processors.
template <class Function>
void run_with_threads(int threads, Function function) {
  std::optional<oneapi::tbb::global_control> more;
  if (threads > oneapi::tbb::info::default_concurrency())
    more.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  oneapi::tbb::task_arena arena(threads > 0 ? threads : oneapi::tbb::task_arena::automatic);
  arena.execute(function);
}

}  // namespace sightline
