// An adapter for `sightline judge`: set operations by CGAL. A fourth argument says by which: `epick`, corefinement in
// doubles with exact predicates; `epeck`, corefinement with exact constructions, the default; `nef`, Nef polyhedra.
// What corefinement declines, as results that are no manifolds, is left open.

#include "adapter.h"

#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/io/off.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>

namespace {

using namespace sightline;
namespace PMP = CGAL::Polygon_mesh_processing;

/// What CGAL declines to answer.
struct Declined {};

using Polygons = std::vector<std::vector<std::size_t>>;

template <class Kernel>
CGAL::Surface_mesh<typename Kernel::Point_3> mesh_of(const Polygon_soup& solid) {
  using Number = Field_number<typename Kernel::FT>;
  std::vector<typename Kernel::Point_3> points;
  for (Point_id p = 0; p < solid.point_count(); ++p) {
    const Exact_point at = solid.point(p);
    points.emplace_back(Number::from(at[0]), Number::from(at[1]), Number::from(at[2]));
  }
  Polygons triangles;
  for (Face_id face = 0; face < solid.face_count(); ++face)
    for (const std::vector<Point_id>& triangle : triangles_of(solid, face))
      triangles.emplace_back(triangle.begin(), triangle.end());
  if (!PMP::is_polygon_soup_a_polygon_mesh(triangles)) throw Declined();
  CGAL::Surface_mesh<typename Kernel::Point_3> mesh;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  return mesh;
}

template <class Kernel>
Polygon_soup soup_of(const std::vector<typename Kernel::Point_3>& points, const Polygons& polygons) {
  using Number = Field_number<typename Kernel::FT>;
  Polygon_soup soup;
  for (const auto& p : points) soup.add_point(Number::to(p.x()), Number::to(p.y()), Number::to(p.z()));
  for (const auto& polygon : polygons) soup.add_face(std::vector<Point_id>(polygon.begin(), polygon.end()));
  return soup;
}

template <class Mesh>
Mesh corefined(Mesh a, Mesh b, Set_operation operation) {
  Mesh result;
  bool is_done = false;
  switch (operation) {
    case Set_operation::unite: is_done = PMP::corefine_and_compute_union(a, b, result); break;
    case Set_operation::intersect: is_done = PMP::corefine_and_compute_intersection(a, b, result); break;
    case Set_operation::subtract: is_done = PMP::corefine_and_compute_difference(a, b, result); break;
    case Set_operation::differ:
      return corefined(corefined(a, b, Set_operation::subtract), corefined(b, a, Set_operation::subtract),
                       Set_operation::unite);
  }
  if (!is_done) throw Declined();
  return result;
}

template <class Kernel>
Polygon_soup by_corefinement(const std::array<Polygon_soup, 2>& solids, Set_operation operation) {
  const auto mesh = corefined(mesh_of<Kernel>(solids[0]), mesh_of<Kernel>(solids[1]), operation);
  std::vector<typename Kernel::Point_3> points;
  Polygons polygons;
  PMP::polygon_mesh_to_polygon_soup(mesh, points, polygons);
  return soup_of<Kernel>(points, polygons);
}

Polygon_soup by_nef(const std::array<Polygon_soup, 2>& solids, Set_operation operation) {
  using Kernel = CGAL::Epeck;
  using Nef = CGAL::Nef_polyhedron_3<Kernel>;
  auto first = mesh_of<Kernel>(solids[0]), second = mesh_of<Kernel>(solids[1]);
  const Nef a(first), b(second);
  const Nef result = operation == Set_operation::unite       ? a.join(b)
                     : operation == Set_operation::intersect ? a.intersection(b)
                     : operation == Set_operation::subtract  ? a.difference(b)
                                                             : a.symmetric_difference(b);
  std::vector<Kernel::Point_3> points;
  Polygons polygons;
  CGAL::convert_nef_polyhedron_to_polygon_soup(result.regularization(), points, polygons, true);
  return soup_of<Kernel>(points, polygons);
}

void solve(const adapter::Task& task) {
  const std::string method = task.more.empty() ? "epeck" : task.more[0];
  const std::array<Polygon_soup, 2> solids = judge::solids_of(task.soup, task.query.first);
  std::ofstream out(task.answer);
  try {
    write_qoff(method == "nef"     ? by_nef(solids, task.query.operation)
               : method == "epick" ? by_corefinement<CGAL::Epick>(solids, task.query.operation)
                                   : by_corefinement<CGAL::Epeck>(solids, task.query.operation),
               out);
  } catch (const Declined&) {
    out << "abstained\n";
  }
  if (!out.flush()) throw std::runtime_error(task.answer + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) { return adapter::main(argc, argv, sightline::judge::Question::boolean, solve); }
