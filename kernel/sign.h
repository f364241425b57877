#pragma once
// Signs, and counters of how they were decided.

#include <sightline/kernel/counters.h>

#include <CGAL/enum.h>

#include <cstdint>

namespace sightline {

using Sign = CGAL::Sign;  ///< NEGATIVE: behind, ZERO: on, POSITIVE: in front

/// The sign of a double. Pre: a number.
inline Sign sign_of(double value) { return value > 0 ? CGAL::POSITIVE : value < 0 ? CGAL::NEGATIVE : CGAL::ZERO; }

/// How many predicates each stage decided.
struct Predicate_counts {
  std::uint64_t combinatorial = 0, filtered = 0, fixed = 0, gmp = 0;
  /// Each by its key in reports, in their order.
  template <class Visit>
  static void each(Visit visit) {
    visit("combinatorial", &Predicate_counts::combinatorial);
    visit("filtered", &Predicate_counts::filtered);
    visit("fixed", &Predicate_counts::fixed);
    visit("gmp", &Predicate_counts::gmp);
  }
  std::uint64_t total() const { return combinatorial + filtered + fixed + gmp; }
};

}  // namespace sightline
