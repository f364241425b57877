// The oracle itself: by scenes whose answer is worked out by hand, and its parts against each other, each by another
// way to the same thing.

#include "../sample.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <sightline/harness/compare/flat_polygon.h>

using namespace oracle;
using view_scenes::at;
using view_scenes::Case;
using view_scenes::Family;
using view_scenes::ratio;
using view_scenes::rectangle;
using view_scenes::reversed;

namespace {

#if defined(ORACLE_SEEDS)  // by hand: more, or fewer
constexpr std::uint64_t seeds_each = ORACLE_SEEDS;
#else
const std::uint64_t seeds_each = test_scenes::is_sanitized() ? 1 : 2;
#endif

using Intervals = std::vector<Interval>;
using Ids = std::set<Face_id>;

Scene scene_of(const std::vector<Points>& faces) { return Scene(view_scenes::soup_of(faces)); }
/// Seen from either side.
Rational area(const Scene& scene, const Exact_point& eye, Face_id face) {
  return Rational(visible_area(scene, eye, face, true) + visible_area(scene, eye, face, false));
}
Rational tiny() { return Rational(1, 1ul << 40); }

// ---- By hand: areas

TEST(Oracle_parts, of_a_square_half_covered_is_the_other_half) {
  const Scene scene = scene_of({rectangle(0, 4, 0, 4, 0), rectangle(2, 3, 1, 3, 1)});
  const Exact_point eye = at(2, 2, 2);  // the shadow is [2, 4] x [0, 4]
  const std::vector<Region> regions = visible_parts(scene, eye);
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_TRUE(same_points(regions[0].parts, {rectangle(0, 2, 0, 4, 0)}, at(0, 0, 1)));
  EXPECT_FALSE(same_points(regions[0].parts, {rectangle(0, 2, 0, 3, 0)}, at(0, 0, 1)));
  EXPECT_FALSE(same_points(regions[0].parts, {rectangle(0, 3, 0, 4, 0)}, at(0, 0, 1)));
  EXPECT_EQ(regions[0].area, 8);
  EXPECT_EQ(regions[1].area, 2);
  EXPECT_TRUE(regions[0].front && regions[1].front);
  EXPECT_EQ(visible_faces(scene, eye), (Ids{0, 1}));
  EXPECT_EQ(visible_area(scene, eye, 0, true), 8);
  EXPECT_EQ(visible_area(scene, eye, 0, false), 0);
  // From below the larger one hides the other, and it is its back.
  const Exact_point below = at(2, 2, -2);
  EXPECT_EQ(visible_area(scene, below, 0, false), 16);
  EXPECT_EQ(area(scene, below, 1), 0);
  EXPECT_EQ(visible_faces(scene, below), Ids{});
}

TEST(Oracle_parts, count_holes_and_areas_by_projection) {
  // A ring is left of the floor. Slopes are projected where they are largest.
  const Scene scene = scene_of({rectangle(-4, 4, -4, 4, 0), rectangle(-1, 1, -1, 1, 1)});
  EXPECT_EQ(area(scene, at(0, 0, 2), 0), 64 - 16);
  EXPECT_EQ(area(scene_of({{at(0, 0, 0), at(2, 0, 1), at(2, 3, 1), at(0, 3, 0)}}), at(1, 1, 9), 0),
            6);  // z = x / 2: along z
  EXPECT_EQ(area(scene_of({{at(0, 0, 0), at(0, 1, 0), at(1, 1, 3), at(1, 0, 3)}}), at(1, 1, 9), 0),
            3);  // z = 3 x: along x
}

TEST(Oracle_parts, of_what_is_behind_a_wall_higher_than_the_eye_go_on_beside_it) {
  const Scene scene = scene_of({rectangle(-4, 4, -4, 4, 0), {at(-1, 1, 0), at(1, 1, 0), at(1, 1, 6), at(-1, 1, 6)}});
  const Exact_point eye = at(0, 0, 3);  // the shadow is 1 < y, |x| < y, without end
  EXPECT_EQ(area(scene, eye, 0), 64 - 15);
  EXPECT_EQ(area(scene, eye, 1), 12);
  EXPECT_EQ(visible_faces(scene, eye), (Ids{0, 1}));
  // All of the wall above the eye: nothing is hidden.
  const Scene high = scene_of({rectangle(-4, 4, -4, 4, 0), {at(-1, 1, 3), at(1, 1, 3), at(1, 1, 6), at(-1, 1, 6)}});
  EXPECT_EQ(area(high, eye, 0), 64);
  // And a ceiling hides no floor.
  EXPECT_EQ(area(scene_of({rectangle(-4, 4, -4, 4, 0), rectangle(-9, 9, -9, 9, 4)}), eye, 0), 64);
}

TEST(Oracle_parts, of_crossing_faces_end_where_they_cross) {
  const Scene scene = scene_of({rectangle(-2, 2, -2, 2, 0), {at(0, -2, -1), at(0, 2, -1), at(0, 2, 1), at(0, -2, 1)}});
  const Exact_point eye =
      at(3, 0, 3);  // the wall's upper half hides -3/2 < x < 0 of the floor, the floor hides the wall's lower half
  const std::vector<Region> regions = visible_parts(scene, eye);
  EXPECT_EQ(regions[0].area, 10);
  EXPECT_EQ(regions[1].area, 4);
  EXPECT_TRUE(same_points(regions[1].parts, {{at(0, -2, 0), at(0, 2, 0), at(0, 2, 1), at(0, -2, 1)}}, at(1, 0, 0)));
  EXPECT_TRUE(
      same_points(regions[0].parts, {rectangle(-2, ratio(-3, 2), -2, 2, 0), rectangle(0, 2, -2, 2, 0)}, at(0, 0, 1)));
}

TEST(Oracle_parts, of_coplanar_faces_go_to_the_front_then_to_the_lower_face) {
  const Scene scene = scene_of({rectangle(0, 2, 0, 2, 0), rectangle(1, 3, 0, 2, 0), reversed(rectangle(0, 3, 0, 2, 0)),
                                rectangle(0, 1, 0, 1, 0)});
  const Exact_point above = at(1, 1, 5), below = at(1, 1, -5);
  const auto areas = [&](const Exact_point& eye) {
    return std::vector<Rational>{area(scene, eye, 0), area(scene, eye, 1), area(scene, eye, 2), area(scene, eye, 3)};
  };
  EXPECT_EQ(areas(above), (std::vector<Rational>{4, 2, 0, 0}));
  EXPECT_EQ(areas(below), (std::vector<Rational>{0, 0, 6, 0}));
  // By the law coplanar faces do not hide each other.
  EXPECT_EQ(visible_faces(scene, above), (Ids{0, 1, 3}));
  EXPECT_EQ(visible_faces(scene, below), (Ids{2}));
  bool generic = false;
  EXPECT_EQ(first_hit(scene, above, at(-3, -1, -20), &generic), 0u);
  EXPECT_TRUE(generic);
  EXPECT_EQ(first_hit(scene, above, at(5, 1, -20)), 1u);
  EXPECT_EQ(first_hit(scene, below, at(-3, -1, 20)), 2u);
  // A face that loses everywhere to a front, with a hidden one before it, is visible by the law only where nothing else
  // hides it.
  const Scene covered = scene_of({rectangle(0, 2, 0, 2, 0), rectangle(0, 1, 0, 1, 0), rectangle(-1, 1, -1, 1, 1)});
  EXPECT_EQ(visible_faces(covered, at(0, 0, 3)), (Ids{0, 2}));
}

TEST(Oracle_parts, of_the_pieces_of_one_face_add_up) {
  const Scene scene = scene_of({{at(0, 0, 0), at(2, 0, 0), at(2, 1, 0), at(1, 1, 0), at(1, 2, 0), at(0, 2, 0)}});
  ASSERT_GT(scene.pieces().size(), 1u);
  EXPECT_EQ(area(scene, at(1, 1, 4), 0), 3);
  EXPECT_EQ(visible_areas(visible_parts(scene, at(1, 1, 4))),
            (std::map<std::pair<Face_id, bool>, Rational>{{{0, true}, 3}}));
}

TEST(Oracle_parts, of_faces_that_are_edge_on_are_none_and_nothing_is_behind_them) {
  const Scene scene = scene_of({rectangle(-4, 4, -4, 4, 0), {at(0, 1, 0), at(0, 2, 0), at(0, 2, 3), at(0, 1, 3)}});
  const Exact_point eye = at(0, 0, 1);
  EXPECT_EQ(area(scene, eye, 0), 64);
  EXPECT_TRUE(visible_parts(scene, eye)[1].parts.empty());
  EXPECT_EQ(visible_faces(scene, eye), (Ids{0}));
  bool generic = true;
  EXPECT_EQ(first_hit(scene, eye, at(0, 3, -1), &generic), 0u);  // through the wall
  EXPECT_FALSE(generic);
}

TEST(Oracle_parts, from_inside_a_cube_are_its_six_faces) {
  std::vector<Points> cube = view_scenes::box(at(-1, -1, -1), at(1, 1, 1));
  for (const Exact_point& eye : {at(0, 0, 0), at(ratio(1, 2), ratio(-9, 10), 0)}) {
    const Scene scene = scene_of(cube);
    for (Face_id f = 0; f < 6; ++f) EXPECT_EQ(visible_area(scene, eye, f, false), 4);
    EXPECT_EQ(visible_faces(scene, eye), Ids{});
    for (Points& face : cube) face = reversed(face);
    const Scene turned = scene_of(cube);
    for (Face_id f = 0; f < 6; ++f) EXPECT_EQ(visible_area(turned, eye, f, true), 4);
    EXPECT_EQ(visible_faces(turned, eye), (Ids{0, 1, 2, 3, 4, 5}));
    for (Points& face : cube) face = reversed(face);
  }
  // On its wall, on its edge and at its corner: the faces that hold the eye are edge-on.
  EXPECT_EQ(visible_areas(visible_parts(scene_of(cube), at(1, 0, 0))).size(), 5u);
  EXPECT_EQ(visible_areas(visible_parts(scene_of(cube), at(1, 1, 0))).size(), 4u);
  EXPECT_EQ(visible_areas(visible_parts(scene_of(cube), at(1, 1, 1))).size(), 3u);
  // From outside three, two or one.
  EXPECT_EQ(visible_faces(scene_of(cube), at(3, 4, 5)), (Ids{1, 3, 5}));
  EXPECT_EQ(visible_faces(scene_of(cube), at(3, 4, 1)), (Ids{1, 3}));
  EXPECT_EQ(visible_faces(scene_of(cube), at(3, 1, -1)), (Ids{1}));
}

TEST(Oracle_parts, of_a_floor_under_four_faces_with_a_corner_on_one_line_of_sight_are_the_rest_of_it) {
  const Scene scene =
      scene_of({rectangle(-4, 4, -4, 4, 0), rectangle(0, 1, 0, 1, 2), rectangle(ratio(-1, 2), 0, ratio(-1, 2), 0, 3),
                rectangle(ratio(-3, 2), 0, 0, ratio(3, 2), 1), rectangle(0, 1, -1, 0, 2)});
  const Exact_point eye = at(0, 0, 4);  // their shadows are the four quadrants of [-2, 2] x [-2, 2]
  EXPECT_EQ(area(scene, eye, 0), 48);
  bool generic = true;
  first_hit(scene, eye, at(0, 0, -1), &generic);
  EXPECT_FALSE(generic);
  EXPECT_EQ(first_hit(scene, eye, at(-1, 1, -8), &generic), 3u);
  EXPECT_TRUE(generic);
  EXPECT_EQ(visible_on_edge(scene, eye, at(-4, -4, 0), at(4, 4, 0)), (Intervals{{0, ratio(1, 4)}, {ratio(3, 4), 1}}));
  EXPECT_EQ(visible_on_edge(scene, eye, at(-4, 0, 0), at(4, 0, 0)),
            (Intervals{{0, ratio(1, 4)}, {ratio(3, 4), 1}}));  // along the seam: grazing blocks
}

TEST(Oracle_parts, of_a_scaled_copy_behind_are_none_and_one_ulp_larger_they_are_a_frame) {
  const Points near = rectangle(-1, 1, -1, 1, 1);
  const Exact_point eye = at(0, 0, 3);
  EXPECT_EQ(area(scene_of({near, rectangle(ratio(-3, 2), ratio(3, 2), ratio(-3, 2), ratio(3, 2), 0)}), eye, 1), 0);
  const Rational wide = Rational(ratio(3, 2) + tiny());
  const Scene larger = scene_of({near, rectangle(Rational(-wide), wide, Rational(-wide), wide, 0)});
  EXPECT_EQ(area(larger, eye, 1), Rational(4 * wide * wide - 9));
  EXPECT_EQ(visible_faces(larger, eye), (Ids{0, 1}));
}

TEST(Oracle_first_hit, is_the_nearest_and_says_where_it_is_a_convention) {
  const Scene scene =
      scene_of({rectangle(0, 4, 0, 4, 0), rectangle(0, 2, 0, 2, 1), {at(0, 0, -1), at(4, 4, -1), at(4, 4, 1)}});
  bool generic = false;
  EXPECT_EQ(first_hit(scene, at(1, 2, 9), at(0, -1, -9), &generic), 1u);
  EXPECT_TRUE(generic);
  EXPECT_EQ(first_hit(scene, at(1, 3, 9), at(0, 0, -1), &generic), 0u);
  EXPECT_TRUE(generic);
  EXPECT_EQ(first_hit(scene, at(1, 3, 9), at(0, 0, 1), &generic), std::nullopt);
  EXPECT_TRUE(generic);
  EXPECT_EQ(first_hit(scene, at(1, 3, 9), at(0, -1, -8), &generic), 1u);  // the edge y = 2
  EXPECT_FALSE(generic);
  first_hit(scene, at(4, 2, 2), at(-1, 1, -2), &generic);  // at (3, 3, 0) the floor and the triangle
  EXPECT_FALSE(generic);
  EXPECT_EQ(first_hit(scene, at(4, 2, 2), at(-1, 1, 0), &generic), std::nullopt);  // above it
  EXPECT_TRUE(generic);
  EXPECT_EQ(first_hit(scene, at(4, 2, ratio(-1, 2)), at(-1, 0, 0), &generic), 2u);  // under the floor
  EXPECT_TRUE(generic);
  EXPECT_EQ(first_hit(scene, at(4, 1, 0), at(-1, 0, 0), &generic), std::nullopt);  // in the floor, beside the triangle
  EXPECT_FALSE(generic);
}

// ---- By hand: hidden lines

TEST(Oracle_edges, of_a_cube_hides_the_edges_at_the_back) {
  const Scene scene = scene_of(view_scenes::box(at(0, 0, 0), at(1, 1, 1)));
  const Intervals all{{0, 1}};
  const auto visible = [&](const Exact_point& eye) {  // the edges as bits of their ends, the lower first
    std::set<std::pair<int, int>> edges;
    for (int from = 0; from < 8; ++from)
      for (int bit = 1; bit < 8; bit *= 2) {
        if (from & bit) continue;
        const int to = from | bit;
        const Intervals free =
            visible_on_edge(scene, eye, at(from & 1, from / 2 & 1, from / 4), at(to & 1, to / 2 & 1, to / 4));
        EXPECT_TRUE(free.empty() || free == all);
        if (!free.empty()) edges.insert({from, to});
      }
    return edges;
  };
  EXPECT_EQ(visible(at(3, 4, 5)),
            (std::set<std::pair<int, int>>{
                {1, 3}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 6}, {5, 7}, {6, 7}}));  // not those at the origin
  const std::set<std::pair<int, int>> two_faces{{1, 3}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {5, 7}, {6, 7}};
  EXPECT_EQ(visible(at(3, 4, ratio(1, 2))), two_faces);
  EXPECT_EQ(visible(at(3, 4, 1)), two_faces);  // the lid is edge-on and hides its far edges
  EXPECT_EQ(visible(at(ratio(1, 2), ratio(1, 3), ratio(1, 4))).size(), 12u);
}

