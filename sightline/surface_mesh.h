#pragma once
// Models from CGAL's meshes and back: Surface_mesh, Polyhedron_3 and every other FaceGraph.

#include <sightline/kernel/traits/point_traits.h>
#include <sightline/sightline.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

namespace sightline {

/// A mesh's faces in the order of faces(mesh), coordinates taken for the numbers that they are. Removed faces are none.
/// Errors: std::domain_error, which names the vertex by its place in vertices(mesh), for a coordinate that is no
/// number. Exact: yes
template <class Face_graph_model, class Point_map>
Polygon_soup soup_of(const Face_graph_model& mesh, const Point_map& points) {
  using Point = typename boost::property_traits<Point_map>::value_type;
  using number = Field_number<typename CGAL::Kernel_traits<Point>::Kernel::FT>;
  using Descriptor = typename boost::graph_traits<Face_graph_model>::vertex_descriptor;
  Polygon_soup soup;
  std::unordered_map<Descriptor, Point_id> ids;
  for (const Descriptor v : vertices(mesh)) {
    const Point& p = get(points, v);
    try {
      ids.emplace(v, soup.add_point(number::to(p.x()), number::to(p.y()), number::to(p.z())));
    } catch (const std::domain_error& error) {
      throw std::domain_error("vertex " + std::to_string(ids.size()) + " of the mesh, from 0: " + error.what());
    }
  }
  for (const auto face : faces(mesh)) {
    std::vector<Point_id> corners;
    for (const Descriptor v : CGAL::vertices_around_face(halfedge(face, mesh), mesh)) corners.push_back(ids.at(v));
    soup.add_face(corners);
  }
  return soup;
}
template <class Face_graph_model>
Polygon_soup soup_of(const Face_graph_model& mesh) {
  return soup_of(mesh, get(CGAL::vertex_point, mesh));
}

/// Adds the parts of a model to a mesh, coordinates rounded as its kernel rounds them. Returns, for each part in order,
/// its face in the mesh, or null_face() where the mesh refused it: an edge of three parts, say, fits no mesh. Errors,
/// with nothing added: std::overflow_error for a coordinate beyond the kernel's numbers.
template <class Mesh>
std::vector<typename boost::graph_traits<Mesh>::face_descriptor> add_to_mesh(const Model& model, Mesh& mesh) {
  using Point =
      typename boost::property_traits<typename boost::property_map<Mesh, CGAL::vertex_point_t>::type>::value_type;
  using number = Field_number<typename CGAL::Kernel_traits<Point>::Kernel::FT>;
  using Descriptor = typename boost::graph_traits<Mesh>::vertex_descriptor;
  if constexpr (std::is_floating_point_v<typename CGAL::Kernel_traits<Point>::Kernel::FT>)
    for (const Part& part : model.parts())
      for (const Exact_point& p : part.corners)
        for (const Rational& x : p)
          if (!std::isfinite(number::from(x)))
            throw std::overflow_error(
                "face " + std::to_string(part.face) +
                " has a coordinate beyond the mesh's numbers; take wider ones, or a smaller unit");
  std::vector<typename boost::graph_traits<Mesh>::face_descriptor> result;
  std::map<Exact_point, Descriptor> at;
  for (const Part& part : model.parts()) {
    std::vector<Descriptor> corners;
    for (const Exact_point& p : part.corners) {
      const auto [place, is_new] = at.try_emplace(p, Descriptor());
      if (is_new) {
        place->second = add_vertex(mesh);
        put(CGAL::vertex_point, mesh, place->second, Point(number::from(p[0]), number::from(p[1]), number::from(p[2])));
      }
      corners.push_back(place->second);
    }
    result.push_back(CGAL::Euler::add_face(corners, mesh));
  }
  return result;
}

}  // namespace sightline
