// The command fuzz alone, for the library with planted faults.

#include "../../../apps/support/command.h"

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  using namespace sightline::app;
  Program program("sightline_faulty",
                  "Looks for the fault that the environment variable SIGHTLINE_FAULT names, by sightline fuzz.");
  add_fuzz(program.root());
  try {
    return static_cast<int>(program.run(argc, argv).value_or(Exit::done));
  } catch (const std::exception& error) {
    std::cerr << "sightline_faulty: " << error.what() << '\n';
    return static_cast<int>(Exit::bad_input);
  }
}