TEST(Oracle_edges, behind_an_obstacle_ends_at_its_shadow_and_grazing_blocks) {
  const Exact_point eye = at(0, 0, 2), a = at(-4, 0, 0), b = at(4, 0, 0);
  const Rational half = ratio(1, 2);
  const Intervals gap{{0, ratio(3, 8)}, {ratio(5, 8), 1}};
  EXPECT_EQ(visible_on_edge(scene_of({rectangle(Rational(-half), half, Rational(-half), half, 1)}), eye, a, b), gap);
  EXPECT_EQ(visible_on_edge(scene_of({rectangle(Rational(-half), half, 0, half, 1)}), eye, a, b),
            gap);  // its edge is in the plane of the eye and the line
  EXPECT_EQ(visible_on_edge(scene_of({rectangle(Rational(-half), half, tiny(), half, 1)}), eye, a, b),
            (Intervals{{0, 1}}));
  EXPECT_EQ(visible_on_edge(scene_of({{at(0, 0, 1), at(1, 1, 1), at(0, 1, 1)}}), eye, a, b),
            (Intervals{{0, 1}}));  // one point only
  // Beyond the line, behind the eye, on the line, with one edge on it: not in the way.
  EXPECT_EQ(visible_on_edge(scene_of({rectangle(-9, 9, -9, 9, -1), rectangle(-9, 9, -9, 9, 3),
                                      rectangle(-1, 1, -1, 1, 0), rectangle(1, 2, 0, 1, 0)}),
                            eye, a, b),
            (Intervals{{0, 1}}));
  // Through the line: hidden where it is nearer. And two that meet leave nothing between them.
  EXPECT_EQ(visible_on_edge(scene_of({{at(0, -1, 1), at(0, 1, 1), at(2, 0, -1)}}), eye, a, b),
            (Intervals{{0, half}, {ratio(5, 8), 1}}));
  EXPECT_EQ(visible_on_edge(scene_of({rectangle(Rational(-half), 0, Rational(-half), half, 1),
                                      rectangle(0, half, Rational(-half), half, 1)}),
                            eye, a, b),
            gap);
  // All of it, and seen end-on.
  EXPECT_EQ(visible_on_edge(scene_of({rectangle(-2, 2, -1, 1, 1)}), eye, a, b), Intervals{});
  EXPECT_EQ(visible_on_edge(scene_of({rectangle(-2, 2, -1, 1, 1)}), eye, at(0, 0, 1), at(0, 0, 0)), Intervals{});
  EXPECT_EQ(visible_on_edge(scene_of({rectangle(-2, 2, -1, 1, 1)}), eye, eye, a), Intervals{});
  // The parameter runs from a to b.
  EXPECT_EQ(visible_on_edge(scene_of({rectangle(half, 2, -1, 1, 1)}), eye, a, b), (Intervals{{0, ratio(5, 8)}}));
  EXPECT_EQ(visible_on_edge(scene_of({rectangle(half, 2, -1, 1, 1)}), eye, b, a), (Intervals{{ratio(3, 8), 1}}));
}

