#pragma once
// Conjunctions of signs, of which one at least holds whatever the signs are.

#include <sightline/algorithms/weak_visibility/events/event_lines.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

/// Holds iff numbers k of which bit k is set in `positive` are > 0, and those in `negative` < 0.
struct Sign_clause {
  std::uint64_t positive, negative;
};

/// Whether some clause holds for all signs of the numbers, none of them zero. May say no where it would take more than
/// so many cases to see. Degenerate: a clause that wants both signs of a number never holds, one that wants nothing
/// always does. Exact: where it says yes. Proof: P-73
bool some_clause_holds(std::vector<Sign_clause>& clauses, int cases = 64);

/// Blockers of which together one holds always: as some_clause_holds(), of the literals whose signs are not known.
/// Refers to them.
class Blocked_together {
 public:
  Blocked_together(std::size_t lines, std::span<const Event_lines::Blocker> all);

  /// `known(literal)`: 1 where it holds, 0 where that is open. Pre: no literal of them fails.
  template <class Known>
  bool holds(std::span<const std::uint32_t> blockers, Known known);

 private:
  /// One with more open literals has hardly a part in what is covered.
  static constexpr std::size_t most_open = 4, most_lines = 64;
  std::span<const Event_lines::Blocker> all_;
  std::vector<signed char> wanted_;  // of each line, by blockers: 1 positive, 2 negative, 3 both
  std::vector<std::uint32_t> places_;
  std::vector<char> used_;
  std::vector<std::uint32_t> lines_;
  std::vector<Event_lines::Literal> open_;
  std::vector<Sign_clause> clauses_;
};

template <class Known>
bool Blocked_together::holds(std::span<const std::uint32_t> blockers, Known known) {
  // Where a line is open of which nobody wants the other side, that side has to be blocked without this one, and then
  // so has this.
  const auto has_part = [&](std::uint32_t b) {
    open_.clear();
    for (const Event_lines::Literal& literal : all_[b].literals) {
      if (known(literal) != 0) continue;
      open_.push_back(literal);
      if (open_.size() > most_open || wanted_[literal.line] != 3) return false;
    }
    return true;
  };
  clauses_.clear();
  lines_.clear();
  for (const std::uint32_t b : blockers) {
    if (!has_part(b)) continue;
    Sign_clause clause{0, 0};
    bool fits = true;
    for (const Event_lines::Literal& literal : open_) {
      if (!std::exchange(used_[literal.line], char{1})) {
        places_[literal.line] = static_cast<std::uint32_t>(lines_.size());
        lines_.push_back(literal.line);
      }
      fits &= places_[literal.line] < most_lines;
      if (fits) (literal.sense > 0 ? clause.positive : clause.negative) |= std::uint64_t{1} << places_[literal.line];
    }
    if (fits) clauses_.push_back(clause);
  }
  for (const std::uint32_t line : lines_) used_[line] = 0;
  return some_clause_holds(clauses_);
}

}  // namespace sightline
