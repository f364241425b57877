#include <sightline/algorithms/point_visibility/visible_surface.h>

#include <algorithm>

namespace sightline {

Visible_counters& Visible_counters::operator+=(const Visible_counters& o) {
  opened += o.opened;
  looked_at += o.looked_at;
  hidden += o.hidden;
  hidden_boxes += o.hidden_boxes;
  regions += o.regions;
  splits += o.splits;
  crossings += o.crossings;
  merged += o.merged;
  depth = std::max(depth, o.depth);
  predicates += o.predicates;
  return *this;
}

}  // namespace sightline