TEST(Oracle_edges, behind_a_face_that_is_edge_on_is_hidden_where_the_face_holds_the_sightline) {
  const Scene scene = scene_of({rectangle(-4, 4, -4, 4, 0), {at(0, 1, 0), at(0, 2, 0), at(0, 2, 3), at(0, 1, 3)}});
  const Exact_point eye = at(0, 0, 1);
  EXPECT_EQ(visible_on_edge(scene, eye, at(0, 0, 0), at(0, 4, 0)), (Intervals{{0, ratio(1, 4)}}));
  EXPECT_EQ(visible_on_edge(scene, eye, at(-1, 4, 0), at(1, 4, 0)), (Intervals{{0, 1}}));  // but for one point
  EXPECT_EQ(visible_on_edge(scene, eye, at(0, 1, 0), at(0, 1, 3)), (Intervals{{0, 1}}));   // its near edge
  EXPECT_EQ(visible_on_edge(scene, eye, at(0, 2, 0), at(0, 2, 3)), Intervals{});           // its far edge
  EXPECT_EQ(visible_on_edge(scene, eye, at(0, 2, 3), at(0, 2, 6)),
            (Intervals{{ratio(2, 3), 1}}));  // over its upper corner
  // The eye on the wall: only what is on the wall is behind it.
  EXPECT_EQ(visible_on_edge(scene, at(0, ratio(3, 2), 1), at(0, 3, 0), at(0, 3, 3)), Intervals{});
  EXPECT_EQ(visible_on_edge(scene, at(0, 2, 1), at(0, 3, 0), at(0, 3, 3)), (Intervals{{0, 1}}));
  EXPECT_EQ(visible_on_edge(scene, at(0, ratio(3, 2), 1), at(-1, 3, 1), at(1, 3, 1)), (Intervals{{0, 1}}));
}

