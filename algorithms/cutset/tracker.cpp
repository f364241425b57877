#include <sightline/algorithms/cutset/tracker.h>

namespace sightline {

template class Cut_set_tracker<Exact_traits>;

}  // namespace sightline
