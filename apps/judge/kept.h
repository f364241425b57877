#pragma once
// Cases that were judged, which --resume keeps.

#include "../support/journal.h"
#include "court.h"

#include <sightline/harness/judge/guess.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sightline::app {

/// A grade as JSON, and back. Errors: exceptions of nlohmann's where it is none.
Json grade_json(const judge::Grade& grade);
judge::Grade grade_from_json(const nlohmann::json& json);

/// A case and all that comes of it: it is not asked again, nor is the truth.
struct Kept_case {
  Judged judged;                         ///< but for the answer
  std::optional<std::string> said;       ///< the answer's file, where it is looked at again
  std::vector<judge::Reading> readings;  ///< of a wrong case: those under which it and all before it are right
};

/// Cases by number, in a file that grows by a line with each.
class Kept_cases {
 public:
  /// Reads what is there, and goes on behind it. Errors: as Journal.
  Kept_cases(std::string file, Json head);

  /// The case of that number; null where it was not judged, or is another one now: `of` names it.
  const Kept_case* find(std::size_t number, const std::string& of) const;
  void add(std::size_t number, const std::string& of, const Kept_case& judged);

 private:
  struct Named_case {
    std::string of;
    Kept_case kept;
  };
  std::map<std::size_t, Named_case> cases_;
  Journal journal_;
};

}  // namespace sightline::app