TEST(Oracle_segments, are_open_and_pieces_closed) {
  const Flats flats = flats_of(scene_of({rectangle(0, 2, 0, 2, 0)}));
  const auto blocked = [&](const Exact_point& p, const Exact_point& q) {
    EXPECT_EQ(blocks(flats[0], p, q), blocks(flats[0], q, p));
    EXPECT_NE(blocks(flats[0], p, q), is_sightline(flats, p, q));
    return blocks(flats[0], p, q);
  };
  EXPECT_TRUE(blocked(at(1, 1, 1), at(1, 1, -1)));
  EXPECT_TRUE(blocked(at(0, 1, 1), at(0, 1, -1)));   // its edge
  EXPECT_TRUE(blocked(at(-1, 0, 1), at(1, 0, -1)));  // its corner
  EXPECT_FALSE(blocked(at(0, Rational(-tiny()), 1), at(0, Rational(-tiny()), -1)));
  EXPECT_FALSE(blocked(at(1, 1, 1), at(1, 1, 0)));  // it ends there, or before
  EXPECT_FALSE(blocked(at(1, 1, 2), at(1, 1, 1)));
  // In its plane: across, along an edge, inside, by a corner only, up to it, past it.
  EXPECT_TRUE(blocked(at(-1, 1, 0), at(3, 1, 0)));
  EXPECT_TRUE(blocked(at(-1, 2, 0), at(1, 2, 0)));
  EXPECT_TRUE(blocked(at(ratio(1, 2), 1, 0), at(1, 1, 0)));
  EXPECT_TRUE(blocked(at(-1, 1, 0), at(1, -1, 0)));
  EXPECT_FALSE(blocked(at(-1, 1, 0), at(0, 1, 0)));
  EXPECT_FALSE(blocked(at(-1, -1, 0), at(0, 0, 0)));
  EXPECT_FALSE(blocked(at(-1, 3, 0), at(3, 3, 0)));
  EXPECT_FALSE(blocked(at(3, 1, 0), at(4, 1, 0)));
}

