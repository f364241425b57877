#pragma once
// The answers to the questions of a report, unit by unit; and those of before, which --resume keeps.

#include "../support/journal.h"
#include "../support/shard.h"
#include "units.h"

#include <sightline/harness/report/report.h>

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sightline::app {

/// Rows of a unit, and what was not asked.
struct Answered {
  std::vector<report::Row> rows;
  Json not_asked = Json::object();
};

/// How units are asked.
struct Report_asking {
  const Report_arguments& arguments;
  Shard own;  ///< of the units
  Report_effort effort;
  Report_limits limits;
  std::vector<Report_program> programs;  ///< of users, beside the methods
};

/// Asks all cases of a unit. What cannot be asked is told, and left out. Errors: Input_error of a scene that somebody
/// named; Usage_error of a program.
Answered answered(const Unit& unit, const Report_asking& asking);

/// What is done, in a file beside --json, a unit a line, until the report is written whole.
class Kept_units {
 public:
  explicit Kept_units(const Report_asking& asking);

  /// What was answered of these units before, where their scenes' files are what they were, as contents_json() has
  /// them; and goes on behind it.
  std::map<std::size_t, Answered> begin(const std::vector<Unit>& units, const Json& contents);
  void add(std::size_t unit, const Answered& answers);
  void remove() { journal_.remove(); }
  std::size_t changed() const { return changed_.size(); }  ///< units that were answered of another scene

 private:
  Journal journal_;
  std::vector<std::string> identities_;
  std::set<std::size_t> changed_;
};

}  // namespace sightline::app
