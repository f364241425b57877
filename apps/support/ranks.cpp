#include "ranks.h"

#include <sightline/kernel/time_limit.h>

#include <fmt/format.h>

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace sightline::app {

namespace {

// Messages begin with what they are. To the first: a process is ready, and what it was asked; an answer; an error. From
// the first: a unit of work; there is no more, which ends one share of work and, once more, all.
enum Kind : char {
  ready = 'r',
  answer = 'a',
  usage_error = 'u',
  budget_error = 'b',
  other_error = 'e',
  unit = 'w',
  no_more = 'n'
};

std::string message_of(Kind kind, std::string_view rest = {}) { return std::string(1, kind) + std::string(rest); }

/// Whether there are processes besides this one, as mpirun and its like say in the environment. PMIx itself tells no
/// number: where Slurm does not either, MPI will.
bool may_be_several() {
  for (const auto& [is_there, size] : {std::pair("OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_SIZE"),
                                       {"PMI_SIZE", "PMI_SIZE"},
                                       {"PMIX_RANK", "SLURM_STEP_NUM_TASKS"}}) {
    if (std::getenv(is_there) == nullptr) continue;
    const char* const text = std::getenv(size);
    return text == nullptr || std::strtoul(text, nullptr, 10) > 1;
  }
  return false;
}

/// The module, which stands beside the program, or where it is installed.
Messages* loaded_messages() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const std::filesystem::path& place : {folder, folder / SIGHTLINE_MODULES}) {
    const std::filesystem::path module = place / "sightline_mpi.so";
    if (!std::filesystem::exists(module, error)) continue;
    // MPI's own modules look for its names among those of all.
    void* const handle = dlopen(module.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (handle == nullptr) throw std::runtime_error(fmt::format("{}; install MPI's library again", dlerror()));
    return reinterpret_cast<decltype(&sightline_messages)>(dlsym(handle, "sightline_messages"))();
  }
  throw Usage_error(
      "several processes were started together, but this program has no MPI: build it where MPI is found, or start one "
      "process for each --shard I/N and `sightline merge`");
}

/// What went wrong in another process, as what is thrown here.
[[noreturn]] void throw_on(const Message& message) {
  const std::string text = fmt::format("process {}: {}", message.from, std::string_view(message.bytes).substr(1));
  switch (message.bytes[0]) {
    case usage_error: throw Usage_error(text);
    case budget_error: throw Out_of_budget(text);
    default: throw std::runtime_error(text);
  }
}

}  // namespace

Exit Ranks::together(const std::function<Exit(Ranks&)>& action) {
  Ranks ranks(may_be_several() ? loaded_messages() : nullptr);
  if (!ranks.is_alone() && ranks.messages_->size() == 1) {
    ranks.messages_->end();
    ranks.messages_ = nullptr;
  }
  return ranks.is_alone() ? action(ranks) : ranks.is_first() ? ranks.lead(action) : ranks.follow(action);
}

Exit Ranks::lead(const std::function<Exit(Ranks&)>& action) {
  const Exit exit = action(*this);  // an error ends this process without a word to MPI, and so mpirun ends the others
  for (std::uint32_t to = 1; to < messages_->size(); ++to) messages_->send(to, message_of(no_more));
  messages_->end();
  return exit;
}

Exit Ranks::follow(const std::function<Exit(Ranks&)>& action) {
  std::cerr.setstate(std::ios::failbit);  // the first says it all
  const auto tell = [&](Kind kind, const std::exception& error) { messages_->send(0, message_of(kind, error.what())); };
  try {
    action(*this);
  } catch (const Usage_error& error) {
    tell(usage_error, error);
  } catch (const Out_of_budget& error) {
    tell(budget_error, error);
  } catch (const std::exception& error) {
    tell(other_error, error);
  }
  messages_->receive([] {});  // that there is no more; after an error it never comes
  messages_->end();
  return Exit::done;
}

void Ranks::share(const std::string& question, const std::vector<std::uint32_t>& units, const Work& work,
                  const Take& take, const Tell& tell) {
  if (!is_alone()) return is_first() ? hand_out(question, units, take, tell) : help(question, work);
  for (const std::uint32_t one : units) take(one, work(one));
}

void Ranks::hand_out(const std::string& question, const std::vector<std::uint32_t>& units, const Take& take,
                     const Tell& tell) {
  std::vector<std::uint32_t> unit_of(messages_->size());  // by process: what it works at
  std::vector<std::uint32_t> idle;
  std::size_t next = 0, taken = 0;
  // 1. Whoever is free gets the next unit, before its answer to the last one is looked at.
  while (taken < units.size() || idle.size() + 1 < messages_->size()) {
    const Message message = messages_->receive([&] { tell(taken, units.size()); });
    const std::string_view rest = std::string_view(message.bytes).substr(1);
    const Kind kind = static_cast<Kind>(message.bytes[0]);
    if (kind == ready && rest != question)
      throw std::runtime_error(
          fmt::format("process {} was asked another question, \"{}\", than the first, \"{}\"; give all processes one "
                      "scene and the same options",
                      message.from, rest, question));
    if (kind != ready && kind != answer) throw_on(message);
    const std::uint32_t done = unit_of[message.from];
    if (next < units.size()) {
      unit_of[message.from] = units[next++];
      std::string work = message_of(unit);
      store(work, unit_of[message.from]);
      messages_->send(message.from, work);
    } else {
      idle.push_back(message.from);
    }
    if (kind == ready) continue;
    take(done, std::string(rest));
    ++taken;
  }
  // 2. All wait until all is done: what a process says next is about what comes next.
  for (const std::uint32_t to : idle) messages_->send(to, message_of(no_more));
}

void Ranks::help(const std::string& question, const Work& work) {
  messages_->send(0, message_of(ready, question));
  for (;;) {
    const Message message = messages_->receive([] {});
    if (message.bytes[0] == no_more) return;
    messages_->send(0, message_of(answer, work(load<std::uint32_t>(message.bytes, 1, std::endian::little))));
  }
}

}  // namespace sightline::app
