// What cells see, against the same question to the cell as a solid that looks, and against random sightlines.

#include "../sample.h"

#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/algorithms/weak_visibility/weak.h>
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

/// A cell as a closed polyhedron, fronts outwards.
Polygon_soup polyhedron(const Level_cells& level, Cell_id cell) {
  Polygon_soup soup;
  for (const std::uint32_t w : level.cells()[cell].walls) {
    const Cell_wall& wall = level.walls()[w];
    std::vector<Exact_point> polygon = level.polygon(wall.corners);
    if (wall.front == cell) std::reverse(polygon.begin(), polygon.end());
    std::vector<Point_id> loop;
    for (const Exact_point& p : polygon) loop.push_back(soup.add_point(p[0], p[1], p[2]));
    soup.add_face(loop);
  }
  return soup;
}

/// What a solid sees: its surface outwards, and what it sees from within. Faces in the surface hide nothing from it,
/// so this is asked of cells without covered walls, or of scenes that hold these faces some other way.
std::vector<Face_id> seen_by_solid(const Level_cells& level, const Occluders& occluders, Cell_id cell) {
  std::vector<Weak_source> sources;
  for (const std::vector<Exact_point>& portal : portals_of(level, cell))
    sources.push_back(weak_source(occluders, portal));
  Weak_options options;
  options.threads = 1;
  Weakly_visible found;
  if (!sources.empty()) {
    found = weakly_visible(occluders, sources, options);
    Events_options events;
    settle_by_events(occluders, sources, usual_event_edges, events, found);
    EXPECT_TRUE(found.undecided.empty());
  } else {
    for (const Piece& piece : level.scene().pieces())
      if (found.hidden.empty() || found.hidden.back() != piece.face) found.hidden.push_back(piece.face);
  }
  add_seen_from_within(level.scene(), Weak_volume(polyhedron(level, cell)), false, found);
  return found.visible;
}

/// Whether a segment meets a closed convex piece; exact.
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
    for (std::size_t i = 1; i + 1 < flat.polygon.size(); ++i) {
      const Exact_point part =
          cross(minus(flat.polygon[i], flat.polygon[0]), minus(flat.polygon[i + 1], flat.polygon[0]));
      for (std::size_t k = 0; k < 3; ++k) flat.normal[k] += part[k];
    }
    flats.push_back(std::move(flat));
  }
  return flats;
}
/// The face whose front a ray meets first, in its inside; nothing where that is the end of the world, a back, or an
/// edge.
std::optional<Face_id> first_front(const std::vector<Flat>& flats, const Exact_point& p, const Exact_point& direction) {
  std::optional<Rational> nearest;
  std::optional<Face_id> face;
  for (const Flat& flat : flats) {
    const Rational slope = dot(flat.normal, direction);
    if (slope == 0) continue;
    const Rational t = dot(flat.normal, minus(flat.polygon[0], p)) / slope;
    if (t <= 0 || (nearest && t > *nearest)) continue;
    Exact_point hit;
    for (std::size_t k = 0; k < 3; ++k) hit[k] = p[k] + t * direction[k];
    int side = 1;
    for (std::size_t i = 0; i < flat.polygon.size(); ++i) {
      const Exact_point& a = flat.polygon[i];
      const Exact_point& b = flat.polygon[(i + 1) % flat.polygon.size()];
      side = std::min(side, sgn(dot(cross(minus(b, a), minus(hit, a)), flat.normal)));
    }
    if (side < 0) continue;
    const bool again = nearest && t == *nearest;
    nearest = t;
    face = side > 0 && slope < 0 && !again ? std::optional<Face_id>(flat.face) : std::nullopt;
  }
  return face;
}

