// Volumes that divide a level, convex regions of cells, and certificates of cells.

#include "support.h"

#include <sightline/algorithms/levels/coarse.h>
#include <sightline/algorithms/levels/volumes.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/generate/transform.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>

namespace sightline {
namespace {

using levels_test::corpus_scene;
using levels_test::expect_passed;

TEST(Level_groups, of_scenes_are_lawful) {
  const std::size_t share = test_scenes::is_sanitized() ? 4 : 1;
  for (const char* file :
       {"general/two_rooms.map", "general/two_rooms.off", "general/cube.off", "general/l_room.off",
        "general/crossing_quads.obj", "robust/duplicates.off", "robust/thirds.qoff", "robust/t_junctions.off"}) {
    SCOPED_TRACE(file);
    const Polygon_soup soup = corpus_scene(file);
    for (std::uint64_t seed = 1; seed <= 4 / share; ++seed)
      for (const char* check : {"volumes", "coarse", "certificates"}) expect_passed(check, soup, seed);
  }
}

/// Boxes, each with points that its faces share.
Polygon_soup boxes_with_own_points(const std::vector<std::array<Exact_point, 2>>& boxes) {
  Polygon_soup soup;
  for (const auto& [low, high] : boxes) {
    const auto first = static_cast<Point_id>(soup.point_count());
    for (const Rational& z : {low[2], high[2]})
      for (const Rational& y : {low[1], high[1]})
        for (const Rational& x : {low[0], high[0]}) soup.add_point(x, y, z);
    for (const auto& [a, b, c, d] : std::initializer_list<std::array<Point_id, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
      soup.add_face({first + a, first + b, first + c, first + d});
  }
  return soup;
}

std::string refusal_of(const Polygon_soup& soup) {
  try {
    volume_division(soup);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(Volumes, are_numbered_by_first_faces) {
  const Polygon_soup rooms = boxes_with_own_points({{{{0, 0, 0}, {2, 1, 1}}}, {{{2, 0, 0}, {3, 1, 1}}}});
  const Volume_division division = volume_division(rooms);
  EXPECT_EQ(division.volumes, 2u);
  Cell_options options;
  options.tree = division.tree;
  const Level_cells level(Polygon_soup{}, options);
  const auto leaf_at = [&](const Exact_point& p) { return level.cells()[level.at(p)].leaf; };
  const Rational half(1, 2);
  EXPECT_EQ(leaf_at({half, half, half}), 0u);
  EXPECT_EQ(leaf_at({2 + half, half, half}), 1u);
  EXPECT_EQ(leaf_at({2 - half / 1000000, half, half}), 0u);
  EXPECT_EQ(leaf_at({2 + half / 1000000, half, half}), 1u);
  EXPECT_EQ(leaf_at({half, half, 1 + half}), 2u);
  EXPECT_EQ(volume_division(Polygon_soup{}).volumes, 0u);
  EXPECT_EQ(volume_division(Polygon_soup{}).tree.root, -1);
}

/// A side of a box with a hole, which another face fills.
TEST(Volumes, may_have_faces_with_holes) {
  Polygon_soup soup = boxes_with_own_points({{{{0, 0, 0}, {4, 4, 4}}}});
  Polygon_soup with_hole;
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    const Exact_point point = soup.point(p);
    with_hole.add_point(point[0], point[1], point[2]);
  }
  const Point_id first = with_hole.add_point(1, 1, 0);
  with_hole.add_point(1, 3, 0);
  with_hole.add_point(3, 3, 0);
  with_hole.add_point(3, 1, 0);
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto loop = soup.loop(f);
    with_hole.add_face(loop);
    if (!std::all_of(loop.begin(), loop.end(), [&](Point_id p) { return soup.point(p)[2] == 0; })) continue;
    with_hole.add_hole({first + 3, first + 2, first + 1, first});
    with_hole.add_face({first, first + 1, first + 2, first + 3});
  }
  ASSERT_EQ(with_hole.face_count(), 7u);
  EXPECT_EQ(refusal_of(with_hole), "");
}

TEST(Volumes, that_overlap_are_told_by_a_face_of_each) {
  const auto box = [](long x, long y, long z, long side) {
    return std::array<Exact_point, 2>{Exact_point{x, y, z}, Exact_point{x + side, y + side, z + side}};
  };
  EXPECT_EQ(refusal_of(boxes_with_own_points({box(0, 0, 0, 2), box(2, 2, 2, 2), box(1, 0, 2, 3), box(0, 2, 0, 2)})),
            "face 6 and face 12 are of volumes that overlap; move one, or cut off what they have in common");
  EXPECT_EQ(refusal_of(boxes_with_own_points({box(0, 0, 0, 2), box(0, 0, 0, 2)})).substr(0, 17), "face 0 and face 6");
  EXPECT_EQ(refusal_of(boxes_with_own_points({box(0, 0, 0, 4), box(1, 1, 1, 1)})).substr(0, 17), "face 0 and face 6");
  EXPECT_EQ(refusal_of(boxes_with_own_points({box(0, 0, 0, 2), box(2, 0, 0, 2), box(0, 2, 1, 2), box(2, 2, 2, 9)})),
            "");
}

/// Two round volumes of many sides, which only few planes part where they are apart at all.
TEST(Volumes, of_many_sides_are_told_apart_in_time_and_a_budget_ends_them) {
  const Polygon_soup ball = generate::convex_sphere(250);
  const auto two_balls = [&](const Rational& way) {
    return generate::joined(
        std::array{ball, generate::mapped(ball, [&](Point_id, const Exact_point& p) {
                     return Exact_point{Rational(p[0] + way), Rational(p[1] + way), Rational(p[2] + way)};
                   })});
  };
  Rational size = 0;
  for (Point_id p = 0; p < ball.point_count(); ++p) size = std::max(size, Rational(2 * ball.point(p)[0]));
  EXPECT_NE(refusal_of(two_balls(size / 2)), "");
  EXPECT_EQ(refusal_of(two_balls(size * Rational(5, 8))), "");
  EXPECT_THROW(volume_division(two_balls(size), [](std::size_t, std::size_t) { throw std::domain_error("over"); }),
               std::domain_error);
}

/// Tetrahedra whose edges pass each other: no side of either parts them.
TEST(Volumes, are_parted_by_planes_along_an_edge_of_each) {
  const auto with_gap = [](long gap) {
    Polygon_soup soup;
    for (const Exact_point& p :
         {Exact_point{-9, 0, 0}, Exact_point{9, 0, 0}, Exact_point{0, -1, -9}, Exact_point{0, 1, -9},
          Exact_point{0, -9, gap}, Exact_point{0, 9, gap}, Exact_point{-1, 0, gap + 9}, Exact_point{1, 0, gap + 9}})
      soup.add_point(p[0], p[1], p[2] + 2 * p[0] + p[1]);  // so that boxes about them overlap
    for (const Point_id first : {0u, 4u})
      for (const auto& [a, b, c] :
           std::initializer_list<std::array<Point_id, 3>>{{0, 1, 2}, {1, 0, 3}, {2, 3, 0}, {3, 2, 1}})
        soup.add_face({first + a, first + b, first + c});
    return soup;
  };
  EXPECT_EQ(refusal_of(with_gap(0)), "");
  EXPECT_EQ(refusal_of(with_gap(1)), "");
  EXPECT_NE(refusal_of(with_gap(-1)), "");
}

/// A box below a slanted side of a tetrahedron; mirrored, the tetrahedron comes first.
TEST(Volumes, are_parted_by_a_side_of_one_alone) {
  for (const long sign : {1, -1}) {
    Polygon_soup soup = boxes_with_own_points({{{{0, 0, 0}, {10, 10, 10}}}});
    for (const Exact_point& p :
         {Exact_point{2, 1, 22}, Exact_point{2, 31, 2}, Exact_point{65, 1, 1}, Exact_point{60, 60, 60}})
      soup.add_point(p[0], p[1], p[2]);
    for (const auto& [a, b, c] :
         std::initializer_list<std::array<Point_id, 3>>{{8, 9, 10}, {9, 8, 11}, {10, 11, 8}, {11, 10, 9}})
      soup.add_face({a, b, c});
    EXPECT_EQ(refusal_of(generate::mapped(
                  soup,
                  [&](Point_id, const Exact_point& p) {
                    return Exact_point{Rational(sign * p[0]), Rational(sign * p[1]), Rational(sign * p[2])};
                  })),
              "");
  }
}

/// The sides at the inner corner of a room first: the room is on both sides of their planes alone.
TEST(Volumes, may_be_bent) {
  Polygon_soup room;
  for (const long z : {0, 1})
    for (const auto& [x, y] : {std::pair(0, 0), {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}) room.add_point(x, y, z);
  for (const Point_id i : {2u, 3u, 0u, 1u, 4u, 5u}) room.add_face({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
  room.add_face({5, 4, 3, 2, 1, 0});
  room.add_face({6, 7, 8, 9, 10, 11});
  const Volume_division division = volume_division(room);
  EXPECT_EQ(division.volumes, 1u);
  const Level_cells level(Polygon_soup{}, {.tree = division.tree});
  const Rational half(1, 2);
  for (const auto& [x, y, is_within] :
       {std::tuple(0, 0, true), {1, 0, true}, {0, 1, true}, {1, 1, false}, {2, 0, false}})
    EXPECT_EQ(level.cells()[level.at({x + half, y + half, half})].leaf, is_within ? 0u : 1u) << x << ", " << y;
  EXPECT_EQ(refusal_of(corpus_scene("general/l_room.off")), "");
  // A box in the inner corner touches it; one that is a little larger overlaps the room.
  EXPECT_EQ(refusal_of(generate::joined(std::array{room, boxes_with_own_points({{{{1, 1, 0}, {2, 2, 1}}}})})), "");
  EXPECT_NE(refusal_of(generate::joined(std::array{room, boxes_with_own_points({{{{half, half, 0}, {2, 2, 1}}}})})),
            "");
}

/// Two boxes with an edge in common that overlap: points on it join them to one component.
TEST(Volumes, that_go_through_themselves_are_told_with_a_face) {
  Polygon_soup soup;
  for (const auto& [x, y] : {std::pair(2, 3), {3, 2}}) {
    const auto first = static_cast<Point_id>(soup.point_count());
    for (const long k : {0, 1, 2, 3, 4, 5, 6, 7}) soup.add_point((k & 1) * x, (k & 2) / 2 * y, (k & 4) / 4);
    const auto id = [&](Point_id p) { return p % 4 == 0 ? p : first + p; };
    for (const auto& [a, b, c, d] : std::initializer_list<std::array<Point_id, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
      soup.add_face({id(a), id(b), id(c), id(d)});
  }
  EXPECT_EQ(refusal_of(soup).substr(0, 66), "face 0 and what shares points with it go through each other; cut t");
}

TEST(Volumes, that_are_none_are_told_with_a_face) {
  const auto without = [](const Polygon_soup& soup, Face_id left_out) {
    Polygon_soup rest;
    for (Point_id p = 0; p < soup.point_count(); ++p)
      rest.add_point(soup.point(p)[0], soup.point(p)[1], soup.point(p)[2]);
    for (Face_id f = 0; f < soup.face_count(); ++f)
      if (f != left_out) rest.add_face(soup.loop(f));
    return rest;
  };
  const Polygon_soup two = boxes_with_own_points({{{{0, 0, 0}, {1, 1, 1}}}, {{{2, 0, 0}, {3, 1, 1}}}});
  EXPECT_EQ(refusal_of(without(two, 8)).substr(0, 52), "face 6 and what shares points with it do not close u");
  const std::string inside = refusal_of(generate::joined(std::array{
      boxes_with_own_points({{{{0, 0, 0}, {9, 9, 9}}}}), boxes_with_own_points({{{{1, 1, 1}, {2, 2, 2}}}})}));
  EXPECT_EQ(inside.substr(0, 17), "face 0 and face 6") << "a hollow is a volume of its own";
  Polygon_soup flat;
  flat.add_point(0, 0, 0);
  flat.add_point(1, 0, 0);
  flat.add_point(0, 1, 0);
  flat.add_face({0, 1, 2});
  flat.add_face({2, 1, 0});
  EXPECT_NE(refusal_of(flat), "");
}

/// The planes of a tree may be the box's own, which leave nothing beyond them.
TEST(Volumes, may_end_where_the_box_does) {
  const Level_cells world{Polygon_soup{}};
  const Exact_point& corner = world.points()[0];
  Cell_options options;
  for (const long sign : {1, -1}) {
    options.tree.nodes = {{{Rational(sign), 0, 0, Rational(-sign * corner[0])}, {-1, -2}}};
    options.tree.root = 0;
    const Level_cells level(Polygon_soup{}, options);
    ASSERT_EQ(level.cells().size(), 1u);
    EXPECT_EQ(level.cells()[0].walls.size(), 6u);
    EXPECT_EQ(level.cells()[0].leaf, sgn(corner[0]) == sign ? 1u : 0u);
  }
}

TEST(Convex_regions, of_boxes_are_put_together_again) {
  const Polygon_soup cube = corpus_scene("general/cube.off");
  const Level_cells one{Polygon_soup{}};
  EXPECT_EQ(convex_regions(one, 1), std::vector<std::uint32_t>{0});
  // Cells beside a box are at best six.
  const Level_cells level(cube);
  const std::vector<std::uint32_t> all = convex_regions(level, 1), none = convex_regions(level, 1000);
  EXPECT_THROW(convex_regions(level, 1, [](std::size_t, std::size_t) { throw std::domain_error("over"); }),
               std::domain_error);
  std::uint32_t regions = 0, solid = 0;
  for (Cell_id c = 0; c < all.size(); ++c) {
    if (level.cells()[c].is_solid) ++solid;
    else regions = std::max(regions, all[c] + 1);
  }
  EXPECT_EQ(solid, 1u);
  EXPECT_EQ(level.counters().covered, 6u);
  EXPECT_EQ(regions, 6u);
  EXPECT_EQ(std::set<std::uint32_t>(none.begin(), none.end()).size(), level.cells().size());
}

/// A plane across z, and one across x on both sides of it, in a box from -5 to 3.
Cell_options quarters(const Rational& z, const Rational& x) {
  Cell_options options;
  options.tree.nodes = {{{0, 0, 1, -z}, {1, 2}}, {{1, 0, 0, -x}, {-1, -2}}, {{1, 0, 0, -x}, {-3, -4}}};
  options.tree.root = 0;
  options.tree.corners = {{-1, -1, -1}, {1, 1, 1}};
  return options;
}

TEST(Convex_regions, are_as_many_as_are_asked_for) {
  const Level_cells level(Polygon_soup{}, quarters(0, 0));
  ASSERT_EQ(level.cells().size(), 4u);
  for (const std::size_t most : {1u, 2u, 3u, 4u}) {
    const std::vector<std::uint32_t> regions = convex_regions(level, most);
    EXPECT_EQ(std::set<std::uint32_t>(regions.begin(), regions.end()).size(), most);
  }
}

TEST(Convex_regions, have_no_face_inside) {
  // The narrow open wall beside the sheet comes last; its front is that of the covered one, or not.
  const Cell_options one_way = quarters(0, {3, 2});
  Cell_options both_ways = one_way;
  both_ways.tree.nodes = {{{1, 0, 0, Rational(-3, 2)}, {1, 2}}, {{0, 0, 1, 0}, {-1, -2}}, {{0, 0, -1, 0}, {-3, -4}}};
  for (const Cell_options& options : {one_way, both_ways})
    for (const bool is_turned : {false, true}) {
      Polygon_soup sheet;
      for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) sheet.add_point(x, y, 0);
      if (is_turned) sheet.add_face({3, 2, 1, 0});
      else sheet.add_face({0, 1, 2, 3});
      const Level_cells level(sheet, options);
      ASSERT_EQ(level.cells().size(), 4u);
      const std::vector<std::uint32_t> regions = convex_regions(level, 1);
      EXPECT_EQ((std::set<std::uint32_t>(regions.begin(), regions.end())), (std::set<std::uint32_t>{0, 1}));
      for (const long z : {1, -1}) EXPECT_EQ(regions[level.at({0, 0, z})], regions[level.at({Rational(7, 4), 0, z})]);
    }
}

TEST(Convex_regions, are_put_together_once_their_neighbours_are) {
  Cell_options options = quarters(-4, 0);  // two flat ones below a large one
  options.tree.nodes[0].children[0] = -5;
  const Level_cells level(Polygon_soup{}, options);
  ASSERT_EQ(level.cells().size(), 3u);
  EXPECT_EQ(convex_regions(level, 1), (std::vector<std::uint32_t>{0, 0, 0}));
}

}  // namespace
}  // namespace sightline