// ---- At random: every family

/// For each family.
class Oracle_in_family : public testing::TestWithParam<Family> {
 protected:
  template <class Check>
  void for_each_case(Check check) const {
    for (std::uint64_t seed = 0; seed < seeds_each; ++seed)
      for (const Case& made : view_scenes::make(GetParam(), seed)) {
        SCOPED_TRACE(made.name);
        const Scene scene(made.soup);
        Random random(seed);
        check(scene, flats_of(scene), made.eye, random);
        if (HasFatalFailure()) return;
      }
  }
};

/// A point strictly inside a convex polygon, unlikely to be special.
Exact_point inside_of(const Points& polygon, Random& random) {
  Exact_point sum{0, 0, 0};
  Rational total = 0;
  for (const Exact_point& p : polygon) {
    const Rational weight = static_cast<long>(random.between(1, 100003));
    sum = along(sum, weight, p);
    total += weight;
  }
  return along(at(0, 0, 0), Rational(1 / total), sum);
}

TEST_P(Oracle_in_family, has_planar_pieces_whose_front_is_their_planes) {
  for_each_case([](const Scene& scene, const Flats& flats, const Exact_point&, Random&) {
    ASSERT_EQ(flats.size(), scene.pieces().size());
    ASSERT_GT(flats.size(), 0u);
    for (std::size_t i = 0; i < flats.size(); ++i) {
      const std::array<Rational, 4> h = scene.file_coefficients(scene.pieces()[i].support);
      const Exact_point normal = at(h[0], h[1], h[2]);
      ASSERT_TRUE(is_zero(cross(normal, flats[i].plane.normal)));
      ASSERT_GT(dot(normal, flats[i].plane.normal), 0);
      for (const Exact_point& p : flats[i].corners) {
        ASSERT_EQ(flats[i].height(p), 0);
        ASSERT_EQ(Rational(dot(normal, p) + h[3]), 0);
        ASSERT_EQ(flats[i].holds(p), 0);
      }
      ASSERT_EQ(flats[i].holds(centroid(flats[i].corners)), 1);
      ASSERT_GT(flats[i].area(), 0);
    }
  });
}

