#include <sightline/algorithms/priority/eye_order.h>

namespace sightline {

template Eye_order<Exact_traits> back_to_front(const Exact_traits&, const Priority_tree<Exact_traits>&,
                                               const Exact_point&,
                                               const std::function<void(std::size_t, std::size_t)>&);

}  // namespace sightline
