#include <sightline/algorithms/priority/index.h>

namespace sightline {

template class Priority_index<Exact_traits>;

}  // namespace sightline
