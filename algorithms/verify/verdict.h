#pragma once
// What checkers answer, and how they come to say no.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

/// What a checker answers.
struct Verdict {
  bool accepted = false;
  std::string why;                     ///< one line; where rejected, the first thing found wrong
  std::vector<std::size_t> fragments;  ///< the places in the order of the fragments at fault, where there are such
};

struct Verify_options {
  int threads = 0;  ///< 0: as many as there are processors; the verdict is the same for any number
  /// The share of pairs that are done with, of all fragments; while fragments are made ready for that, 0. May be empty.
  /// It may be called from any thread, but never from two at once; what it throws ends the check.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

namespace certificate_check {

struct Rejection {
  Verdict verdict;
};

[[noreturn]] inline void reject(std::string why, std::vector<std::size_t> fragments = {}) {
  throw Rejection{{false, std::move(why), std::move(fragments)}};
}

/// What a check answers that returns its line on acceptance and throws a Rejection otherwise.
template <class Check>
Verdict verdict_of(Check check) {
  try {
    return {true, check(), {}};
  } catch (const Rejection& rejection) {
    return rejection.verdict;
  }
}

/// For messages.
inline std::string name(const char* kind, std::size_t number) { return kind + (' ' + std::to_string(number)); }

std::string name(const Exact_point& p);  // rounded
std::string exact_name(const Exact_point& p);

/// Whether numbers are in lowest terms, over positive denominators.
bool canonical(const Rational& r);
template <std::size_t n>
bool canonical(const std::array<Rational, n>& all) {
  return std::all_of(all.begin(), all.end(), [](const Rational& r) { return canonical(r); });
}
bool canonical(const std::vector<Exact_point>& points);

}  // namespace certificate_check

}  // namespace sightline
