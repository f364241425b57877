#include "shard.h"

#include "command.h"

#include <fmt/format.h>

#include <cstdlib>
#include <iostream>
#include <optional>

namespace sightline::app {

/// A decimal number of so many digits at most, 9 or fewer; nothing where it is none.
static std::optional<std::uint32_t> number_in(const std::string& digits, std::size_t most) {
  if (digits.empty() || digits.size() > most || digits.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return static_cast<std::uint32_t>(std::stoul(digits));
}

Shard shard_of(const std::string& text) {
  if (text.empty()) {
    const char *const id = std::getenv("SLURM_ARRAY_TASK_ID"), *const count = std::getenv("SLURM_ARRAY_TASK_COUNT"),
                      *const least = std::getenv("SLURM_ARRAY_TASK_MIN");
    if (id == nullptr || count == nullptr) return {0, 1};
    const auto number = [](const char* digits) {
      const std::optional<std::uint32_t> found = number_in(digits, 9);
      if (!found)
        throw Usage_error(
            "SLURM_ARRAY_TASK_ID, SLURM_ARRAY_TASK_COUNT or SLURM_ARRAY_TASK_MIN is no number; give --shard I/N");
      return *found;
    };
    constexpr std::uint32_t most = 1'000'000;
    if (number(count) > most)
      throw Usage_error(
          fmt::format("SLURM_ARRAY_TASK_COUNT {}: {} shards are the most; give --shard I/N", count, most));
    const std::uint32_t shard = number(id), shards = number(count);
    // Of another array, or of a part of one that is run again, it is not known how many shards there are.
    if ((least != nullptr && number(least) != 0) || shard >= shards)
      throw Usage_error(
          fmt::format("SLURM_ARRAY_TASK_ID {} and SLURM_ARRAY_TASK_COUNT {} name no shard, as they do of --array=0-7; "
                      "give --shard I/N",
                      id, count));
    std::cerr << fmt::format("sightline: shard {}/{}, as the array of jobs says\n", shard, shards);
    return {shard, shards};
  }
  const std::size_t slash = text.find('/');
  std::optional<std::uint32_t> shard, shards;
  if (slash != std::string::npos) {
    shard = number_in(text.substr(0, slash), 6);
    shards = number_in(text.substr(slash + 1), 6);
  }
  if (!shard || !shards || *shards == 0 || *shard >= *shards)
    throw Usage_error("--shard " + text + ": write I/N with I from 0 to N - 1, as in 3/8");
  return {*shard, *shards};
}

}  // namespace sightline::app
