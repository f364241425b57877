// Templates that are compiled once for the library's kernels compile from the header for anybody else's.

#include <sightline/algorithms/bsp/build.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Simple_cartesian.h>

std::size_t nodes_by_own_kernel(const sightline::Scene& scene) {
  using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;  // the library's is Cartesian<Gmpq>
  return sightline::build_bsp(sightline::Point_traits<Kernel>(scene)).nodes.size();
}
