#pragma once
// The numbers of CGAL's kernels that the program paints in the order of a priority graph with, and compares faces in:
// compiled once, in kernels.cpp. What is exact where the traits are then holds of rounded faces at best: relations
// among all of them, the planes between them and cuts are signs in those numbers, which are believed; what overlaps
// from one eye is asked of the rounded corners, in integers.

#include <sightline/algorithms/priority/explicit_graph.h>
#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/algorithms/priority/tree.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Simple_cartesian.h>

namespace sightline {

using Float_traits = Point_traits<CGAL::Simple_cartesian<float>>;
using Double_traits = Point_traits<CGAL::Simple_cartesian<double>>;

extern template Priority_tree<Float_traits> build_priority_tree(const Float_traits&, const Priority_tree_options&);
extern template Priority_tree<Double_traits> build_priority_tree(const Double_traits&, const Priority_tree_options&);
extern template Eye_order<Float_traits> back_to_front(const Float_traits&, const Priority_tree<Float_traits>&,
                                                      const Exact_point&,
                                                      const std::function<void(std::size_t, std::size_t)>&);
extern template Eye_order<Double_traits> back_to_front(const Double_traits&, const Priority_tree<Double_traits>&,
                                                       const Exact_point&,
                                                       const std::function<void(std::size_t, std::size_t)>&);

extern template class Priority_relation<Double_traits>;
extern template Explicit_priority_graph::Explicit_priority_graph(const Priority_relation<Double_traits>&,
                                                                 const std::function<void(std::size_t, std::size_t)>&);

}  // namespace sightline
