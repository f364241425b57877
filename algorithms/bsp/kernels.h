#pragma once
// The kernels of CGAL that the program offers: their trees are compiled once, in kernels.cpp. For another kernel, and
// for traits of one's own, build.h is enough: the template is compiled where it is used.

#include <sightline/algorithms/bsp/build.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

namespace sightline {

extern template Bsp_tree<Point_traits<CGAL::Simple_cartesian<float>>> build_bsp(
    const Point_traits<CGAL::Simple_cartesian<float>>&, const Bsp_options&);
extern template Bsp_tree<Point_traits<CGAL::Simple_cartesian<double>>> build_bsp(
    const Point_traits<CGAL::Simple_cartesian<double>>&, const Bsp_options&);
extern template Bsp_tree<Point_traits<CGAL::Epick>> build_bsp(const Point_traits<CGAL::Epick>&, const Bsp_options&);
extern template Bsp_tree<Point_traits<CGAL::Epeck>> build_bsp(const Point_traits<CGAL::Epeck>&, const Bsp_options&);
extern template Bsp_tree<Point_traits<CGAL::Cartesian<CGAL::Gmpq>>> build_bsp(
    const Point_traits<CGAL::Cartesian<CGAL::Gmpq>>&, const Bsp_options&);

}  // namespace sightline