TEST_P(Oracle_in_family, is_hit_first_in_generic_directions_where_the_part_is_seen) {
  std::size_t directions = 0, generic_ones = 0, hits = 0;
  for_each_case([&](const Scene& scene, const Flats& flats, const Exact_point& eye, Random& random) {
    const std::vector<Region> regions = visible_parts(flats, eye);
    for (std::size_t k = 0; k < 50; ++k) {
      const Exact_point direction = k % 2 == 0 ? random_direction(random) : random_direction_at(flats, eye, random);
      bool generic = false;
      const std::optional<std::uint32_t> first =
          k == 0 ? first_hit(scene, eye, direction, &generic) : first_hit(flats, eye, direction, &generic);
      ++directions;
      generic_ones += generic;
      hits += generic && first.has_value();
      if (!generic) continue;
      for (std::uint32_t i = 0; i < flats.size(); ++i) {
        const std::optional<Rational> t = crossing(flats[i], eye, direction);
        if (!t) {
          ASSERT_NE(first, i);
          continue;
        }
        const Exact_point q = along(eye, *t, direction);
        ASSERT_EQ(holds(regions[i].parts, flats[i].plane.normal, q) >= 0, first == i) << "piece " << i;
        ASSERT_LE(std::count_if(regions[i].parts.begin(), regions[i].parts.end(),
                                [&](const Points& part) { return holds(part, flats[i].plane.normal, q) > 0; }),
                  1);
        // By segments: a piece is hit first where nothing that is not coplanar or edge-on is in the way.
        const bool free = std::none_of(flats.begin(), flats.end(), [&](const Flat& other) {
          return sgn(other.height(eye)) != 0 && !coplanar(flats[i], other) && blocks(other, eye, q);
        });
        if (first == i) {
          ASSERT_TRUE(free);
        } else if (free && flats[i].holds(q) > 0) {
          ASSERT_TRUE(first && coplanar(flats[i], flats[*first]) && wins(flats[*first], flats[i], eye));
        }
      }
    }
  });
  EXPECT_GT(2 * generic_ones, directions);
  EXPECT_GT(10 * hits, directions);
}

TEST_P(Oracle_in_family, is_seen_in_parts_no_larger_than_its_pieces_and_from_their_inside) {
  for_each_case([](const Scene& scene, const Flats& flats, const Exact_point& eye, Random& random) {
    const std::vector<Region> regions = visible_parts(scene, eye);
    const std::set<Face_id> by_law = visible_faces(scene, eye);
    std::set<Face_id> reached;  // faces with a point inside that ends a sightline but for coplanar and edge-on faces
    std::map<std::pair<Face_id, bool>, Rational> areas;
    ASSERT_EQ(regions.size(), flats.size());
    for (std::uint32_t i = 0; i < flats.size(); ++i) {
      const Region& region = regions[i];
      const Flat& flat = flats[i];
      ASSERT_EQ(region.piece, i);
      ASSERT_EQ(region.face, scene.pieces()[i].face);
      ASSERT_EQ(region.front, sgn(flat.height(eye)) > 0);
      ASSERT_LE(region.area, flat.area());
      ASSERT_EQ(region.parts.empty(), region.area == 0);
      if (!region.parts.empty()) areas[{region.face, region.front}] += region.area;
      for (const Points& part : region.parts) {
        for (const Exact_point& p : part) {
          ASSERT_EQ(flat.height(p), 0);
          ASSERT_GE(flat.holds(p), 0);
        }
        const Exact_point q = inside_of(part, random);
        ASSERT_EQ(holds(part, flat.plane.normal, q), 1);
        ASSERT_EQ(flat.holds(q), 1);
        bool generic = false;
        const std::optional<std::uint32_t> first = first_hit(flats, eye, minus(q, eye), &generic);
        ASSERT_TRUE(!generic || first == i);
      }
      ASSERT_TRUE(!region.front || region.parts.empty() || by_law.count(region.face));
      // The law's part of the piece, and what is in the way of the rest.
      const std::vector<Points> free = seen_of(flats, i, eye, false);
      ASSERT_GE(projected_area(free, flat.plane.normal), region.area);
      for (std::size_t k = 0; k < 8; ++k) {
        const Exact_point q = inside_of(flat.corners, random);
        if (is_zero(minus(q, eye))) continue;
        bool blocked = false;
        for (const Flat& other : flats)
          if (sgn(other.height(eye)) != 0 && !coplanar(flat, other)) blocked |= blocks(other, eye, q);
        ASSERT_EQ(blocked || sgn(flat.height(eye)) == 0, holds(free, flat.plane.normal, q) < 0);
      }
      for (const Points& part : free) {
        const Exact_point q = inside_of(part, random);
        const bool sightline =
            std::none_of(flats.begin(), flats.end(), [&](const Flat& other) { return blocks(other, eye, q); });
        if (region.front && sightline) reached.insert(region.face);
      }
    }
    ASSERT_EQ(areas, visible_areas(regions));
    ASSERT_EQ(reached, by_law);
    for (const auto& [side, sum] : areas) ASSERT_EQ(visible_area(regions, side.first, side.second), sum);
  });
}

