#include <sightline/algorithms/priority/scope.h>

namespace sightline {

template priority_detail::Grid_scene::Grid_scene(const Priority_relation<Exact_traits>&,
                                                 const std::vector<Exact_point>&);
template class Region_relation<Exact_traits>;
template class Ray_relation<Exact_traits>;
template class Implicit_priority_graph<Region_relation<Exact_traits>>;
template class Implicit_priority_graph<Ray_relation<Exact_traits>>;

}  // namespace sightline
