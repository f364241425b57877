// Visible surfaces against brute force: exact areas and points, directions, the law, other kernels, any number of
// threads.

#include "support.h"
#include "../sample.h"

#include <sightline/algorithms/point_visibility/kernels.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/soups.h>

#include <gtest/gtest.h>

#include <cstdlib>

namespace sightline::see_test {
namespace {

/// Scenes of each family: as many as SIGHTLINE_LONG says; one under sanitizers.
std::uint64_t seeds() {
  const char* text = std::getenv("SIGHTLINE_LONG");
  return text == nullptr ? test_scenes::sample(std::uint64_t{6}) : std::strtoull(text, nullptr, 10);
}

void expect_as_brute_force(const view_scenes::Case& given) {
  SCOPED_TRACE(given.name);
  const Scene scene(given.soup);
  const Exact_view view(scene, given.eye);
  const Piece_boxes boxes(scene);
  const Visible_surface<Exact_view> surface = visible_surface(view, boxes, Visible_options{.threads = 1});

  // The same points of each piece, with the same area; nothing of it twice.
  const auto parts = polygons(view, surface);
  const oracle::Flats flats = oracle::flats_of(scene);
  std::vector<std::vector<oracle::Points>> expected(flats.size());
  for (const oracle::Region& region : oracle::visible_parts(flats, given.eye)) expected[region.piece] = region.parts;
  ASSERT_NO_FATAL_FAILURE(expect_same_points(flats, parts, expected));

  // The faces that the law calls visible.
  const std::set<Face_id> lawful = oracle::visible_faces(flats, given.eye);
  ASSERT_EQ(std::vector<Face_id>(lawful.begin(), lawful.end()), surface.visible);
}

class See : public testing::TestWithParam<view_scenes::Family> {};

TEST_P(See, is_seen_as_brute_force_sees_it) {
  for (std::uint64_t seed = 1; seed <= seeds() && !HasFatalFailure(); ++seed)
    for (const view_scenes::Case& given : view_scenes::make(GetParam(), seed)) expect_as_brute_force(given);
}

TEST_P(See, shows_in_each_direction_what_a_ray_meets_first) {
  generate::Random random(7);
  std::size_t compared = 0;
  for (std::uint64_t seed = 1; seed <= test_scenes::sample(std::uint64_t{6}); ++seed)
    for (const view_scenes::Case& given : view_scenes::make(GetParam(), seed)) {
      SCOPED_TRACE(given.name);
      const Scene scene(given.soup);
      const Exact_view view(scene, given.eye);
      const Visible_surface<Exact_view> surface = visible_surface(view, Piece_boxes(scene));
      const oracle::Flats flats = oracle::flats_of(scene);
      for (int k = 0; k < 100; ++k) {
        const Exact_point direction = k % 2 == 0 || flats.empty()
                                          ? oracle::random_direction(random)
                                          : oracle::random_direction_at(flats, given.eye, random);
        bool generic = true;
        const std::optional<std::uint32_t> hit = oracle::first_hit(flats, given.eye, direction, &generic);
        if (!generic) continue;
        ++compared;
        for (const std::uint32_t seen : seen_in(view, surface, direction))
          ASSERT_EQ(seen, hit.value_or(surface.nothing));
        ASSERT_FALSE(seen_in(view, surface, direction).empty());
      }
    }
  EXPECT_GT(compared, test_scenes::least(100u));
}

TEST_P(See, is_the_same_in_every_exact_kernel) {
  for (std::uint64_t seed = 1; seed <= test_scenes::sample(std::uint64_t{4}); ++seed)
    for (const view_scenes::Case& given : view_scenes::make(GetParam(), seed)) {
      SCOPED_TRACE(given.name);
      const Scene scene(given.soup);
      const Piece_boxes boxes(scene);
      const Exact_view view(scene, given.eye);
      const auto exactly = visible_surface(view, boxes);
      const Number_view<CGAL::Gmpq> rational(scene, given.eye);
      const auto rationally = visible_surface(rational, boxes);
      ASSERT_EQ(exactly.visible, rationally.visible);
      const auto parts = polygons(view, exactly), others = polygons(rational, rationally);
      const oracle::Flats flats = oracle::flats_of(scene);
      for (std::size_t i = 0; i < flats.size(); ++i)
        ASSERT_TRUE(oracle::same_points(parts[i], others[i], flats[i].plane.normal)) << "face " << flats[i].face;
    }
}

TEST_P(See, survives_doubles_and_floats) {
  for (std::uint64_t seed = 1; seed <= seeds(); ++seed)
    for (const view_scenes::Case& given : view_scenes::make(GetParam(), seed)) {
      const Scene scene(given.soup);
      const Piece_boxes boxes(scene);
      EXPECT_GE(visible_surface(Number_view<double>(scene, given.eye), boxes).counters.regions, 8u);
      EXPECT_GE(visible_surface(Number_view<float>(scene, given.eye), boxes).counters.regions, 8u);
    }
}

/// Tiles on a floor, with higher ids, so that the floor is shown in their place: visible by the law all the same,
/// unless walls hide them.
TEST(Ties, tell_which_faces_the_law_calls_visible) {
  using view_scenes::rectangle, view_scenes::ratio;
  const view_scenes::Points floor = rectangle(-20, 20, -20, 20, 0);
  const view_scenes::Points tile = rectangle(-1, 1, 8, 9, 0), wall{{-3, 5, 0}, {3, 5, 0}, {3, 5, 4}, {-3, 5, 4}};
  const auto visible = [](const std::vector<view_scenes::Points>& faces, const Exact_point& eye) {
    const Scene scene(view_scenes::soup_of(faces));
    const Exact_view view(scene, eye);
    return visible_surface(view, Piece_boxes(scene)).visible;
  };
  EXPECT_EQ(visible({floor, tile}, {0, 0, 2}), (std::vector<Face_id>{0, 1}));
  EXPECT_EQ(visible({floor, tile, wall}, {0, 0, 2}),
            (std::vector<Face_id>{0, 2}));  // all of the tile is behind the wall
  EXPECT_EQ(visible({floor, tile, wall}, {0, 0, 30}), (std::vector<Face_id>{0, 1, 2}));
  EXPECT_EQ(visible({tile, rectangle(-1, 0, 8, 9, 0), rectangle(0, 1, 8, 9, 0)}, {0, 0, 2}),
            (std::vector<Face_id>{0, 1, 2}));
  EXPECT_EQ(visible({view_scenes::reversed(floor), tile}, {0, 0, 2}),
            (std::vector<Face_id>{1}));  // the floor's back gives way
  EXPECT_EQ(visible({rectangle(-1, 0, 8, 9, 0), rectangle(0, 1, 8, 9, 0), tile}, {0, 0, 2}),
            (std::vector<Face_id>{0, 1, 2}));

  generate::Random random(3);
  const auto number = [&](long low, long high) { return Rational(static_cast<long>(random.between(low, high))); };
  for (int round = 0; round < 150 && !testing::Test::HasFatalFailure(); ++round) {
    std::vector<view_scenes::Points> faces{floor};
    for (int k = 0; k < 4; ++k) {
      const Rational x = number(-9, 9), y = number(2, 12);
      if (k % 2 == 0)
        faces.push_back(
            {{x, y, 0}, {x + number(1, 3), y + number(-1, 1), 0}, {x + number(-1, 1), y + number(2, 3), 0}});
      else faces.push_back(rectangle(x, x + number(1, 3), y, y + number(1, 3), 0));
    }
    for (int k = 0; k < 2; ++k) {
      const Rational x = number(-6, 6), y = number(1, 7), w = number(1, 6), h = number(1, 3), d = number(-2, 2);
      faces.push_back({{x, y, 0}, {x + w, y + d, 0}, {x + w, y + d, h}, {x, y, h}});
    }
    expect_as_brute_force(
        {"tiles " + std::to_string(round), view_scenes::soup_of(faces), {number(-1, 1), number(-2, 0), number(1, 3)}});
  }
}

TEST(Crossings, are_cut_where_many_faces_that_cover_a_region_cross) {
  for (std::uint64_t seed = 1; seed <= test_scenes::sample(std::uint64_t{8}); ++seed)
    for (const Exact_point& eye :
         {Exact_point{view_scenes::ratio(1, 3), -2, view_scenes::ratio(1, 10)},
          Exact_point{view_scenes::ratio(1, 2), view_scenes::ratio(1, 2), view_scenes::ratio(1, 2)}}) {
      const Scene scene(generate::soup(40, 0.5, seed));
      const Exact_view view(scene, eye);
      const auto surface = visible_surface(view, Piece_boxes(scene));
      EXPECT_GT(surface.counters.crossings, 20u);
      const std::set<Face_id> lawful = oracle::visible_faces(scene, eye);
      EXPECT_EQ(std::vector<Face_id>(lawful.begin(), lawful.end()), surface.visible);
    }
}

// ---- Lattices: squares across a whole cube, of which few are seen

TEST(Lattices, are_seen_as_brute_force_sees_them) {
  using view_scenes::ratio;
  for (const Exact_point& eye :
       {Exact_point{-2, -3, ratio(7, 3)}, Exact_point{ratio(1, 3), ratio(5, 4), ratio(12, 5)}, Exact_point{-1, 1, 2}})
    expect_as_brute_force({"lattice", generate::lattice(3), eye});
}

TEST(Lattices, are_cut_by_what_the_middle_of_a_region_meets) {
  // From outside two sides of the cube are seen. Planes of squares that they hide are nearer there, but not the
  // squares.
  for (const std::size_t n : {100UL, 333UL}) {
    const Scene scene(generate::lattice(n));
    const auto k = static_cast<long>(n);
    const Exact_view view(
        scene, {view_scenes::ratio(-2 * k, 5), view_scenes::ratio(-3 * k, 5), view_scenes::ratio(7 * k, 10)});
    const auto surface = visible_surface(view, Piece_boxes(scene));
    EXPECT_EQ(surface.from_behind, (std::vector<Face_id>{0, static_cast<Face_id>(n + 1)}));
    EXPECT_LT(surface.counters.regions, 30u) << n;
    EXPECT_LT(surface.counters.looked_at, 16 * n) << n;
  }
}

TEST(Lattices, are_hidden_by_all_that_cover_a_region_though_these_cross) {
  for (const std::size_t n : {100UL, 1000UL}) {
    const Scene scene(generate::lattice(n));
    const auto k = static_cast<long>(n);
    const Exact_view view(scene, {view_scenes::ratio(5 * k + 3, 10), view_scenes::ratio(5 * k + 4, 10),
                                  view_scenes::ratio(7 * k + 5, 10)});
    const auto surface = visible_surface(view, Piece_boxes(scene));
    EXPECT_EQ(surface.visible.size() + surface.from_behind.size(), 6u);  // the walls of a cell
    EXPECT_LT(surface.counters.regions, 400u) << n;
    EXPECT_LT(surface.counters.looked_at, 1000u) << n;
  }
}

// ---- Many of one plane, many corners

using view_scenes::Points;
using view_scenes::Random;

/// Triangles in the plane z = 0, each inside the next.
std::vector<Points> nested_triangles(long count) {
  std::vector<Points> faces;
  for (long k = 1; k <= count; ++k) faces.push_back({{-2 * k, -k, 0}, {3 * k, -k, 0}, {0, 4 * k, 0}});
  return faces;
}

TEST(Piles, are_seen_as_brute_force_sees_them) {
  for (std::uint64_t seed = 1; seed <= test_scenes::sample(std::uint64_t{12}) && !testing::Test::HasFailure(); ++seed) {
    Random random(seed);
    const auto any = [&](long least, long most) { return static_cast<long>(random.between(least, most)); };
    std::vector<Points> faces = nested_triangles(seed % 2 == 0 ? 9 : 0);
    for (int k = 0; k < 9; ++k) {
      const long x = any(-9, 5), y = any(-9, 5);
      faces.push_back(view_scenes::rectangle(x, x + any(2, 9), y, y + any(2, 9), 0));
      if (random.chance(1, 3)) faces.back() = view_scenes::reversed(faces.back());
    }
    faces.push_back({{-3, -3, -2}, {4, -2, -2}, {2, 5, 3}});
    if (seed % 3 != 0) random.shuffle(faces);
    expect_as_brute_force(
        {"pile " + std::to_string(seed), view_scenes::soup_of(faces), {any(-3, 3), any(-3, 3), any(1, 3)}});
  }
}

TEST(Piles, of_nested_faces_take_time_as_their_number) {
  for (const long count : {100L, 400L})
    for (const bool outwards : {true, false}) {
      std::vector<Points> faces = nested_triangles(count);
      if (!outwards) std::reverse(faces.begin(), faces.end());
      const Scene scene(view_scenes::soup_of(faces));
      const auto surface = visible_surface(Exact_view(scene, {1, 1, 1}), Piece_boxes(scene));
      EXPECT_EQ(surface.visible.size(), static_cast<std::size_t>(count));
      EXPECT_LT(surface.counters.regions, 24 * static_cast<std::uint64_t>(count));  // and its logarithm
      EXPECT_LT(surface.counters.looked_at, 16 * static_cast<std::uint64_t>(count));
    }
}

TEST(Faces_of_many_corners, are_seen_as_brute_force_sees_them) {
  for (const long count : {32L, 33L, 62L, 63L, 64L, 93L, 94L, 95L, 130L}) {
    Points curve;  // convex
    for (long k = 0; k < count; ++k) curve.push_back({k - count / 2, (k - count / 2) * (k - count / 2), 0});
    expect_as_brute_force({std::to_string(count) + " corners",
                           view_scenes::soup_of({curve, {{-2, 3, 2}, {5, 2, 2}, {1, 40, 3}}}),
                           {1, 20, 9}});
  }
}

TEST(Faces_of_many_corners, may_be_stars) {
  for (const long inner : {5000L, 9900L}) {  // needles around a disc, and a rough disc
    constexpr long count = 2000;
    Points star;
    for (long k = 0; k < count; ++k) {
      const double angle = 2 * std::acos(-1.0) * static_cast<double>(k) / count;
      const double radius = static_cast<double>(k % 2 == 0 ? 10000 : inner);
      star.push_back({std::lround(1000 * radius * std::cos(angle)), std::lround(1000 * radius * std::sin(angle)), 0});
    }
    const Scene scene(view_scenes::soup_of({star}));
    ASSERT_TRUE(scene.set_aside().empty());
    const auto surface = visible_surface(Exact_view(scene, {1000, 1000, 5000000}), Piece_boxes(scene));
    EXPECT_LT(surface.counters.regions, 4 * scene.pieces().size()) << inner;
    EXPECT_LT(surface.counters.opened, 4 * scene.pieces().size()) << inner;
  }
}

TEST(Faces_of_many_corners, take_time_as_their_number) {
  Points curve;
  for (long k = -1000; k < 1000; ++k) curve.push_back({k, k * k, 0});
  const Scene scene(view_scenes::soup_of({curve}));
  const auto surface = visible_surface(Exact_view(scene, {1, 1, 5}), Piece_boxes(scene));
  EXPECT_LT(surface.counters.regions, 4 * curve.size());
  EXPECT_LT(surface.counters.looked_at, 40 * curve.size());
}

INSTANTIATE_TEST_SUITE_P(All, See, testing::ValuesIn(view_scenes::families),
                         [](const auto& of) { return std::string(view_scenes::name(of.param)); });

}  // namespace
}  // namespace sightline::see_test
