// Targets that hang together in one plane: which do, the polygon around them, and that one search hides them all.

#include "scenes.h"
#include "../sample.h"

#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/search/line_search.h>
#include <sightline/algorithms/weak_visibility/search/shared_targets.h>
#include <sightline/algorithms/weak_visibility/weak.h>

#include <gtest/gtest.h>

#include <optional>

namespace weak_together {
namespace {

using namespace sightline;
using weak_scenes::at;
using weak_scenes::Faces;
using weak_scenes::Points;
using weak_scenes::ratio;
using weak_scenes::rectangle;
using weak_scenes::reversed;

/// Triangles that look down, from a corner of a square ceiling to the parts of its far sides.
Faces fan(long height, long parts) {
  Faces triangles;
  Points rim;
  for (long k = 0; k <= parts; ++k) rim.push_back(at(4, ratio(4 * k, parts), height));
  for (long k = parts - 1; k >= 0; --k) rim.push_back(at(ratio(4 * k, parts), 4, height));
  for (std::size_t k = 0; k + 1 < rim.size(); ++k) triangles.push_back({at(0, 0, height), rim[k + 1], rim[k]});
  return triangles;
}

struct Asked {
  Polygon_soup soup;
  Scene scene;
  Occluders occluders;
  std::vector<Points> source{rectangle(0, 4, 0, 4, 0)};
  std::vector<Weak_source> sources;

  explicit Asked(const Faces& faces)
      : soup(weak_scenes::soup_of(faces)), scene(soup), occluders(scene), sources{weak_source(occluders, source[0])} {}
  Asked(const Asked&) = delete;

