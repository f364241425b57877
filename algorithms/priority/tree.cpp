#include <sightline/algorithms/priority/tree.h>

namespace sightline {

template Priority_tree<Exact_traits> build_priority_tree(const Exact_traits&, const Priority_tree_options&);
template Priority_tree<Exact_traits> build_priority_tree(const Exact_traits&,
                                                         std::span<const Convex_polygon<Exact_traits>>,
                                                         std::span<const char>, const Priority_tree_options&);

}  // namespace sightline
