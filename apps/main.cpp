// The program sightline: its commands, and what its exit codes mean.

#include "support/command.h"
#include "support/files.h"
#include "support/number_memory.h"
#include "support/versions.h"

#include <sightline/io/file.h>
#include <sightline/kernel/time_limit.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <iterator>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

using namespace sightline::app;

// ---- Where memory runs out

/// Says so and ends, from wherever it is: what is half done is not finished with less memory, and must not be answered.
[[noreturn]] static void end_without_memory() {
  static constexpr std::string_view says =
      "sightline: undecided: out of memory; take a smaller scene or fewer outputs, or a machine (or limit) with more\n";
  remove_unfinished();
  [[maybe_unused]] const auto written = write(STDERR_FILENO, says.data(), says.size());  // or the exit code says it
  _exit(static_cast<int>(Exit::undecided));
}

/// Whether the error says that a container would be longer than any memory; others of its kind have a sentence.
static bool is_without_end(const std::exception& error) {
  return dynamic_cast<const std::length_error*>(&error) != nullptr &&
         std::string_view(error.what()).find("::") != std::string_view::npos;
}

// ---- Commands

struct Named_command {
  std::string_view name;
  void (*add)(Command program);
};
static constexpr Named_command all_commands[] = {{"info", add_info},         {"bsp", add_bsp},
                                                 {"order", add_order},       {"graph", add_graph},
                                                 {"cutset", add_cutset},     {"see", add_see},
                                                 {"weak", add_weak},         {"shadow", add_shadow},
                                                 {"trace", add_trace},       {"render", add_render},
                                                 {"boolean", add_boolean},   {"cells", add_cells},
                                                 {"pvs", add_pvs},           {"merge", add_merge},
                                                 {"verify", add_verify},     {"compare", add_compare},
                                                 {"generate", add_generate}, {"fuzz", add_fuzz},
                                                 {"reduce", add_reduce},     {"judge", add_judge},
                                                 {"report", add_report},     {"completion", add_completion},
                                                 {"schema", add_schema}};

/// The commands that a command line with this first word is about: all of them where it is none of their names, and for
/// `completion`, which lists them. The options of all are half of what a short run takes.
static std::span<const Named_command> commands_for(std::string_view first_word) {
  const auto named = std::ranges::find(all_commands, first_word, &Named_command::name);
  if (named == std::end(all_commands) || first_word == "completion") return all_commands;
  return {named, 1};
}

/// Does what the command line asks for, and says what went wrong.
static Exit run(int argc, char** argv) {
  Program program("sightline", "Exact 3D visibility: who can see what, with answers that can be checked.");
  program.set_version(program_version() + ' ' + library_versions());
  program.root().footer(
      "An OUTPUT is written whole or not at all, and is no FILE of the same command; - is standard output or input.\n"
      "Exit codes: 0 done; 1 a check failed, or methods disagree; 2 usage; 3 bad input, or an output that cannot be "
      "written; 4 undecided, or the budget or memory ran out.");
  for (const auto& [name, add] : commands_for(argc > 1 ? argv[1] : "")) add(program.root());
  try {
    return program.run(argc, argv).value_or(Exit::done);
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (const std::exception& error) {
    if (is_without_end(error)) end_without_memory();
    std::cerr << "sightline: " << error.what() << '\n';
    const bool usage = dynamic_cast<const Usage_error*>(&error) != nullptr;
    const bool budget = dynamic_cast<const sightline::Out_of_budget*>(&error) != nullptr;
    return usage ? Exit::usage : budget ? Exit::undecided : Exit::bad_input;
  }
}

int main(int argc, char** argv) {
  watch_for_signals();
  sightline::keep_what_is_read();
  std::set_new_handler(end_without_memory);
  keep_numbers_in_small_blocks(end_without_memory);
  const Exit exit = run(argc, argv);
  // An answer that is not all there is none, whatever it was. What went wrong earlier the system says once more.
  errno = 0;
  if (std::cout.flush()) return static_cast<int>(exit);
  const bool well = errno == 0 && write(STDOUT_FILENO, "\n", 1) == 1;
  std::cerr << "sightline: standard output cannot be written"
            << (well ? "; check that its disk is not full" : std::string(": ") + std::strerror(errno)) << '\n';
  return static_cast<int>(Exit::bad_input);
}
