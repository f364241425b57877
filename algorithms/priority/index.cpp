#include <sightline/algorithms/priority/index.h>

namespace sightline {

Index_counters& Index_counters::operator+=(const Index_counters& other) {
  nodes += other.nodes;
  hits += other.hits;
  misses += other.misses;
  relation += other.relation;
  return *this;
}

}  // namespace sightline
