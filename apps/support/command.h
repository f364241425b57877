#pragma once
// How a command becomes part of the program: each apps/<command>.cpp defines one add_<command>, and main.cpp calls it.

#include <CLI/CLI.hpp>

#include <functional>

/// What the program's exit code says.
enum class Exit : int {
  done = 0,
  disagreement = 1,  ///< a check failed, or methods disagree
  usage = 2,
  bad_input = 3,
  undecided = 4,  ///< the budget ran out
};

/// Lets a command do its work after the whole command line is read; what action returns becomes the program's exit
/// code. Pre: called once for a command. What action throws is reported and becomes Exit::bad_input, or what main.cpp
/// says of its kind.
void set_action(CLI::App& command, std::function<Exit()> action);

void add_info(CLI::App& app);
void add_bsp(CLI::App& app);
void add_order(CLI::App& app);
void add_graph(CLI::App& app);
void add_cutset(CLI::App& app);
void add_verify(CLI::App& app);
void add_compare(CLI::App& app);
void add_see(CLI::App& app);
void add_weak(CLI::App& app);
void add_generate(CLI::App& app);
void add_fuzz(CLI::App& app);
void add_reduce(CLI::App& app);
void add_judge(CLI::App& app);
