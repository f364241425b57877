// An adapter for `sightline judge`: set operations by Manifold, in doubles. Surfaces that it takes for no manifold are
// left open.

#include "adapter.h"

#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/io/off.h>

#include <manifold/manifold.h>

#include <numeric>

namespace {

using namespace sightline;

/// What Manifold declines to answer.
struct Declined {};

manifold::Manifold manifold_of(const Polygon_soup& solid) {
  manifold::MeshGL64 mesh;
  mesh.numProp = 3;
  for (Point_id p = 0; p < solid.point_count(); ++p)
    for (const Rational& x : solid.point(p)) mesh.vertProperties.push_back(nearest_double(x));
  for (Face_id face = 0; face < solid.face_count(); ++face)
    for (const std::vector<Point_id>& triangle : triangles_of(solid, face))
      mesh.triVerts.insert(mesh.triVerts.end(), triangle.begin(), triangle.end());
  manifold::Manifold made(mesh);
  if (made.Status() != manifold::Manifold::Error::NoError) throw Declined();
  return made;
}

manifold::Manifold combined(const manifold::Manifold& a, const manifold::Manifold& b, Set_operation operation) {
  switch (operation) {
    case Set_operation::unite: return a + b;
    case Set_operation::intersect: return a ^ b;
    case Set_operation::subtract: return a - b;
    case Set_operation::differ: break;
  }
  return (a - b) + (b - a);
}

Polygon_soup soup_of(const manifold::Manifold& solid) {
  if (solid.Status() != manifold::Manifold::Error::NoError) throw Declined();
  const manifold::MeshGL64 mesh = solid.GetMeshGL64();
  Polygon_soup soup;
  const std::size_t count = mesh.vertProperties.size() / mesh.numProp;
  for (std::size_t p = 0; p < count; ++p) {
    const double* at = &mesh.vertProperties[p * mesh.numProp];
    soup.add_point(at[0], at[1], at[2]);
  }
  std::vector<Point_id> point(count);  // points that stand apart for their properties alone are one
  std::iota(point.begin(), point.end(), Point_id{0});
  for (std::size_t k = 0; k < mesh.mergeFromVert.size(); ++k)
    point[mesh.mergeFromVert[k]] = static_cast<Point_id>(mesh.mergeToVert[k]);
  for (std::size_t t = 0; t < mesh.triVerts.size(); t += 3)
    soup.add_face({point[mesh.triVerts[t]], point[mesh.triVerts[t + 1]], point[mesh.triVerts[t + 2]]});
  return soup;
}

void solve(const adapter::Task& task) {
  const std::array<Polygon_soup, 2> solids = judge::solids_of(task.soup, task.query.first);
  std::ofstream out(task.answer);
  try {
    write_qoff(soup_of(combined(manifold_of(solids[0]), manifold_of(solids[1]), task.query.operation)), out);
  } catch (const Declined&) {
    out << "abstained\n";
  }
  if (!out.flush()) throw std::runtime_error(task.answer + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) { return adapter::main(argc, argv, sightline::judge::Question::boolean, solve); }