  Weakly_visible answer(std::optional<std::size_t> together_after, int threads = 1,
                        std::size_t cells = Weak_search_options().cells) const {
    Weak_options options;
    options.together_after = together_after;
    options.threads = threads;
    options.search.cells = cells;
    Weakly_visible found = weakly_visible(occluders, sources, options);
    const Verdict verdict = verify_weak(soup, weak_certificate(scene, source, false, found));
    EXPECT_TRUE(verdict.accepted) << verdict.why;
    return found;
  }
};

/// Two plates that meet in the middle, wide as they are, and none of which hides the ceiling by itself.
Faces plates(const Rational& gap) { return {rectangle(-20, 2 - gap, -20, 20, 1), rectangle(2, 20, -20, 20, 1)}; }

Faces with(Faces faces, const Faces& more) {
  faces.insert(faces.end(), more.begin(), more.end());
  return faces;
}

TEST(Together, hang_pieces_of_one_plane_with_common_corners) {
  Faces faces = fan(3, 2);                                                     // 0 to 3
  faces.push_back({at(0, 0, 3), at(0, -1, 3), at(-1, 0, 3)});                  // 4: by one corner, looks down
  faces.push_back(reversed(Points{at(0, 0, 3), at(-1, 0, 3), at(-1, 1, 3)}));  // 5: looks up
  faces.push_back({at(9, 9, 3), at(8, 8, 3), at(9, 8, 3)});                    // 6: in the plane, with no common corner
  faces.push_back({at(0, 0, 3), at(0, 4, 4), at(4, 0, 4)});                    // 7: in another plane
  faces.push_back({at(9, 9, 3), at(9, 8, 3), at(9, 8, 2)});
  const Scene scene(weak_scenes::soup_of(faces));
  const Occluders occluders(scene);
  EXPECT_TRUE(scene.set_aside().empty());
  for (const std::uint32_t piece : {0u, 1u, 2u, 3u, 4u}) EXPECT_TRUE(has_neighbour_in_plane(occluders, piece)) << piece;
  for (const std::uint32_t piece : {5u, 6u, 7u, 8u}) EXPECT_FALSE(has_neighbour_in_plane(occluders, piece)) << piece;
  const Targets all{0, 1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(hanging_together(occluders, all), (std::vector<Targets>{{0, 1, 2, 3, 4}}));
  EXPECT_EQ(hanging_together(occluders, Targets{0, 3, 6}), (std::vector<Targets>{{0, 3}}));
  EXPECT_TRUE(hanging_together(occluders, Targets{2}).empty());
  EXPECT_EQ(occluders.pieces_at(scene.corners(scene.pieces()[6])[0].point).size(), 2u);
}

TEST(Together, halves_are_on_both_sides_of_the_longer_way) {
  Faces faces;
  for (long k = 0; k < 5; ++k) faces.push_back(rectangle(4 - k, 5 - k, 0, ratio(1, 1 + k), 1));
  const Scene scene(weak_scenes::soup_of(faces));
  const Occluders occluders(scene);
  const std::array<Targets, 2> parts = halves(occluders, Targets{0, 1, 2, 3, 4});
  EXPECT_EQ(parts[0], (Targets{2, 3, 4}));
  EXPECT_EQ(parts[1], (Targets{0, 1}));
}

TEST(Together, polygon_around_has_the_corners_that_turn) {
  // From any side, in any of the planes of coordinates or across them all.
  for (int turn = 0; turn < 4; ++turn) {
    Faces faces = fan(3, 3);
    for (Points& face : faces)
      for (Exact_point& p : face) {
        if (turn < 3) p = {p[turn % 3], p[(turn + 1) % 3], p[(turn + 2) % 3]};
        else p = {p[0] + p[1], p[1] - p[0] + p[2], 2 * p[0] + p[2] - p[1]};
      }
    const Polygon_soup soup = weak_scenes::soup_of(faces);
    const Scene scene(soup);
    const Occluders occluders(scene);
    Targets all;
    for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) all.push_back(piece);
    Points hull;
    for (const Near_point& corner : polygon_around(occluders, all)) hull.push_back(scene.position(corner.exact));
    ASSERT_EQ(hull.size(), 4u) << turn;
    // As a source it would look to where the triangles look.
    EXPECT_EQ(strict_corners(hull), hull);
    const Weak_source around = weak_source(occluders, hull);
    for (const std::uint32_t piece : all) EXPECT_EQ(side(around.plane, occluders.polygon(piece)), 0);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(sgn(around.plane.exact[k]), sgn(occluders.plane(0).exact[k])) << turn;
    const Points one = scene.corner_points(scene.pieces()[0]);
    const auto inside = [&](const Exact_point& p) { return has_inside(occluders, 0, occluders.located(p)); };
    EXPECT_TRUE(inside(weak_scenes::centroid(one)));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_FALSE(inside(one[k]));
      EXPECT_FALSE(inside(weak_scenes::centroid({one[k], one[(k + 1) % 3]})));
      EXPECT_FALSE(inside(weak_scenes::centroid(scene.corner_points(scene.pieces()[2]))));
    }
  }
}

TEST(Together, one_search_hides_what_hangs_together) {
  const Asked asked(with(fan(3, 8), plates(0)));
  const Weakly_visible found = asked.answer(0), one_by_one = asked.answer({}), by_threads = asked.answer(0, 3);
  EXPECT_EQ(found.hidden, one_by_one.hidden);
  EXPECT_EQ(found.hidden.size(), 18u);
  EXPECT_EQ(found.counters.together, 16u);
  EXPECT_EQ(found.counters.polygons, 1u);
  EXPECT_EQ(found.counters.targets, 18u);
  EXPECT_EQ(one_by_one.counters.together + one_by_one.counters.polygons, 0u);
  EXPECT_EQ(one_by_one.counters.targets, 18u);
  EXPECT_LT(4 * found.counters.cells, one_by_one.counters.cells);
  EXPECT_EQ(found.counters.cells, by_threads.counters.cells);
  EXPECT_EQ(by_threads.hidden, found.hidden);
  const Weak_certificate certificate = weak_certificate(asked.scene, asked.source, false, found);
  ASSERT_EQ(certificate.hidden.size(), 2u);
  EXPECT_EQ(certificate.hidden[0].also.size(), 15u);
  EXPECT_EQ(certificate.hidden[0].target.size(), 4u);
  EXPECT_GT(certificate.hidden[0].proof.size(), 1u);
}

TEST(Together, a_polygon_is_searched_once_others_have_taken_cells) {
  const Asked asked(with(fan(3, 8), plates(0)));
  const std::size_t each = asked.answer({}).counters.cells / 16;
  EXPECT_EQ(asked.answer(32 * each + 1).counters.polygons, 0u);
  const Weakly_visible found = asked.answer(2 * each);
  EXPECT_GT(found.counters.together, 8u);
  EXPECT_LT(found.counters.together, 16u);
  EXPECT_EQ(found.hidden.size(), 18u);
  EXPECT_EQ(found.counters.targets, 18u);
}

TEST(Together, what_is_seen_is_told_of_each) {
  // Through a narrow gap all of the ceiling is seen; and so it is beside a plate that ends above a corner of the
  // source.
  for (const Faces& between :
       {plates(ratio(1, 1 << 10)),
        Faces{rectangle(-20, ratio(41, 20), -20, 20, 1), rectangle(ratio(21, 10), 20, -20, 20, ratio(11, 10))}}) {
    const Asked asked(with(fan(3, 8), between));
    const Weakly_visible found = asked.answer(0), one_by_one = asked.answer({});
    EXPECT_EQ(found.visible, one_by_one.visible);
    EXPECT_EQ(found.visible.size(), 16u);
    EXPECT_EQ(found.counters.targets, 18u);
    EXPECT_EQ(found.counters.together, 0u);
  }
}

TEST(Together, parts_of_what_hangs_together_are_hidden) {
  // A wall beside the source hides what is behind its plane's other side: some of the triangles, and not all.
  Faces faces = with(fan(3, 8), {rectangle(-20, 1, -20, 20, 1), rectangle(1, 2, -20, 20, 1)});
  const Asked asked(faces);
  const Weakly_visible found = asked.answer(0), one_by_one = asked.answer({});
  EXPECT_EQ(found.visible, one_by_one.visible);
  EXPECT_EQ(found.hidden, one_by_one.hidden);
  EXPECT_EQ(found.counters.targets, 18u);
}

TEST(Together, lines_beside_a_sightline_end_in_front_of_the_source_and_begin_in_front_of_the_target) {
  // Walls beside a floor: above it, through its plane, and one whose plane the floor passes.
  const auto wall = [](const Rational& x, long low) {
    return Points{at(x, 0, low), at(x, 0, 9), at(x, 4, 9), at(x, 4, low)};
  };
  const Asked asked({wall(5, 1), wall(6, -9), wall(2, 1)});
  const auto beside = [&](std::uint32_t piece, const Rational& x, long height) {
    Weak_search_options options;
    Weak_counters counters;
    Line_search search(asked.occluders, asked.sources[0].polygon, asked.sources[0].plane,
                       asked.occluders.polygon(piece), piece, options);
    return search.beside(asked.occluders.located(at(3, 1, 0)).near, asked.occluders.located(at(x, 2, height)).near,
                         counters);
  };
  ASSERT_TRUE(beside(0, 5, 20));
  const std::array<Near_point, 2> line = *beside(0, 5, 20);
  EXPECT_EQ(side(asked.sources[0].plane, line[1]), 1);
  EXPECT_TRUE(has_inside(asked.occluders, 0, line[1]));
  EXPECT_FALSE(beside(1, 6, -8));
  EXPECT_FALSE(beside(2, 2, 2));
}

TEST(Together, ends_where_cells_or_time_do) {
  const Asked asked(with(fan(3, 8), plates(0)));
  const Weakly_visible none = asked.answer(0, 1, 0);
  EXPECT_EQ(none.undecided.size(), 16u);
  EXPECT_EQ(none.open.size(), 16u);
  Weak_options options;
  options.threads = 1;
  options.together_after = 0;
  std::size_t asks = 0;
  for (std::size_t most : {0u, 1u, 5u, 20u, 40u, 60u, 100u}) {
    asks = 0;
    options.search.out_of_time = [&] { return ++asks > most; };
    const Weakly_visible found = weakly_visible(asked.occluders, asked.sources, options);
    EXPECT_EQ(found.visible.size() + found.hidden.size() + found.undecided.size(), 18u);
    const Verdict verdict = verify_weak(asked.soup, weak_certificate(asked.scene, asked.source, false, found));
    EXPECT_TRUE(verdict.accepted) << verdict.why;
  }
}

}  // namespace
}  // namespace weak_together
