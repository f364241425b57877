// The program sightline: its commands, and what its exit codes mean.

#include "support/command.h"
#include "support/files.h"

#include <cerrno>
#include <cstring>
#include <exception>
#include <iostream>

using namespace sightline::app;

/// Does what the command line asks for, and says what went wrong.
static Exit run(int argc, char** argv) {
  Program program("sightline", "Exact 3D visibility: who can see what, with answers that can be checked.");
  program.set_version(SIGHTLINE_VERSION);
  program.root().footer(
      "An OUTPUT is written whole or not at all, and is no FILE of the same command; - is standard output or input.\n"
      "Exit codes: 0 done; 1 a check failed, or methods disagree; 2 usage; 3 bad input, or an output that cannot be "
      "written; 4 undecided, or the budget ran out.");
  for (const auto add : {add_info, add_bsp, add_order, add_graph, add_cutset, add_see, add_weak, add_verify,
                         add_compare, add_generate, add_fuzz, add_reduce, add_judge})
    add(program.root());
  try {
    return program.run(argc, argv).value_or(Exit::done);
  } catch (const std::exception& error) {
    std::cerr << "sightline: " << error.what() << '\n';
    const bool usage = dynamic_cast<const Usage_error*>(&error) != nullptr;
    const bool budget = dynamic_cast<const Out_of_budget*>(&error) != nullptr;
    return usage ? Exit::usage : budget ? Exit::undecided : Exit::bad_input;
  }
}

int main(int argc, char** argv) {
  watch_for_signals();
  const Exit exit = run(argc, argv);
  // An answer that is not all there is none, whatever it was.
  errno = 0;
  if (std::cout.flush()) return static_cast<int>(exit);
  std::cerr << "sightline: standard output cannot be written"
            << (errno == 0 ? "; check that its disk is not full" : std::string(": ") + std::strerror(errno)) << '\n';
  return static_cast<int>(Exit::bad_input);
}
