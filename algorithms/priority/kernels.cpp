#include <sightline/algorithms/priority/kernels.h>

namespace sightline {

template Priority_tree<Float_traits> build_priority_tree(const Float_traits&, const Priority_tree_options&);
template Priority_tree<Double_traits> build_priority_tree(const Double_traits&, const Priority_tree_options&);
template Eye_order<Float_traits> back_to_front(const Float_traits&, const Priority_tree<Float_traits>&,
                                               const Exact_point&,
                                               const std::function<void(std::size_t, std::size_t)>&);
template Eye_order<Double_traits> back_to_front(const Double_traits&, const Priority_tree<Double_traits>&,
                                                const Exact_point&,
                                                const std::function<void(std::size_t, std::size_t)>&);
template class Priority_relation<Double_traits>;
template Explicit_priority_graph::Explicit_priority_graph(const Priority_relation<Double_traits>&,
                                                          const std::function<void(std::size_t, std::size_t)>&);

}  // namespace sightline
