// The face graph: nodes, edges, components, and which of these are convex bodies.

#include "soup.h"

#include <sightline/harness/generate/scenes.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/harness/generate/shapes.h>

using namespace kernel_test;

namespace {

using Corners = std::vector<std::array<double, 3>>;

/// Faces of numbered points.
Polygon_soup polyhedron(const Corners& points, const std::vector<std::vector<Point_id>>& faces) {
  Polygon_soup soup;
  for (const auto& p : points) soup.add_point(p[0], p[1], p[2]);
  for (const auto& face : faces) soup.add_face(face);
  return soup;
}

/// Every point of the body's component behind all its planes: convex by definition, in rationals; and the point inside
/// strictly so.
void expect_convex(const Scene& scene, const Face_graph& graph, std::uint32_t component) {
  const Face_graph::Component& c = graph.components()[component];
  ASSERT_TRUE(c.inside.has_value());
  for (std::uint32_t node = 0; node < graph.size(); ++node) {
    if (graph.component(node) != component) continue;
    const auto h = scene.file_coefficients(graph.plane(node));
    const auto height = [&](const Exact_point& p) {
      return sgn(Rational(h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3]));
    };
    EXPECT_LT(height(*c.inside), 0);
    for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
      if (graph.component(graph.node(i)) != component) continue;
      for (const Piece_corner& corner : scene.corners(scene.pieces()[i]))
        EXPECT_LE(height(scene.position(corner.point)), 0);
    }
  }
}

/// A bipyramid over a pentagram whose first face has the ray from inside run through an edge of the other winding.
Polygon_soup pentagram(const Rational& scale, const Exact_point& offset) {
  Polygon_soup soup;
  for (const auto& p : std::vector<std::array<long, 3>>{
           {1, -4, 0}, {1, 4, 0}, {-3, -2, 0}, {4, 0, 0}, {-3, 2, 0}, {0, 0, 3}, {0, 0, -30}})
    soup.add_point(Rational(scale * p[0] + offset[0]), Rational(scale * p[1] + offset[1]),
                   Rational(scale * p[2] + offset[2]));
  for (Point_id k = 0; k < 5; ++k) {
    soup.add_face(std::vector<Point_id>{k, (k + 1) % 5, 5});
    soup.add_face(std::vector<Point_id>{(k + 1) % 5, k, 6});
  }
  return soup;
}

}  // namespace

TEST(Face_graph, a_cube_has_six_nodes_and_twelve_edges) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 2);
  const Scene scene(soup);
  const Face_graph graph(scene);
  EXPECT_EQ(graph.size(), 6u);
  EXPECT_EQ(graph.edges().size(), 12u);
  ASSERT_EQ(graph.components().size(), 1u);
  EXPECT_TRUE(graph.components()[0].closed);
  EXPECT_EQ(graph.components()[0].nodes, 6u);
  EXPECT_EQ(graph.refused(), 0u);
  expect_convex(scene, graph, 0);
  for (std::uint32_t node = 0; node < 6; ++node) {
    EXPECT_EQ(graph.edges_of(node).size(), 4u);
    for (const std::uint32_t e : graph.edges_of(node)) {
      EXPECT_NE(graph.across(e, node), node);
      EXPECT_EQ(graph.across(e, graph.across(e, node)), node);
    }
  }
  // Each edge runs counterclockwise round its first node.
  for (const Face_graph::Edge& edge : graph.edges()) {
    const auto corners = scene.corners(scene.pieces()[graph.piece(edge.first)]);
    bool found = false;
    for (std::size_t k = 0; k < corners.size(); ++k)
      found |= corners[k].point == edge.from && corners[(k + 1) % corners.size()].point == edge.to;
    EXPECT_TRUE(found);
  }
}

