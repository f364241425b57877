#include <sightline/algorithms/priority/relation.h>

namespace sightline {

template class Priority_relation<Exact_traits>;

}  // namespace sightline
