// The program sightline: its commands, and what its exit codes mean.

#include "support/command.h"

#include <exception>
#include <iostream>

using namespace sightline::app;

int main(int argc, char** argv) {
  Program program("sightline", "Exact 3D visibility: who can see what, with answers that can be checked.");
  program.set_version(SIGHTLINE_VERSION);
  for (const auto add : {add_info, add_bsp, add_order, add_graph, add_cutset, add_see, add_weak, add_verify,
                         add_compare, add_generate, add_fuzz, add_reduce, add_judge})
    add(program.root());

  try {
    if (const std::optional<Exit> exit = program.run(argc, argv)) return static_cast<int>(*exit);
  } catch (const std::exception& error) {
    std::cerr << "sightline: " << error.what() << '\n';
    const bool usage = dynamic_cast<const Usage_error*>(&error) != nullptr;
    const bool budget = dynamic_cast<const Out_of_budget*>(&error) != nullptr;
    return static_cast<int>(usage ? Exit::usage : budget ? Exit::undecided : Exit::bad_input);
  }
  if (std::cout.flush()) return static_cast<int>(Exit::done);
  std::cerr << "sightline: standard output cannot be written; check that its disk is not full\n";
  return static_cast<int>(Exit::bad_input);
}
