#include <sightline/algorithms/weak_visibility/weak_answer.h>

#include <algorithm>

namespace sightline {

Weak_counters& Weak_counters::operator+=(const Weak_counters& o) {
  targets += o.targets;
  away += o.away;
  by_rays += o.by_rays;
  occluders += o.occluders;
  cells += o.cells;
  cuts += o.cuts;
  shaves += o.shaves;
  bisections += o.bisections;
  blocked += o.blocked;
  empty += o.empty;
  corners += o.corners;
  learned += o.learned;
  jumps += o.jumps;
  programs += o.programs;
  exact_programs += o.exact_programs;
  form_programs += o.form_programs;
  by_forms += o.by_forms;
  confirmed += o.confirmed;
  refuted += o.refuted;
  lines += o.lines;
  open += o.open;
  deepest = std::max(deepest, o.deepest);
  return *this;
}

}  // namespace sightline