TEST(Face_graph, triangles_of_one_plane_are_one_node) {
  const Corners points{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};
  const Scene scene(polyhedron(points, {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
  const Face_graph graph(scene);
  EXPECT_EQ(graph.size(), 5u);
  EXPECT_EQ(graph.edges().size(), 8u);
  EXPECT_EQ(graph.node(0), graph.node(1));
  EXPECT_EQ(graph.components()[0].pieces, 6u);
  expect_convex(scene, graph, 0);
}

TEST(Face_graph, a_body_turned_inside_out_is_not_convex) {
  const Corners points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const Scene right(polyhedron(points, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})),
      turned(polyhedron(points, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}));
  const Face_graph out(right), in(turned);
  EXPECT_TRUE(out.is_convex(0));
  EXPECT_TRUE(in.components()[0].closed);
  EXPECT_FALSE(in.is_convex(0));
}

TEST(Face_graph, a_dent_however_small_is_not_convex) {
  // A pyramid's apex over the upper square of a box: above it, in its plane, below it, by one step of the last bit.
  const double step = 0x1p-52;
  for (const double height : {1 + step, 1.0, 1 - step}) {
    const Corners points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},         {0, 0, 1},
                         {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, height}};
    const Scene scene(polyhedron(points, {{0, 3, 2, 1},
                                          {0, 1, 5, 4},
                                          {1, 2, 6, 5},
                                          {2, 3, 7, 6},
                                          {3, 0, 4, 7},
                                          {4, 5, 8},
                                          {5, 6, 8},
                                          {6, 7, 8},
                                          {7, 4, 8}}));
    const Face_graph graph(scene);
    EXPECT_EQ(graph.is_convex(0), height >= 1);
    EXPECT_EQ(graph.size(), height == 1 ? 6u : 9u);
    if (height >= 1) expect_convex(scene, graph, 0);
  }
}

TEST(Face_graph, a_surface_wound_twice_round_is_bent_outwards_everywhere_and_still_not_convex) {
  // A bipyramid over a pentagram.
  Corners points;
  for (std::size_t k = 0; k < 5; ++k)
    points.push_back(
        std::array<std::array<double, 3>, 5>{{{4, 0, 0}, {1, 4, 0}, {-3, 2, 0}, {-3, -2, 0}, {1, -4, 0}}}[2 * k % 5]);
  points.push_back({0, 0, 3});
  points.push_back({0, 0, -3});
  std::vector<std::vector<Point_id>> faces;
  for (Point_id k = 0; k < 5; ++k) {
    faces.push_back({k, (k + 1) % 5, 5});
    faces.push_back({(k + 1) % 5, k, 6});
  }
  const Scene scene(polyhedron(points, faces));
  const Face_graph graph(scene);
  EXPECT_EQ(graph.components().size(), 1u);
  EXPECT_TRUE(graph.components()[0].closed);
  EXPECT_FALSE(graph.is_convex(0));
}

TEST(Face_graph, an_open_box_is_not_closed_and_not_convex) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 2, 3);
  const Scene scene(soup);
  const Face_graph graph(scene);
  EXPECT_EQ(graph.size(), 5u);
  EXPECT_EQ(graph.edges().size(), 8u);
  EXPECT_FALSE(graph.components()[0].closed);
  EXPECT_FALSE(graph.is_convex(0));
}

TEST(Face_graph, two_bodies_are_two_components) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 2);
  add_cube(soup, 5, 0, 0, 2);
  const Scene scene(soup);
  const Face_graph graph(scene);
  ASSERT_EQ(graph.components().size(), 2u);
  EXPECT_EQ(graph.size(), 12u);
  expect_convex(scene, graph, 0);
  expect_convex(scene, graph, 1);
}

