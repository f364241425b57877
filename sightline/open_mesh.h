#pragma once
// Models from OpenMesh's meshes and back.

#include <sightline/sightline.h>

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace sightline {

/// A mesh's faces by their numbers; those marked as deleted keep theirs and have no corners. Errors: std::domain_error
/// for a coordinate that is no number. Exact: yes
template <class Mesh>
Polygon_soup soup_of_open_mesh(const Mesh& mesh) {
  Polygon_soup soup;
  for (std::size_t i = 0; i < mesh.n_vertices(); ++i) {
    const auto& p = mesh.point(typename Mesh::VertexHandle(static_cast<int>(i)));
    soup.add_point(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
  }
  for (std::size_t i = 0; i < mesh.n_faces(); ++i) {
    const typename Mesh::FaceHandle face(static_cast<int>(i));
    std::vector<Point_id> corners;
    if (!mesh.has_face_status() || !mesh.status(face).deleted())
      for (const auto v : mesh.fv_range(face)) corners.push_back(static_cast<Point_id>(v.idx()));
    soup.add_face(corners);
  }
  return soup;
}

/// Adds the parts of a model to a mesh, coordinates rounded to its scalars. Returns, for each part in order, its face
/// in the mesh; an invalid handle where OpenMesh refused it, and says so on standard error: an edge of three parts,
/// say, fits no mesh. Errors, with nothing added: std::overflow_error for a coordinate beyond the mesh's scalars;
/// std::invalid_argument for a part of more than three corners where the mesh is of triangles.
template <class Mesh>
std::vector<typename Mesh::FaceHandle> add_to_open_mesh(const Model& model, Mesh& mesh) {
  using Scalar = typename Mesh::Point::value_type;
  const auto rounded = [](const Rational& x) { return static_cast<Scalar>(nearest_double(x)); };
  for (const Part& part : model.parts()) {
    if (Mesh::is_trimesh() && part.corners.size() > 3)
      throw std::invalid_argument("a part of face " + std::to_string(part.face) + " has " +
                                  std::to_string(part.corners.size()) +
                                  " corners; take a mesh of polygons, or a model of triangles");
    for (const Exact_point& p : part.corners)
      for (const Rational& x : p)
        if (!std::isfinite(rounded(x)))
          throw std::overflow_error("face " + std::to_string(part.face) +
                                    " has a coordinate beyond the mesh's numbers; take wider ones, or a smaller unit");
  }
  std::map<Exact_point, typename Mesh::VertexHandle> at;
  std::vector<typename Mesh::FaceHandle> result;
  for (const Part& part : model.parts()) {
    std::vector<typename Mesh::VertexHandle> corners;
    for (const Exact_point& p : part.corners) {
      const auto [place, is_new] = at.try_emplace(p);
      if (is_new) {
        place->second = mesh.add_vertex({rounded(p[0]), rounded(p[1]), rounded(p[2])});
      }
      corners.push_back(place->second);
    }
    result.push_back(mesh.add_face(corners));
  }
  return result;
}

}  // namespace sightline
