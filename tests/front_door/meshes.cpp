// Models from CGAL's and OpenMesh's meshes, and back.

#include <sightline/open_mesh.h>
#include <sightline/surface_mesh.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace sightline;

/// A tetrahedron of that kernel, one corner at a third where it is exact.
template <class Mesh, class Kernel>
Mesh tetrahedron(const typename Kernel::FT& third) {
  using Point = typename Kernel::Point_3;
  Mesh mesh;
  CGAL::make_tetrahedron(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(third, third, 1), mesh);
  return mesh;
}

TEST(Meshes, surface_mesh_goes_in_exactly_and_comes_back) {
  using Kernel = CGAL::Epeck;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  const auto mesh = tetrahedron<Mesh, Kernel>(Kernel::FT(1) / 3);
  const Model model(soup_of(mesh));
  EXPECT_EQ(model.face_count(), 4u);
  EXPECT_TRUE(model.left_out().empty());
  bool third = false;
  for (Point_id p = 0; p < 4; ++p) third |= model.soup().point(p)[0] == Rational(1, 3);
  EXPECT_TRUE(third);
  EXPECT_EQ(see(model, {Rational(1, 5), Rational(1, 5), -5}).visible.size(), 1u);
  Mesh back;
  for (const auto face : add_to_mesh(model, back)) EXPECT_NE(face, Mesh::null_face());
  EXPECT_EQ(back.number_of_vertices(), 4u);
  EXPECT_TRUE(CGAL::is_closed(back));
  EXPECT_EQ(Model(soup_of(back)).area(0), model.area(0));
}

TEST(Meshes, any_face_graph_goes_in) {
  using Kernel = CGAL::Simple_cartesian<double>;
  const auto mesh = tetrahedron<CGAL::Polyhedron_3<Kernel>, Kernel>(0.25);
  EXPECT_EQ(Model(soup_of(mesh)).facts().parts, 4u);
}

TEST(Meshes, what_is_no_mesh_is_refused_face_by_face) {
  const std::vector<std::array<double, 3>> points{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  const std::vector<std::array<std::uint32_t, 3>> fan{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};  // an edge of three
  const Model model = Model::of_triangles(points, fan);
  using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
  Mesh mesh;
  const auto faces = add_to_mesh(model, mesh);
  EXPECT_NE(faces[1], Mesh::null_face());
  EXPECT_EQ(faces[2], Mesh::null_face());
}

TEST(Meshes, open_mesh_goes_in_and_comes_back) {
  OpenMesh::PolyMesh_ArrayKernelT<> mesh;
  const std::vector<std::array<double, 3>> points{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 1}};
  const std::vector<std::uint32_t> corners{0, 3, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
  const Model pyramid = Model::of_polygons(points, corners, std::vector<std::uint32_t>{4, 3, 3, 3, 3});
  for (const auto face : add_to_open_mesh(pyramid, mesh)) EXPECT_TRUE(face.is_valid());
  EXPECT_EQ(mesh.n_vertices(), 5u);
  const Model again(soup_of_open_mesh(mesh));
  ASSERT_EQ(again.face_count(), 5u);
  for (Face_id face = 0; face < 5; ++face) EXPECT_EQ(again.area(face), pyramid.area(face));
  EXPECT_EQ(see(again, {1, 1, 5}).visible.size(), 4u);
}

TEST(Meshes, of_triangles_take_triangles_only) {
  // OpenMesh would cut a square, and tell of one of its triangles.
  const std::vector<std::array<double, 3>> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<std::uint32_t> corners{0, 1, 2, 0, 1, 2, 3}, sizes{3, 4};
  OpenMesh::TriMesh_ArrayKernelT<> mesh;
  EXPECT_THROW(add_to_open_mesh(Model::of_polygons(points, corners, sizes), mesh), std::invalid_argument);
  EXPECT_EQ(mesh.n_vertices(), 0u);
  const std::vector<std::array<std::uint32_t, 3>> halves{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(add_to_open_mesh(Model::of_triangles(points, halves), mesh).size(), 2u);
  EXPECT_EQ(mesh.n_faces(), 2u);
}

TEST(Meshes, take_no_coordinate_beyond_their_numbers) {
  const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 1, 2}};
  const Model wide =
      Model::of_triangles(std::vector<std::array<double, 3>>{{0, 0, 0}, {1e300, 0, 0}, {0, 1, 0}}, triangle);
  OpenMesh::PolyMesh_ArrayKernelT<> floats;
  EXPECT_THROW(add_to_open_mesh(wide, floats), std::overflow_error);
  EXPECT_EQ(floats.n_vertices(), 0u);
  Polygon_soup soup;
  soup.add_point(0, 0, 0);
  soup.add_point(times_power(Rational(1), 2000), 0, 0);
  soup.add_point(0, 1, 0);
  soup.add_face({0, 1, 2});
  const Model wider(soup);
  CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> doubles;
  add_to_mesh(wide, doubles);
  EXPECT_EQ(doubles.number_of_vertices(), 3u);
  EXPECT_THROW(add_to_mesh(wider, doubles), std::overflow_error);
  EXPECT_EQ(doubles.number_of_vertices(), 3u);
  CGAL::Surface_mesh<CGAL::Epeck::Point_3> exact_numbers;
  add_to_mesh(wider, exact_numbers);
  EXPECT_EQ(exact_numbers.number_of_faces(), 1u);
}

TEST(Meshes, name_the_vertex_whose_coordinate_is_no_number) {
  using Kernel = CGAL::Simple_cartesian<double>;
  auto mesh = tetrahedron<CGAL::Surface_mesh<Kernel::Point_3>, Kernel>(0.25);
  mesh.point(CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index(2)) = Kernel::Point_3(0, std::nan(""), 0);
  try {
    soup_of(mesh);
    FAIL();
  } catch (const std::domain_error& error) {
    EXPECT_EQ(std::string(error.what()), "vertex 2 of the mesh, from 0: not a finite number");
  }
}

}  // namespace
