// Cells of levels: that they fill the world, where they are solid, and what their walls hold.

#include "../sample.h"

#include <sightline/algorithms/levels/cells.h>
#include <sightline/harness/generate/families.h>
#include <sightline/io/read.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sightline {
namespace {

const std::string corpus = SIGHTLINE_SOURCE_DIR "/tests/corpus";

/// Six times the volume on the inner side of a wall's polygon to the origin.
Rational cone(const std::vector<Exact_point>& polygon) {
  Rational sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) sum += dot(polygon[0], cross(polygon[i], polygon[i + 1]));
  return sum;
}
Exact_point normal(const std::vector<Exact_point>& polygon) {
  Exact_point sum{};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Exact_point part = cross(minus(polygon[i], polygon[0]), minus(polygon[i + 1], polygon[0]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return sum;
}
/// Side of a point in the plane of a convex polygon: 1 inside, 0 on its boundary, -1 outside.
int side_within(const std::vector<Exact_point>& polygon, const Exact_point& n, const Exact_point& p) {
  int side = 1;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact_point& a = polygon[i];
    const Exact_point& b = polygon[(i + 1) % polygon.size()];
    side = std::min(side, sgn(dot(cross(minus(b, a), minus(p, a)), n)));
  }
  return side;
}

struct Flat {
  Face_id face;
  std::vector<Exact_point> polygon;
  Exact_point normal;
};
std::vector<Flat> pieces_of(const Scene& scene) {
  std::vector<Flat> flats;
  for (const Piece& piece : scene.pieces()) {
    Flat flat{piece.face, {}, {}};
    for (const Piece_corner& corner : scene.corners(piece)) flat.polygon.push_back(scene.position(corner.point));
    flat.normal = normal(flat.polygon);
    flats.push_back(std::move(flat));
  }
  return flats;
}
/// The winding number about a point, by solid triangles: each piece's fan seen along a line in general position.
/// Nothing where the line meets an edge.
std::optional<int> winding(const std::vector<Flat>& flats, const Exact_point& p, const Exact_point& direction) {
  int sum = 0;
  for (const Flat& flat : flats) {
    const Rational slope = dot(flat.normal, direction);
    if (slope == 0) continue;
    const Rational t = dot(flat.normal, minus(flat.polygon[0], p)) / slope;
    if (t <= 0) continue;
    Exact_point hit;
    for (std::size_t k = 0; k < 3; ++k) hit[k] = p[k] + t * direction[k];
    const int side = side_within(flat.polygon, flat.normal, hit);
    if (side == 0) return std::nullopt;
    if (side > 0) sum += slope > 0 ? 1 : -1;
  }
  return sum;
}

/// All that is said of cells, checked without the tree.
void check(const Polygon_soup& soup, std::size_t points, std::uint32_t seed) {
  const Level_cells level(soup);
  const std::vector<Flat> flats = pieces_of(level.scene());
  std::mt19937 random(seed);
  ASSERT_GT(level.cells().size(), 0u);

  // 1. They fill a box about the scene: volumes, of walls that look inwards.
  Rational volume = 0;
  Exact_point low = level.points()[0], high = low;
  for (const Exact_point& p : level.points())
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  for (Cell_id c = 0; c < level.cells().size(); ++c) {
    const Level_cell& cell = level.cells()[c];
    const Exact_point inside = level.inside(c);
    EXPECT_EQ(level.at(inside), c);
    Rational own = 0;
    for (const std::uint32_t w : cell.walls) {
      const Cell_wall& wall = level.walls()[w];
      const std::vector<Exact_point> polygon = level.polygon(wall.corners);
      const Rational height = dot(normal(polygon), minus(inside, polygon[0]));
      EXPECT_GT(wall.front == c ? height : -height, 0) << "cell " << c << ", wall " << w;
      own += wall.front == c ? -cone(polygon) : cone(polygon);
    }
    EXPECT_GT(own, 0);
    volume += own;
    EXPECT_EQ(cell.is_outside, std::any_of(cell.walls.begin(), cell.walls.end(),
                                           [&](std::uint32_t w) { return level.walls()[w].behind == no_cell; }));
  }
  EXPECT_EQ(volume, 6 * (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]));

  // 2. Points of walls: on a face, or in an open part.
  std::uniform_int_distribution<int> weight(1, 1000);
  for (std::size_t k = 0; k < points; ++k) {
    const std::size_t w = random() % level.walls().size();
    const Cell_wall& wall = level.walls()[w];
    const std::vector<Exact_point> polygon = level.polygon(wall.corners);
    Exact_point p{};
    long sum = 0;
    for (const Exact_point& corner : polygon) {
      const int here = weight(random);
      sum += here;
      for (std::size_t i = 0; i < 3; ++i) p[i] += here * corner[i];
    }
    for (Rational& x : p) x /= sum;
    const Exact_point n = normal(polygon);
    int best = -1;  // 1: inside a face or an open part; 0: on an edge of one
    for (const Flat& flat : flats) {
      if (dot(flat.normal, minus(p, flat.polygon[0])) != 0 || !is_zero(cross(flat.normal, n))) continue;
      const int side = side_within(flat.polygon, flat.normal, p);
      best = std::max(best, side);
      const std::vector<Face_id>& faces = dot(flat.normal, n) > 0 ? wall.faces_front : wall.faces_behind;
      if (side > 0) {
        EXPECT_TRUE(std::binary_search(faces.begin(), faces.end(), flat.face)) << "wall " << w;
      }
    }
    int open = -1;
    for (const std::vector<std::uint32_t>& part : wall.open)
      open = std::max(open, side_within(level.polygon(part), n, p));
    if (wall.behind != no_cell) {
      EXPECT_GE(std::max(best, open), 0) << "wall " << w;
      EXPECT_FALSE(best > 0 && open > 0) << "wall " << w;
    }
  }

  // 3. Winding numbers.
  if (!level.is_closed() || level.scene().counters().duplicates > 0) return;
  int least = 0, most = 0;
  for (const Level_cell& cell : level.cells()) {
    least = std::min(least, cell.winding);
    most = std::max(most, cell.winding);
  }
  for (std::size_t k = 0; k < points / 4; ++k) {
    const Cell_id c = static_cast<Cell_id>(random() % level.cells().size());
    std::optional<int> expected;
    while (!expected) {
      const Exact_point direction{weight(random) - 500, weight(random) - 500, weight(random) - 500};
      if (!is_zero(direction)) expected = winding(flats, level.inside(c), direction);
    }
    EXPECT_EQ(level.cells()[c].winding, *expected) << "cell " << c;
    EXPECT_EQ(level.cells()[c].is_solid, *expected > least);
  }
}