/// What a convex polygon covers of one face of a cube around the eye, by central projection.
sightline::Flat_polygon on_cube_face(const Points& polygon, const Exact_point& eye, std::size_t axis, long sign) {
  Points cut = polygon;
  for (const std::size_t other : {(axis + 1) % 3, (axis + 2) % 3})
    for (const long side : {1, -1}) {
      Exact_point normal = at(0, 0, 0);
      normal[axis] = sign;
      normal[other] = side;
      cut = clipped(cut, {normal, dot(normal, eye)});
    }
  std::vector<sightline::Flat_polygon::Point> points;
  for (const Exact_point& p : cut) {
    const Exact_point w = minus(p, eye);
    points.push_back({Rational(w[(axis + 1) % 3] / w[axis]), Rational(w[(axis + 2) % 3] / w[axis])});
  }
  return sightline::Flat_polygon::hull(points);
}

TEST_P(Oracle_in_family, is_seen_once_in_every_direction_that_meets_it) {
  for_each_case([](const Scene&, const Flats& flats, const Exact_point& eye, Random&) {
    const std::vector<Region> regions = visible_parts(flats, eye);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const long sign : {1, -1}) {
        // What the pieces cover together: each without those before it.
        std::vector<sightline::Flat_polygon> before;
        Rational covered = 0, seen = 0;
        for (std::size_t i = 0; i < flats.size(); ++i) {
          if (sgn(flats[i].height(eye)) == 0) continue;
          const sightline::Flat_polygon whole = on_cube_face(flats[i].corners, eye, axis, sign);
          if (whole.empty()) continue;
          std::vector<sightline::Flat_polygon> left{whole};
          for (const sightline::Flat_polygon& other : before) {
            std::vector<sightline::Flat_polygon> next;
            for (const sightline::Flat_polygon& polygon : left)
              for (const sightline::Flat_polygon& rest : polygon.without(other)) next.push_back(rest);
            left = next;
          }
          for (const sightline::Flat_polygon& polygon : left) covered += polygon.area();
          before.push_back(whole);
        }
        // What is seen, part by part. That no two overlap follows: hit first, one by one, above.
        for (const Region& region : regions)
          for (const Points& part : region.parts) seen += on_cube_face(part, eye, axis, sign).area();
        ASSERT_EQ(seen, covered) << "axis " << axis << ", sign " << sign;
        ASSERT_LE(covered, 4);
      }
  });
}

TEST_P(Oracle_in_family, has_edges_whose_points_end_sightlines_in_the_intervals_and_nowhere_else) {
  std::size_t free_ones = 0, hidden_ones = 0, partial = 0;
  for_each_case([&](const Scene& scene, const Flats& flats, const Exact_point& eye, Random& random) {
    std::vector<std::array<Exact_point, 2>> edges;
    for (const Flat& flat : flats)
      for (std::size_t k = 0; k < flat.corners.size(); ++k)
        edges.push_back({flat.corners[k], flat.corners[(k + 1) % flat.corners.size()]});
    for (std::size_t k = 0; k < 8; ++k) {  // others: between corners, from the eye's neighbourhood, through faces
      const Points &f = flats[random.below(flats.size())].corners, &g = flats[random.below(flats.size())].corners;
      edges.push_back({f[random.below(f.size())], along(eye, 1, view_scenes::lattice(random, 3))});
      edges.push_back({centroid(f), g[random.below(g.size())]});
    }
    for (const std::array<Exact_point, 2>& edge : edges) {
      const Exact_point &a = edge[0], &b = edge[1];
      const Intervals free = visible_on_edge(scene, eye, a, b);
      if (is_zero(cross(minus(a, eye), minus(b, eye)))) {
        ASSERT_TRUE(free.empty());
        continue;
      }
      const auto ends_sightlines = [&](const Rational& from,
                                       const Rational& to) {  // how many of four points that are unlikely to be special
        int count = 0;
        for (int k = 0; k < 4; ++k) {
          const Rational s = Rational(from + (to - from) * ratio(random.between(1, 100002), 100003));
          count += is_sightline(flats, eye, along(a, s, minus(b, a)));
        }
        return count;
      };
      Rational reached = 0;
      for (const Interval& interval : free) {
        ASSERT_LT(interval.from, interval.to);
        ASSERT_LE(reached, interval.from);
        ASSERT_TRUE(sgn(reached) == 0 || reached < interval.from);
        ASSERT_EQ(ends_sightlines(interval.from, interval.to), 4);
        if (reached < interval.from) {
          ASSERT_EQ(ends_sightlines(reached, interval.from), 0);
        }
        reached = interval.to;
      }
      ASSERT_LE(reached, 1);
      if (reached < 1) {
        ASSERT_EQ(ends_sightlines(reached, 1), 0);
      }
      const bool all = free == Intervals{{0, 1}};
      ++(all ? free_ones : free.empty() ? hidden_ones : partial);
    }
  });
  EXPECT_GT(free_ones, 0u);
  EXPECT_GT(hidden_ones, 0u);
  EXPECT_GT(partial, 0u);
}

