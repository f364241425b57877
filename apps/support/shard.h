#pragma once
// A share of the work, for one of several machines or processes: --shard I/N.

#include <cstddef>
#include <cstdint>
#include <string>

namespace sightline::app {

/// Of units of work that are numbered from 0 those whose number is `shard` modulo `shards`.
struct Shard {
  std::uint32_t shard = 0, shards = 1;
};

/// I/N as --shard has it, or what an array of jobs says (SLURM_ARRAY_TASK_ID and SLURM_ARRAY_TASK_COUNT) where that is
/// not given, and is told on standard error. Errors: Usage_error, also for an array that does not begin at 0 or has
/// gaps, since it does not say how many shards there are.
Shard shard_of(const std::string& text);

}  // namespace sightline::app