TEST(Level_cells, of_scenes_fill_the_world) {
  for (const char* file : {"general/two_rooms.map", "general/two_rooms.off", "general/cube.off", "general/l_room.off",
                           "general/crossing_quads.obj", "general/cornell.obj", "robust/duplicates.off",
                           "robust/thirds.qoff", "robust/t_junctions.off", "robust/huge.off"}) {
    SCOPED_TRACE(file);
    check(read_scene(corpus + "/" + file), test_scenes::is_sanitized() ? 40 : 400, 1);
  }
}

TEST(Level_cells, of_no_face_are_one) {
  const Level_cells level{Polygon_soup{}};
  ASSERT_EQ(level.cells().size(), 1u);
  EXPECT_TRUE(level.cells()[0].is_outside);
  EXPECT_FALSE(level.cells()[0].is_solid);
  EXPECT_EQ(level.at({0, 0, 0}), 0u);
}

TEST(Level_cells, of_a_level_are_rooms_and_a_hull) {
  const Level_cells level(read_scene(corpus + "/general/two_rooms.map"));
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
}

TEST(Level_cells, of_a_level_with_a_hole_have_a_way_out) {
  // The two rooms without their ceiling: sides 6 to 11 of the file's brushes.
  const Polygon_soup whole = read_scene(corpus + "/general/two_rooms.map");
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

}  // namespace
}  // namespace sightline
