#pragma once
// The result of `sightline judge` in numbers, and as a table and a verdict for people.

#include "court.h"

namespace sightline::app {

/// The sums of some cases: how many of each mark, faces, times, memory.
Json sums_of(const std::vector<const Judged*>& cases);

/// On standard output. Pre: `document` is what --json writes.
void print_table(const Json& document);
/// Of a contract that nothing breaks: in which cases it holds, and how many were not answered. Pre: some were asked.
std::string what_holds(const Json& total);
/// Why, then a table by distance, and the verdict as the last line.
void print_verdict(const Json& document);

}  // namespace sightline::app
