// The command fuzz alone, for the library with planted faults.

#include "../../../apps/support/command.h"

#include <exception>
#include <iostream>

void set_action(CLI::App& command, std::function<Exit()> action) {
  command.callback([action = std::move(action)] { throw CLI::RuntimeError(static_cast<int>(action())); });
}

int main(int argc, char** argv) {
  CLI::App app("Looks for the fault that the environment variable SIGHTLINE_FAULT names, by sightline fuzz.",
               "sightline_faulty");
  app.require_subcommand(1);
  add_fuzz(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& result) {
    return result.get_exit_code();
  } catch (const CLI::ParseError& message) {
    return app.exit(message) == 0 ? 0 : static_cast<int>(Exit::usage);
  } catch (const std::exception& error) {
    std::cerr << "sightline_faulty: " << error.what() << '\n';
    return static_cast<int>(Exit::bad_input);
  }
}
