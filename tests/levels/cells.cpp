// Cells of levels: that they fill the world, where they are solid, and what their walls hold.

#include "support.h"

#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/levels/grid.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace sightline {
namespace {

using levels_test::corpus_scene;
using levels_test::expect_passed;

TEST(Level_cells, of_scenes_fill_the_world) {
  for (const char* file : {"general/two_rooms.map", "general/two_rooms.off", "general/cube.off", "general/l_room.off",
                           "general/crossing_quads.obj", "general/cornell.obj", "robust/duplicates.off",
                           "robust/thirds.qoff", "robust/t_junctions.off", "robust/huge.off"}) {
    SCOPED_TRACE(file);
    const Polygon_soup soup = corpus_scene(file);
    for (std::uint64_t seed = 1; seed <= (test_scenes::is_sanitized() ? 2 : 12); ++seed)
      expect_passed("cells", soup, seed);
  }
}

TEST(Level_cells, of_no_face_are_one) {
  const Level_cells level{Polygon_soup{}};
  ASSERT_EQ(level.cells().size(), 1u);
  EXPECT_TRUE(level.cells()[0].is_outside);
  EXPECT_FALSE(level.cells()[0].is_solid);
  EXPECT_EQ(level.at({0, 0, 0}), 0u);
}

TEST(Level_cells, tell_how_far_their_tree_is_too_and_end_by_what_that_throws) {
  const Polygon_soup soup = corpus_scene("general/two_rooms.off");
  Cell_options options;
  options.threads = 1;
  std::vector<std::array<std::size_t, 2>> told;
  options.progress = [&](std::size_t done, std::size_t all) { told.push_back({done, all}); };
  const Level_cells level(soup, options);
  const std::size_t nodes = level.counters().nodes;
  ASSERT_GT(told.size(), nodes);
  for (std::size_t k = 0; k < told.size(); ++k) {
    const auto [done, all] = told[k];
    EXPECT_EQ(2 * done <= all, k < told.size() - nodes) << "first the tree, then a wall's plane for each node";
  }
  EXPECT_EQ(told.back(), (std::array<std::size_t, 2>{2 * nodes, 2 * nodes}));
  std::size_t calls = 0;
  options.progress = [&](std::size_t, std::size_t) {
    ++calls;
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(Level_cells(soup, options), std::runtime_error);
  EXPECT_EQ(calls, 1u);
  // Of boxes that are given first.
  options.tree = even_boxes(soup, {3, 2, 4});
  std::size_t of_boxes = 0;
  options.progress = [&](std::size_t, std::size_t all) {
    of_boxes = all;
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(Level_cells(soup, options), std::runtime_error);
  EXPECT_EQ(of_boxes, options.tree.nodes.size());
}

TEST(Level_cells, are_within_even_boxes) {
  const Polygon_soup soup = corpus_scene("general/cube.off");  // from 0 to 1
  Cell_options options;
  options.tree = even_boxes(soup, {3, 2, 4});
  const Level_cells level(soup, options);
  const auto leaf_at = [&](const Exact_point& p) { return level.cells()[level.at(p)].leaf; };
  for (std::uint32_t x = 0; x < 3; ++x)
    for (std::uint32_t y = 0; y < 2; ++y)
      for (std::uint32_t z = 0; z < 4; ++z) {
        const Exact_point middle{Rational(2 * x + 1, 6), Rational(2 * y + 1, 4), Rational(2 * z + 1, 8)};
        EXPECT_EQ(leaf_at(middle), x + 3 * (y + 2 * z));
        EXPECT_TRUE(level.cells()[level.at(middle)].is_solid);
      }
  EXPECT_EQ(leaf_at({Rational(-1, 4), Rational(1, 4), Rational(5, 4)}), 0u + 3 * (0 + 2 * 3));  // beyond the rim
  const auto beside = [](long k) { return Rational(k, 3); };
  EXPECT_EQ(leaf_at({beside(1) - Rational(1, 1000000), 0, 0}) % 3, 0u);
  EXPECT_EQ(leaf_at({beside(1) + Rational(1, 1000000), 0, 0}) % 3, 1u);
  EXPECT_EQ(even_boxes(soup, {1, 1, 1}).root, -1);
  EXPECT_EQ(even_boxes(soup, {3, 2, 4}).nodes.size(), 23u);
  // A flat scene is divided within its plane, and not across it.
  Polygon_soup flat;
  for (const auto& [x, y] : {std::pair(0, 0), {2, 0}, {0, 2}}) flat.add_point(x, y, 5);
  flat.add_face({0, 1, 2});
  EXPECT_EQ(even_boxes(flat, {2, 2, 1}).nodes.size(), 3u);
  EXPECT_THROW(even_boxes(flat, {2, 2, 2}), std::invalid_argument);
}

TEST(Level_cells, of_a_level_are_rooms_and_a_hull) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  EXPECT_TRUE(level.is_closed());
  const Cell_id first = level.at({64, 64, 24}), second = level.at({230, 20, 50}), wall = level.at({128, 20, 50}),
                beyond = level.at({-20, 0, 0});
  EXPECT_FALSE(level.cells()[first].is_solid);
  EXPECT_TRUE(level.cells()[wall].is_solid);
  EXPECT_EQ(level.cells()[first].region, level.cells()[second].region);  // through the door
  EXPECT_TRUE(level.cells()[beyond].is_outside);
  EXPECT_NE(level.cells()[first].region, level.cells()[beyond].region);
  EXPECT_TRUE(level.way_out({64, 64, 24}).empty());
  EXPECT_EQ(level.way_out({-20, 0, 0}), std::vector<Cell_id>{beyond});
  // What stands on the floor, against a wall, or in a corner is in the room, whatever the tree's planes.
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    const Level_cells other(corpus_scene("general/two_rooms.map"), {.seed = seed});
    for (const Exact_point& p : {Exact_point{64, 64, 0}, {0, 64, 24}, {0, 0, 0}}) {
      const std::vector<Cell_id> cells = other.about(p);
      EXPECT_TRUE(std::any_of(cells.begin(), cells.end(), [&](Cell_id c) { return other.cells()[c].is_solid; }));
      EXPECT_EQ(other.cells()[other.at(p)].region, other.cells()[other.at({64, 64, 24})].region);
      EXPECT_TRUE(other.way_out(p).empty());
    }
    EXPECT_EQ(other.about({64, 64, 24}).size(), 1u);
    EXPECT_TRUE(other.cells()[other.at({-8, 64, 50})].is_solid);
    EXPECT_TRUE(other.about({10000, 0, 0}).empty());
  }
}

TEST(Level_cells, of_a_level_with_a_hole_have_a_way_out) {
  // The two rooms without their ceiling: sides 6 to 11 of the file's brushes.
  const Polygon_soup whole = corpus_scene("general/two_rooms.map");
  Polygon_soup soup;
  for (Point_id p = 0; p < whole.point_count(); ++p) {
    const Exact_point at = whole.point(p);
    soup.add_point(at[0], at[1], at[2]);
  }
  for (Face_id f = 0; f < whole.face_count(); ++f)
    if (f < 6 || f >= 12) soup.add_face(whole.loop(f));
  const Level_cells level(soup);
  EXPECT_TRUE(level.is_closed());
  const std::vector<Cell_id> way = level.way_out({64, 64, 24});
  ASSERT_GE(way.size(), 2u);
  EXPECT_EQ(way.front(), level.at({64, 64, 24}));
  EXPECT_TRUE(level.cells()[way.back()].is_outside);
  for (std::size_t i = 0; i + 1 < way.size(); ++i)
    EXPECT_TRUE(std::any_of(level.walls().begin(), level.walls().end(), [&](const Cell_wall& wall) {
      return !wall.open.empty() && ((wall.front == way[i] && wall.behind == way[i + 1]) ||
                                    (wall.front == way[i + 1] && wall.behind == way[i]));
    }));
}

TEST(Level_cells, of_a_box_of_walls_without_thickness_have_no_way_out) {
  // A cube whose faces come twice, one way round and the other: neither side is solid, and no way leads through.
  Polygon_soup soup;
  for (int k = 0; k < 8; ++k) soup.add_point((k & 1) * 2, (k & 2) * 1, (k & 4) / 2);
  for (const std::array<Point_id, 4>& face :
       {std::array<Point_id, 4>{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}) {
    soup.add_face(face);
    soup.add_face(std::array<Point_id, 4>{face[3], face[2], face[1], face[0]});
  }
  const Level_cells level(soup);
  const Cell_id inside = level.at({1, 1, 1}), beside = level.at({Rational(17, 8), 1, 1});
  ASSERT_NE(inside, no_cell);
  ASSERT_NE(beside, no_cell);
  EXPECT_FALSE(level.cells()[inside].is_solid);
  EXPECT_FALSE(level.cells()[beside].is_solid);
  EXPECT_TRUE(level.way_out({1, 1, 1}).empty());
  EXPECT_FALSE(level.way_out({Rational(17, 8), 1, 1}).empty());
}

}  // namespace
}  // namespace sightline
