#pragma once
// Processes that mpirun started together, which share the work of one command.

#include "../mpi/messages.h"
#include "options.h"

#include <sightline/io/binary.h>
#include <sightline/kernel/counters.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sightline::app {

/// The first process hands out work, gathers, and is the command for everybody else: it alone writes and prints. The
/// others help. Where mpirun started one, or there was none, the first is alone, and nothing of MPI is loaded.
class Ranks {
 public:
  /// Does a command's action. An error in one process ends all: the first throws it, naming the process. Errors: what
  /// the action throws; Usage_error where there are several and the module sightline_mpi is missing.
  static Exit together(const std::function<Exit(Ranks&)>& action);
  Ranks(const Ranks&) = delete;

  bool is_alone() const { return messages_ == nullptr; }
  bool is_first() const { return is_alone() || messages_->rank() == 0; }

  using Work = std::function<std::string(std::uint32_t unit)>;
  using Tell = std::function<void(std::size_t done, std::size_t all)>;
  using Take = std::function<void(std::uint32_t unit, const std::string& answer)>;
  /// Calls take(unit, work(unit)) once for each unit: `work` where somebody is free, in any order; `take` in the first,
  /// whose list of units counts. Alone, in the order of the list. Where others work, the first calls `tell` with how
  /// many units are done, of how many, while it waits. `question`: what all must have been asked alike.
  /// Errors: std::runtime_error in the first where a process was asked something else; what an action throws. Pre: all
  /// come here as often.
  void share(const std::string& question, const std::vector<std::uint32_t>& units, const Work& work, const Take& take,
             const Tell& tell);

 private:
  explicit Ranks(Messages* messages) : messages_(messages) {}
  void hand_out(const std::string& question, const std::vector<std::uint32_t>& units, const Take& take,
                const Tell& tell);
  void help(const std::string& question, const Work& work);
  Exit lead(const std::function<Exit(Ranks&)>& action);
  Exit follow(const std::function<Exit(Ranks&)>& action);

  Messages* messages_;  // null where alone
};

/// Counters as bytes of an answer, all that are listed; and back, from what is in front, which is taken away.
template <Counters Type>
void store_counters(std::string& bytes, const Type& counters) {
  Type::each([&](const char*, auto member, auto...) {
    const auto& value = counters.*member;
    if constexpr (Counters<std::remove_cvref_t<decltype(value)>>) store_counters(bytes, value);
    else store(bytes, std::uint64_t{value});
  });
}
template <Counters Type>
void load_counters(std::string_view& bytes, Type& counters) {
  Type::each([&](const char*, auto member, auto...) {
    auto& value = counters.*member;
    if constexpr (Counters<std::remove_cvref_t<decltype(value)>>) {
      load_counters(bytes, value);
    } else {
      value = static_cast<std::remove_cvref_t<decltype(value)>>(load<std::uint64_t>(bytes, 0, std::endian::little));
      bytes.remove_prefix(sizeof(std::uint64_t));
    }
  });
}

}  // namespace sightline::app
