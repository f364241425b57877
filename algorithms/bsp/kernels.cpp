#include <sightline/algorithms/bsp/kernels.h>

namespace sightline {

template Bsp_tree<Point_traits<CGAL::Simple_cartesian<float>>> build_bsp(
    const Point_traits<CGAL::Simple_cartesian<float>>&, const Bsp_options&);
template Bsp_tree<Point_traits<CGAL::Simple_cartesian<double>>> build_bsp(
    const Point_traits<CGAL::Simple_cartesian<double>>&, const Bsp_options&);
template Bsp_tree<Point_traits<CGAL::Epick>> build_bsp(const Point_traits<CGAL::Epick>&, const Bsp_options&);
template Bsp_tree<Point_traits<CGAL::Epeck>> build_bsp(const Point_traits<CGAL::Epeck>&, const Bsp_options&);
template Bsp_tree<Point_traits<CGAL::Cartesian<CGAL::Gmpq>>> build_bsp(const Point_traits<CGAL::Cartesian<CGAL::Gmpq>>&,
                                                                       const Bsp_options&);

}  // namespace sightline
