// Whether faces bound a solid.

#include "soup.h"

#include <sightline/kernel/scene/closed.h>

using namespace kernel_test;

namespace {
bool closed(const Polygon_soup& soup) {
  const Closure result = closure(Scene(soup));
  // The oracle: the boundary chain, in rationals.
  const Scene scene(soup);
  Chain chain;
  for (const Piece& piece : scene.pieces()) chain.add(scene.corner_points(piece));
  for (const Set_aside& entry : scene.set_aside()) {  // as the file has them
    if (entry.reason != Set_aside_reason::duplicate) continue;
    std::vector<Exact_point> loop;
    for (const Point_id p : soup.loop(entry.face)) loop.push_back(soup.point(p));
    chain.add(loop);
  }
  EXPECT_EQ(result.closed, chain.empty());
  return result.closed;
}
}  // namespace

TEST(Closure, a_cube_is_closed_and_has_twelve_lines) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 2);
  EXPECT_TRUE(closed(soup));
  EXPECT_EQ(closure(Scene(soup)).lines, 12u);
}
TEST(Closure, an_empty_scene_is_closed) { EXPECT_TRUE(closed(Polygon_soup())); }
TEST(Closure, an_open_box_is_not_closed) {
  for (int without = 0; without < 6; ++without) {
    Polygon_soup soup;
    add_cube(soup, 0, 0, 0, 2, without);
    EXPECT_FALSE(closed(soup));
  }
}
TEST(Closure, a_single_face_is_not_closed_but_with_its_back_it_is) {
  Polygon_soup soup = soup_of({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  soup.add_face({0, 1, 2, 3});
  EXPECT_FALSE(closed(soup));
  soup.add_face({3, 2, 1, 0});
  EXPECT_TRUE(closed(soup));
}
TEST(Closure, a_doubled_face_opens_also_where_it_is_set_aside_as_a_duplicate) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 2);
  soup.add_face({4, 5, 7, 6});
  const Scene scene(soup);
  EXPECT_EQ(scene.set_aside().size(), 1u);
  EXPECT_FALSE(closed(soup));
  Polygon_soup halves;
  add_cube(halves, 0, 0, 0, 2);
  halves.add_face({4, 5, 7});
  halves.add_face({4, 7, 6});
  EXPECT_FALSE(closed(halves));
}
TEST(Closure, all_faces_doubled_or_tripled_close_as_they_do_once) {
  Polygon_soup soup;
  for (int times = 1; times <= 3; ++times) {
    add_cube(soup, 0, 0, 0, 2);
    EXPECT_TRUE(closed(soup));
    EXPECT_EQ(times_given(Scene(soup)), std::vector<int>(6, times));
  }
}
TEST(Closure, nested_solids_may_share_a_face) {
  // A cube of 2 on the floor, and a tower of height 6 over the same square, each with its own floor: one is a
  // duplicate.
  const auto with_tower = [](bool shared) {
    Polygon_soup soup;
    add_cube(soup, 0, 0, 0, 2);
    const Polygon_soup cube = soup;
    Polygon_soup both = soup;
    std::vector<Point_id> tall;
    for (Point_id p = 0; p < cube.point_count(); ++p) {
      const Exact_point q = cube.point(p);
      tall.push_back(both.add_point(q[0], q[1], Rational(3 * q[2])));
    }
    for (Face_id f = 0; f < cube.face_count(); ++f) {
      std::vector<Point_id> loop;
      bool floor = true;
      for (const Point_id p : cube.loop(f)) {
        loop.push_back(tall[p]);
        floor = floor && cube.point(p)[2] == 0;
      }
      if (!floor || shared) both.add_face(loop);
    }
    return both;
  };
  EXPECT_TRUE(closed(with_tower(true)));
  const Scene scene(with_tower(true));
  EXPECT_EQ(scene.set_aside().size(), 1u);
  EXPECT_FALSE(closed(with_tower(false))) << "one floor for two";
}
TEST(Closure, a_turned_face_opens) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 2, 5);
  soup.add_face({6, 7, 5, 4});
  EXPECT_FALSE(closed(soup));
}
TEST(Closure, T_junctions_do_not_open) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 4, 5);
  const Point_id a = soup.add_point(Rational(1), Rational(0), Rational(4)),
                 b = soup.add_point(Rational(3), Rational(4), Rational(4)),
                 c = soup.add_point(Rational(2), Rational(2), Rational(4));
  soup.add_face({4, a, c, b, 6});  // the top in two, joined along a bent line; its neighbours know nothing of a and b
  soup.add_face({a, 5, 7, b, c});
  EXPECT_TRUE(closed(soup));
  const Scene scene(soup);
  EXPECT_EQ(scene.set_aside().size(), 0u);
}
TEST(Closure, a_hole_in_a_wall_opens_and_a_window_pane_closes_it) {
  for (const bool pane : {false, true}) {
    Polygon_soup soup;
    add_cube(soup, 0, 0, 0, 8, 5);
    std::vector<Point_id> hole;
    for (const auto& [x, y] : {std::pair{2, 2}, {4, 2}, {4, 4}, {2, 4}})
      hole.push_back(soup.add_point(Rational(x), Rational(y), Rational(8)));
    soup.add_face({4, 5, 7, 6});
    soup.add_hole(hole);
    if (pane) soup.add_face(hole);
    EXPECT_EQ(closed(soup), pane);
  }
}
TEST(Closure, two_cubes_are_closed_apart_touching_at_a_face_at_an_edge_and_through_one_another) {
  for (const auto& [x, y, z] :
       {std::array<long, 3>{9, 0, 0}, {4, 0, 0}, {4, 1, 1}, {4, 4, 0}, {4, 4, 4}, {1, 1, 1}, {2, 0, 0}}) {
    Polygon_soup soup;
    add_cube(soup, 0, 0, 0, 4);
    add_cube(soup, x, y, z, 4);
    EXPECT_TRUE(closed(soup)) << x << ' ' << y << ' ' << z;
  }
}
TEST(Closure, a_non_planar_wall_closes_where_its_triangles_do) {
  // A cube with one corner lifted: three walls are not planar any more.
  Polygon_soup soup = soup_of({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}, {0, 0, 4}, {4, 0, 4}, {0, 4, 4}, {5, 6, 7}});
  static const Point_id faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& f : faces) soup.add_face({f[0], f[1], f[2], f[3]});
  const Scene scene(soup);
  EXPECT_EQ(scene.counters().non_planar, 3u);
  EXPECT_TRUE(closed(soup));
}
