#include <sightline/algorithms/cutset/tracker.h>

namespace sightline {

Cut_set_counters& Cut_set_counters::operator+=(const Cut_set_counters& other) {
  tests += other.tests;
  away += other.away;
  exact += other.exact;
  changed += other.changed;
  births += other.births;
  searches += other.searches;
  compared += other.compared;
  return *this;
}

template class Cut_set_tracker<Exact_traits>;

}  // namespace sightline
