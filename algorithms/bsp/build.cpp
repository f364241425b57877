#include <sightline/algorithms/bsp/build.h>

namespace sightline {

template Bsp_tree<Exact_traits> build_bsp(const Exact_traits&, const Bsp_options&);

}  // namespace sightline
