// Models from CGAL's and OpenMesh's meshes, and back.

#include <sightline/open_mesh.h>
#include <sightline/surface_mesh.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <gtest/gtest.h>

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
  EXPECT_EQ(Model(soup_of(mesh)).parts().size(), 4u);
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

}  // namespace
