#pragma once
// What a report asks: its command line, and the cases of every question.

#include "../judge/cases.h"
#include "questions.h"

#include <optional>
#include <string>
#include <vector>

namespace sightline::app {

struct Report_arguments {
  std::vector<std::string> scenes;
  std::vector<std::string> questions, families, distances, programs, parts;
  std::vector<std::size_t> sizes;
  std::string ask, json, html, svg, keep, shard;
  bool quick = false, resume = false, quiet = false;  // quiet: an output takes standard output
  std::uint64_t cases = 0, seed = 1, memory = 1024, reduce = 0;
  double limit = 0, budget = 0;
  std::optional<Command> command;
};

/// The distance of scenes of files.
constexpr const char* as_given = "as given";

/// What is chosen where an option is not given.
struct Usual {
  std::vector<std::string> families, distances;
  std::vector<std::size_t> sizes;
  std::uint64_t cases, reduce;
  double limit;
};
Usual usual(bool quick);

/// A row's place: a question, and where its cases come from.
struct Unit {
  std::size_t number;
  const Report_question* question;
  std::size_t size;
  Case_group group;
  bool is_of_a_folder = false;  ///< a scene that nobody named: what cannot be read is passed over
};

/// Of every question the cases of families at each distance and size, then of scenes. Errors: Usage_error naming the
/// option; Input_error.
std::vector<Unit> units_of(const Report_arguments& a);

/// What rows depend on, by options' names.
Json asked_json(const Report_arguments& a);

/// A name of what each file holds that is asked about, which is read once, whatever is asked of it; of one that cannot
/// be read, what is said of it where it is asked about.
Json contents_json(const Report_arguments& a, const std::vector<Unit>& units);

}  // namespace sightline::app