INSTANTIATE_TEST_SUITE_P(, Oracle_in_family, testing::ValuesIn(view_scenes::families),
                         [](const auto& tested) { return std::string(view_scenes::name(tested.param)); });

// ---- The families

TEST(Scene_families, hold_what_they_are_for) {
  for (const Family family : view_scenes::families) {
    SCOPED_TRACE(view_scenes::name(family));
    std::size_t cases = 0, coplanar_pairs = 0, ties = 0, edge_on = 0, holding = 0, crossing_pairs = 0, in_line = 0,
                largest = 0;
    for (std::uint64_t seed = 0; seed < 2 * seeds_each; ++seed)
      for (const Case& made : view_scenes::make(family, seed)) {
        const Scene scene(made.soup);
        const Flats flats = flats_of(scene);
        ++cases;
        largest = std::max(largest, made.soup.face_count());
        for (std::size_t i = 0; i < flats.size(); ++i) {
          const bool in_plane = sgn(flats[i].height(made.eye)) == 0;
          edge_on += in_plane;
          holding += in_plane && flats[i].holds(made.eye) >= 0;
          for (std::size_t j = 0; j < flats.size(); ++j) {
            if (i == j) continue;
            if (coplanar(flats[i], flats[j])) {
              ++coplanar_pairs;
              ties += !in_plane && seen_of({flats[i], flats[j]}, 0, made.eye, true) !=
                                       seen_of({flats[i], flats[j]}, 0, made.eye, false);
              continue;
            }
            for (std::size_t k = 0; k < flats[i].corners.size(); ++k) {
              const Exact_point &p = flats[i].corners[k], &q = flats[i].corners[(k + 1) % flats[i].corners.size()];
              const Rational here = flats[j].height(p), next = flats[j].height(q);
              crossing_pairs +=
                  sgn(here) * sgn(next) < 0 && flats[j].holds(along(p, here / (here - next), minus(q, p))) > 0;
              for (const Exact_point& other : flats[j].corners)
                in_line += !is_zero(minus(other, p)) && is_zero(cross(minus(p, made.eye), minus(other, made.eye)));
            }
          }
        }
      }
    EXPECT_GE(cases, 2 * seeds_each);
    EXPECT_LE(largest, 14u);
    const auto is_one_of = [&](std::initializer_list<Family> some) {
      return std::find(some.begin(), some.end(), family) != some.end();
    };
    if (is_one_of({Family::uniform, Family::crossing, Family::far, Family::tiny, Family::turned})) {
      EXPECT_GT(crossing_pairs, cases / 4);
    }
    if (is_one_of({Family::coplanar, Family::joined, Family::boxes})) {
      EXPECT_GT(coplanar_pairs, cases);
    }
    if (is_one_of({Family::coplanar})) {
      EXPECT_GT(ties, cases);
    }
    if (is_one_of({Family::edge_on, Family::touching})) {
      EXPECT_GT(edge_on, cases);
    }
    if (is_one_of({Family::touching})) {
      EXPECT_GT(holding, cases);
    }
    if (is_one_of({Family::aligned, Family::concurrent})) {
      EXPECT_GT(in_line, cases);
    }
  }
}

TEST(Products, are_those_that_are_reduced_at_each_step) {
  sightline::generate::Random random(1);
  const auto any = [&] {
    const auto parts = static_cast<long>(random.between(1, 6));
    return random.chance(1, 4) ? Rational(0) : ratio(static_cast<long>(random.between(-20, 20)), parts);
  };
  for (int trial = 0; trial < 2000; ++trial) {
    const Exact_point a{any(), any(), any()}, b{any(), any(), any()};
    const Rational by_steps = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    EXPECT_EQ(dot(a, b), by_steps);
    EXPECT_EQ(dot(a, b).get_den(), by_steps.get_den()) << "reduced";
    const Exact_point n = cross(a, b);
    EXPECT_EQ(n, (Exact_point{Rational(a[1] * b[2] - a[2] * b[1]), Rational(a[2] * b[0] - a[0] * b[2]),
                              Rational(a[0] * b[1] - a[1] * b[0])}));
  }
}

TEST(Scene_families, are_the_same_for_the_same_seed) {
  for (const Family family : view_scenes::families) {
    const std::vector<Case> once = view_scenes::make(family, 3), again = view_scenes::make(family, 3),
                            other = view_scenes::make(family, 4);
    ASSERT_EQ(once.size(), again.size());
    const auto points = [](const Case& made) {
      Points all{made.eye};
      for (sightline::Point_id p = 0; p < made.soup.point_count(); ++p) all.push_back(made.soup.point(p));
      return all;
    };
    for (std::size_t k = 0; k < once.size(); ++k) EXPECT_EQ(points(once[k]), points(again[k]));
    EXPECT_NE(points(once[0]), points(other[0]));
  }
}

}  // namespace