void check(const Polygon_soup& soup, std::size_t most_cells, std::size_t rays, std::uint32_t seed) {
  const Level_cells level(soup);
  Pvs_options options;
  options.outside = true;
  const Pvs pvs = potentially_visible(level, options);
  EXPECT_EQ(pvs.counters.undecided, 0u);
  const Occluders occluders(level.scene());
  std::vector<Cell_id> cells;
  for (Cell_id c = 0; c < level.cells().size(); ++c)
    if (pvs.is_asked[c] != 0) cells.push_back(c);
    else EXPECT_TRUE(pvs.visible[c].empty());
  std::mt19937 random(seed);
  std::shuffle(cells.begin(), cells.end(), random);

  // 1. Random sightlines from inside: what they meet is visible.
  const std::vector<Flat> flats = pieces_of(level.scene());
  std::uniform_int_distribution<int> coordinate(-100, 100);
  for (std::size_t k = 0; k < rays && !cells.empty(); ++k) {
    const Cell_id c = cells[k % cells.size()];
    const Exact_point direction{coordinate(random), coordinate(random), coordinate(random)};
    if (is_zero(direction)) continue;
    if (const std::optional<Face_id> face = first_front(flats, level.inside(c), direction)) {
      EXPECT_TRUE(std::binary_search(pvs.visible[c].begin(), pvs.visible[c].end(), *face))
          << "cell " << c << " does not see face " << *face;
    }
  }

  // 2. The same question without what neighbours know.
  if (cells.size() > most_cells) cells.resize(most_cells);
  for (const Cell_id c : cells) EXPECT_EQ(pvs.visible[c], seen_by_solid(level, occluders, c)) << "cell " << c;
}

TEST(Pvs, of_scenes_is_what_each_cell_sees_by_itself) {
  const std::size_t share = test_scenes::is_sanitized() ? 8 : 1;
  for (const char* file : {"general/two_rooms.map", "general/two_rooms.off", "general/cube.off", "general/l_room.off",
                           "general/crossing_quads.obj", "general/cornell.obj", "robust/duplicates.off",
                           "robust/thirds.qoff", "robust/t_junctions.off"}) {
    SCOPED_TRACE(file);
    check(read_scene(corpus + "/" + file), 12 / share, 200 / share, 1);
  }
}

TEST(Pvs, is_the_same_on_any_number_of_threads_and_in_shards) {
  const Level_cells level(read_scene(corpus + "/general/two_rooms.map"));
  Pvs_options options;
  options.threads = 1;
  const Pvs one = potentially_visible(level, options);
  options.threads = 3;
  EXPECT_EQ(potentially_visible(level, options).visible, one.visible);
  std::vector<std::vector<Face_id>> merged(level.cells().size());
  std::size_t pairs = 0;
  options.shards = 4;
  for (options.shard = 0; options.shard < options.shards; ++options.shard) {
    const Pvs part = potentially_visible(level, options);
    pairs += part.counters.pairs;
    for (Cell_id c = 0; c < merged.size(); ++c)
      merged[c].insert(merged[c].end(), part.visible[c].begin(), part.visible[c].end());
  }
  for (std::vector<Face_id>& faces : merged) std::sort(faces.begin(), faces.end());
  EXPECT_EQ(merged, one.visible);
  EXPECT_EQ(pairs, one.counters.pairs);
}

TEST(Pvs, of_rooms_leaves_out_what_has_a_way_out) {
  const Level_cells level(read_scene(corpus + "/general/two_rooms.map"));
  const Pvs rooms = potentially_visible(level);
  Pvs_options options;
  options.outside = true;
  const Pvs all = potentially_visible(level, options);
  std::size_t asked = 0;
  for (Cell_id c = 0; c < level.cells().size(); ++c) {
    EXPECT_EQ(all.is_asked[c] != 0, !level.cells()[c].is_solid);
    if (rooms.is_asked[c] == 0) continue;
    ++asked;
    EXPECT_FALSE(level.cells()[c].is_outside);
    EXPECT_EQ(rooms.visible[c], all.visible[c]);
  }
  EXPECT_EQ(asked, rooms.counters.cells);
  EXPECT_GT(all.counters.cells, rooms.counters.cells);
  // From a corner of the first room, past the jamb of the door, the far wall of the second is seen, its near one is
  // not.
  const Cell_id corner = level.at({1, 1, 1});
  ASSERT_NE(rooms.is_asked[corner], 0);
}

TEST(Pvs, out_of_time_is_undecided) {
  const Level_cells level(read_scene(corpus + "/general/two_rooms.map"));
  Pvs_options options;
  options.search.out_of_time = [] { return true; };
  const Pvs pvs = potentially_visible(level, options);
  const Pvs whole = potentially_visible(level);
  EXPECT_GT(pvs.counters.undecided, 0u);
  for (Cell_id c = 0; c < level.cells().size(); ++c)
    for (const Face_id face : whole.visible[c])
      EXPECT_TRUE(std::binary_search(pvs.visible[c].begin(), pvs.visible[c].end(), face) ||
                  std::binary_search(pvs.undecided[c].begin(), pvs.undecided[c].end(), face));
}

}  // namespace
}  // namespace sightline
