#include <sightline/algorithms/priority/scope.h>

#include <CGAL/Gmpz.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <algorithm>

namespace sightline {

View_region View_region::box(const Exact_point& low, const Exact_point& high) {
  View_region region;
  for (std::size_t k = 0; k < 3; ++k)
    if (high[k] < low[k]) return region;
  for (unsigned corner = 0; corner < 8; ++corner)
    region.points.push_back({(corner & 1 ? high : low)[0], (corner & 2 ? high : low)[1], (corner & 4 ? high : low)[2]});
  std::sort(region.points.begin(), region.points.end());
  region.points.erase(std::unique(region.points.begin(), region.points.end()), region.points.end());
  return region;
}

namespace priority_detail {

// The program: are there alpha, beta >= 1 and gamma >= 0 with
//   sum alpha (a_k, 1) - sum beta (b_l, 1) = sum gamma (p_m, 1),  sum alpha height_b(a_k) >= 1,  sum beta height_a(b_l)
//   <= -1?
bool an_eye_may_see_over(const Grid_face& a, const Grid_face& b, const std::vector<Grid_point>& eyes) {
  using Wide = CGAL::Gmpz;
  const auto number = [](const Integer& x) { return Wide(x.get_mpz_t()); };
  CGAL::Quadratic_program<Wide> program(CGAL::EQUAL, true, Wide(1), false, Wide(0));
  int column = 0;
  const Grid_point& origin = a.corners[0];
  const auto add = [&](const Grid_point& p, int sign) {
    const Grid_point from = minus(p, origin);
    for (int k = 0; k < 3; ++k) program.set_a(column, k, number(Integer(sign * from[static_cast<std::size_t>(k)])));
    program.set_a(column, 3, Wide(sign));
  };
  for (const Grid_point& p : a.corners) {
    add(p, 1);
    program.set_a(column++, 4, number(b.height(p)));
  }
  for (const Grid_point& p : b.corners) {
    add(p, -1);
    program.set_a(column++, 5, number(a.height(p)));
  }
  for (const Grid_point& p : eyes) {
    add(p, -1);
    program.set_l(column++, true, Wide(0));
  }
  for (int k = 0; k < 4; ++k) program.set_b(k, Wide(0));
  program.set_b(4, Wide(1));
  program.set_r(4, CGAL::LARGER);
  program.set_b(5, Wide(-1));
  program.set_r(5, CGAL::SMALLER);
  return !CGAL::solve_linear_program(program, Wide()).is_infeasible();
}

}  // namespace priority_detail

template priority_detail::Grid_scene::Grid_scene(const Priority_relation<Exact_traits>&,
                                                 const std::vector<Exact_point>&);
template class Region_relation<Exact_traits>;
template class Ray_relation<Exact_traits>;
template class Implicit_priority_graph<Region_relation<Exact_traits>>;
template class Implicit_priority_graph<Ray_relation<Exact_traits>>;

}  // namespace sightline
