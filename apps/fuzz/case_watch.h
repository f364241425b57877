#pragma once
// The case that is being run, in case it is the last: what is said of it where a signal ends the program, or where it
// takes too long.

#include <string>

namespace sightline::app {

/// From now on signals that end the program, and findings of the address sanitizer, name the case.
void watch_for_crashes();

/// A case begins, instead of any before; `replay` is the command that runs it alone. If it does not end within so many
/// seconds of processor time, the program says so on standard error and ends with exit code 1, without more ado: it
/// cannot be trusted with more. `doing` says what is being done with it. Pre: seconds > 0
void begin_case(const std::string& replay, double seconds, const std::string& doing = "in the case that this replays");

/// No case is being run, and none will take too long.
void end_case();

}  // namespace sightline::app
