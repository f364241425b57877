#pragma once
// Models from OpenMesh's meshes and back.

#include <sightline/sightline.h>

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include <map>
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
/// say, fits no mesh.
template <class Mesh>
std::vector<typename Mesh::FaceHandle> add_to_open_mesh(const Model& model, Mesh& mesh) {
  using Scalar = typename Mesh::Point::value_type;
  std::map<Exact_point, typename Mesh::VertexHandle> at;
  std::vector<typename Mesh::FaceHandle> result;
  for (const Part& part : model.parts()) {
    std::vector<typename Mesh::VertexHandle> corners;
    for (const Exact_point& p : part.corners) {
      const auto [place, is_new] = at.try_emplace(p);
      if (is_new) {
        const auto scalar = [&](std::size_t k) { return static_cast<Scalar>(nearest_double(p[k])); };
        place->second = mesh.add_vertex({scalar(0), scalar(1), scalar(2)});
      }
      corners.push_back(place->second);
    }
    result.push_back(mesh.add_face(corners));
  }
  return result;
}

}  // namespace sightline
