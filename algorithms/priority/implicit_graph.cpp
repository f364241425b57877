#include <sightline/algorithms/priority/implicit_graph.h>

namespace sightline {

template class Implicit_priority_graph<Priority_relation<Exact_traits>>;

}  // namespace sightline
