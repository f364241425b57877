#include "shard.h"

#include "command.h"

#include <fmt/format.h>

#include <cstdlib>
#include <iostream>
#include <optional>

namespace sightline::app {

Shard shard_of(const std::string& text) {
  if (text.empty()) {
    const char *const id = std::getenv("SLURM_ARRAY_TASK_ID"), *const count = std::getenv("SLURM_ARRAY_TASK_COUNT"),
                      *const least = std::getenv("SLURM_ARRAY_TASK_MIN");
    if (id == nullptr || count == nullptr) return {0, 1};
    const auto number = [](const char* digits) -> std::uint32_t {
      const std::string word = digits;
      if (word.empty() || word.size() > 9 || word.find_first_not_of("0123456789") != std::string::npos)
        throw Usage_error("SLURM_ARRAY_TASK_ID, SLURM_ARRAY_TASK_COUNT or SLURM_ARRAY_TASK_MIN is no number; give " +
                          std::string("--shard I/N"));
      return static_cast<std::uint32_t>(std::stoul(word));
    };
    const std::uint32_t shard = number(id) - (least == nullptr ? 0 : number(least)), shards = number(count);
    if (shards == 0 || shard >= shards)
      throw Usage_error("SLURM_ARRAY_TASK_ID and SLURM_ARRAY_TASK_COUNT name no shard; give --shard I/N");
    std::cerr << fmt::format("sightline: shard {}/{}, as the array of jobs says\n", shard, shards);
    return {shard, shards};
  }
  const std::size_t slash = text.find('/');
  const std::optional<std::uint64_t> none;
  const auto number = [&](const std::string& digits) -> std::optional<std::uint64_t> {
    if (digits.empty() || digits.size() > 6 || digits.find_first_not_of("0123456789") != std::string::npos) return none;
    return std::stoul(digits);
  };
  const auto shard = slash == std::string::npos ? none : number(text.substr(0, slash)),
             shards = slash == std::string::npos ? none : number(text.substr(slash + 1));
  if (!shard || !shards || *shards == 0 || *shard >= *shards)
    throw Usage_error("--shard " + text + ": write I/N with I from 0 to N - 1, as in 3/8");
  return {static_cast<std::uint32_t>(*shard), static_cast<std::uint32_t>(*shards)};
}

}  // namespace sightline::app
