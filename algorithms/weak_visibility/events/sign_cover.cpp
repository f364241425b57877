#include <sightline/algorithms/weak_visibility/events/sign_cover.h>

#include <bit>

namespace sightline {
namespace {

int size_of(const Sign_clause& clause) { return std::popcount(clause.positive) + std::popcount(clause.negative); }

/// Of the clauses from `begin`. Leaves them as they were.
bool some_holds(std::vector<Sign_clause>& clauses, std::size_t begin, int& cases) {
  // 1. All of 2^n cases are in a clause, and one of m signs has 2^(n - m) of them.
  std::uint64_t share = 0;  // of 2^32, rounded down
  std::size_t shortest = begin;
  const std::size_t end = clauses.size();
  for (std::size_t k = begin; k < end; ++k) {
    const int size = size_of(clauses[k]);
    if (size == 0) return true;
    if (size <= 32) share += std::uint64_t{1} << (32 - size);
    if (size < size_of(clauses[shortest])) shortest = k;
  }
  if (share < std::uint64_t{1} << 32 || --cases < 0) return false;
  // 2. Both cases of a number that a shortest one asks for.
  const std::uint64_t asked = clauses[shortest].positive | clauses[shortest].negative, number = asked & (~asked + 1);
  for (const bool is_positive : {true, false}) {
    for (std::size_t k = begin; k < end; ++k) {
      const Sign_clause clause = clauses[k];
      if (((is_positive ? clause.negative : clause.positive) & number) == 0)
        clauses.push_back({clause.positive & ~number, clause.negative & ~number});
    }
    const bool holds = some_holds(clauses, end, cases);
    clauses.resize(end);
    if (!holds) return false;
  }
  return true;
}

}  // namespace

bool some_clause_holds(std::vector<Sign_clause>& clauses, int cases) {
  std::erase_if(clauses, [](const Sign_clause& clause) { return (clause.positive & clause.negative) != 0; });
  return some_holds(clauses, 0, cases);
}

Blocked_together::Blocked_together(std::size_t lines, std::span<const Event_lines::Blocker> all)
    : all_(all), wanted_(lines), places_(lines), used_(lines) {
  for (const Event_lines::Blocker& blocker : all)
    for (const Event_lines::Literal& literal : blocker.literals)
      wanted_[literal.line] = static_cast<signed char>(wanted_[literal.line] | (literal.sense > 0 ? 1 : 2));
}

}  // namespace sightline
