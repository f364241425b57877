// The program sightline: the command line, and what its exit codes mean.

#include "support/common.h"

#include <exception>
#include <iostream>
#include <utility>

void set_action(CLI::App& command, std::function<Exit()> action) {
  command.callback([action = std::move(action)] {
    if (const Exit exit = action(); exit != Exit::done) throw CLI::RuntimeError(static_cast<int>(exit));
  });
}

int main(int argc, char** argv) {
  CLI::App app("Exact 3D visibility: who can see what, with answers that can be checked.", "sightline");
  app.set_version_flag("--version", "sightline " SIGHTLINE_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App* at, const CLI::Error& error) {  // one line, with the word that is no command
    return fmt::format("sightline: {}{}; --help says more\n", error.what(),
                       at->remaining().empty() ? "" : " ('" + at->remaining().front() + "' is none)");
  });
  add_info(app);
  add_bsp(app);
  add_order(app);
  add_graph(app);
  add_cutset(app);
  add_see(app);
  add_weak(app);
  add_verify(app);
  add_compare(app);
  add_generate(app);
  add_fuzz(app);
  add_reduce(app);
  add_judge(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::RuntimeError& result) {  // an action's answer
    return result.get_exit_code();
  } catch (const CLI::ParseError& message) {  // also --help and --version, which are no errors
    return static_cast<int>(app.exit(message, std::cout, std::cerr) == 0 ? Exit::done : Exit::usage);
  } catch (const std::exception& error) {
    std::cerr << "sightline: " << error.what() << '\n';
    const bool usage = dynamic_cast<const sightline::app::Usage_error*>(&error) != nullptr;
    const bool budget = dynamic_cast<const sightline::app::Out_of_budget*>(&error) != nullptr;
    return static_cast<int>(usage ? Exit::usage : budget ? Exit::undecided : Exit::bad_input);
  }
  if (std::cout.flush()) return static_cast<int>(Exit::done);
  std::cerr << "sightline: standard output cannot be written; check that its disk is not full\n";
  return static_cast<int>(Exit::bad_input);
}