TEST(Face_graph, joins_what_is_a_manifold_and_leaves_the_rest_apart) {
  // Three triangles on one edge: the third is refused. Two that run along it the same way: the second is.
  const Corners points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, -1}};
  const Scene three(polyhedron(points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  const Face_graph graph(three);
  EXPECT_EQ(graph.size(), 3u);
  EXPECT_EQ(graph.edges().size(), 1u);
  EXPECT_EQ(graph.refused(), 1u);
  EXPECT_EQ(graph.components().size(), 2u);
  const Scene same(polyhedron(points, {{0, 1, 2}, {0, 1, 3}}));
  const Face_graph graph_of_same(same);
  EXPECT_EQ(graph_of_same.edges().size(), 0u);
  EXPECT_EQ(graph_of_same.refused(), 1u);
}

TEST(Face_graph, a_sheet_and_its_back_are_two_nodes_and_no_body) {
  Polygon_soup soup = soup_of({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  soup.add_face({0, 1, 2, 3});
  soup.add_face({3, 2, 1, 0});
  const Scene scene(soup);
  const Face_graph graph(scene);
  EXPECT_EQ(graph.size(), 2u);
  EXPECT_EQ(graph.edges().size(), 4u);
  EXPECT_TRUE(graph.components()[0].closed);
  EXPECT_FALSE(graph.is_convex(0));
}

TEST(Face_graph, an_empty_scene_has_an_empty_graph) {
  const Scene scene{Polygon_soup()};
  const Face_graph graph(scene);
  EXPECT_EQ(graph.size(), 0u);
  EXPECT_TRUE(graph.components().empty());
}

TEST(Face_graph, holds_far_away_and_scaled) {
  for (const auto& [scale, offset] :
       std::vector<std::pair<double, double>>{{1, 1e8}, {1e-50, 0}, {1e-310, 0}, {1e300, 0}, {1e-30, 1}}) {
    const Polygon_soup sphere = generate::convex_sphere(48);
    Polygon_soup soup;
    const Rational s = exact(scale), o = exact(offset);
    for (Point_id p = 0; p < sphere.point_count(); ++p) {
      const Exact_point at = sphere.point(p);
      soup.add_point(at[0] * s + o, at[1] * s + o, at[2] * s + o);
    }
    for (Face_id f = 0; f < sphere.face_count(); ++f) soup.add_face(sphere.loop(f));
    const Scene scene(soup);
    const Face_graph graph(scene);
    ASSERT_EQ(graph.size(), sphere.face_count());
    expect_convex(scene, graph, 0);
  }
}

TEST(Face_graph, the_boxes_of_a_city_are_convex_and_its_ground_is_not) {
  for (const char* kind : {"city", "city_rotated"}) {
    const Scene scene(generate::make(kind, 15, 1));
    const Face_graph graph(scene);
    std::size_t convex = 0;
    for (std::uint32_t c = 0; c < graph.components().size(); ++c)
      if (graph.components()[c].inside) {
        ++convex;
        expect_convex(scene, graph, c);
      }
    std::size_t closed = 0;
    for (const auto& component : graph.components()) closed += component.closed;
    EXPECT_EQ(convex, closed) << kind;
  }
}

TEST(Face_graph, a_ray_through_an_edge_meets_the_pieces_there) {
  for (const Rational& scale : {Rational(1), Rational(1, 3), Rational(7, 1'000'003)}) {
    const Scene scene(pentagram(scale, {0, 0, 0}));
    const Face_graph graph(scene);
    ASSERT_EQ(graph.components().size(), 1u);
    EXPECT_TRUE(graph.components()[0].closed);
    EXPECT_FALSE(graph.is_convex(0));
  }
}

TEST(Face_graph, tells_small_bodies_in_large_scenes) {
  for (const int exponent : {-3, -6, -9, -10, -11, -12, -15}) {
    const Rational scale = exact_decimal(1, exponent) / 3;
    for (int k = 1; k < 20; ++k) {
      const Exact_point offset{Rational(k) / 7, Rational(-2 * k) / 3, Rational(3 * k) / 11};
      for (const bool wound_twice : {false, true}) {
        const Polygon_soup sphere = generate::convex_sphere(48);
        Polygon_soup soup = wound_twice ? pentagram(scale, offset) : Polygon_soup();
        if (!wound_twice) {
          for (Point_id p = 0; p < sphere.point_count(); ++p) {
            const Exact_point at = sphere.point(p);
            soup.add_point(Rational(at[0] * scale + offset[0]), Rational(at[1] * scale + offset[1]),
                           Rational(at[2] * scale + offset[2]));
          }
          for (Face_id f = 0; f < sphere.face_count(); ++f) soup.add_face(sphere.loop(f));
        }
        const Point_id first = soup.point_count();
        soup.add_point(Rational(1'000'000), Rational(0), Rational(0));
        soup.add_point(Rational(0), Rational(1'000'000), Rational(0));
        soup.add_point(Rational(0), Rational(0), Rational(-1'000'000));
        soup.add_face(std::vector<Point_id>{first, first + 1, first + 2});
        const Scene scene(soup);
        const Face_graph graph(scene);
        EXPECT_EQ(graph.is_convex(graph.node(0)), !wound_twice) << exponent;
      }
    }
  }
}
