// Shadows: worked by hand, by rays to the light, and from suns as from lights that are far away.

#include "../sample.h"

#include <gtest/gtest.h>

#include <sightline/algorithms/shadow/shadow.h>
#include <sightline/algorithms/shadow/volume.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/laws/shadow.h>

#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace sightline;

namespace {

Face_id add(Polygon_soup& soup, const std::vector<Exact_point>& corners) {
  std::vector<Point_id> loop;
  for (const Exact_point& p : corners) loop.push_back(soup.add_point(p[0], p[1], p[2]));
  return soup.add_face(loop);
}
/// A square at height z, seen from above.
Face_id level(Polygon_soup& soup, const Rational& x, const Rational& y, const Rational& z, const Rational& size) {
  return add(soup, {{x, y, z}, {x + size, y, z}, {x + size, y + size, z}, {x, y + size, z}});
}
void cube(Polygon_soup& soup, const Rational& low, const Rational& high) {
  const auto corner = [&](int k) {
    return Exact_point{(k & 1) != 0 ? high : low, (k & 2) != 0 ? high : low, (k & 4) != 0 ? high : low};
  };
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    add(soup, {corner(a), corner(b), corner(c), corner(d)});
}

/// Lit and shadowed areas of each face, along z, by what shadows it; ~0: lit. Pre: level faces.
std::map<std::pair<Face_id, Face_id>, Rational> areas(const Polygon_soup& soup, const Exact_point& light, bool is_sun,
                                                      bool two_sided = false) {
  const Scene scene(soup);
  const Piece_boxes boxes(scene);
  Shadow_options options;
  options.two_sided = two_sided;
  const Shadows made = is_sun ? shadows(Exact_view(scene, Sun{light}), boxes, options)
                              : shadows(Exact_view(scene, light), boxes, options);
  EXPECT_EQ(harness::flaw_of(made, soup, scene, light, is_sun, two_sided), "");
  std::map<std::pair<Face_id, Face_id>, Rational> all;
  for (const Shadow_part& part : made.parts)
    all[{scene.pieces()[part.piece].face, part.is_lit() ? ~0u : scene.pieces()[part.by].face}] +=
        abs(harness::area_of(part.vertices, 2)) / 2;
  return all;
}

using Areas = std::map<std::pair<Face_id, Face_id>, Rational>;
constexpr Face_id lit = ~0u;

TEST(Shadow, the_face_that_is_nearest_to_the_light_shadows) {
  Polygon_soup soup;
  level(soup, 0, 0, 0, 8);
  level(soup, 2, 2, 1, 2);  // under the next one, in part
  level(soup, 2, 2, 2, 1);
  EXPECT_EQ(areas(soup, {0, 0, 1}, true),
            (Areas{{{0, lit}, 60}, {{0, 1}, 3}, {{0, 2}, 1}, {{1, lit}, 3}, {{1, 2}, 1}, {{2, lit}, 1}}));
  // From a point twice as high as the upper one, above its corner: its shadow is four times as large.
  const Areas from_point = areas(soup, {2, 2, 4}, false);
  EXPECT_EQ(from_point.at({0, 2}), 4);
  EXPECT_EQ(from_point.at({1, 2}), Rational(9, 4));
  EXPECT_EQ(from_point.at({0, lit}), Rational(64 - 4) - from_point.at({0, 1}));
  EXPECT_EQ(from_point.at({0, 1}), Rational(64, 9) - 4);
}

TEST(Shadow, a_slanted_sun_casts_long_shadows) {
  Polygon_soup soup;
  level(soup, 0, 0, 0, 8);
  level(soup, 1, 1, 2, 1);
  EXPECT_EQ(areas(soup, {-2, -1, 1}, true), (Areas{{{0, lit}, 63}, {{0, 1}, 1}, {{1, lit}, 1}}));
  // From (9, 7) on it is off the floor.
  EXPECT_EQ(areas(soup, {-4, -3, 1}, true), (Areas{{{0, lit}, 64}, {{1, lit}, 1}}));
}

TEST(Shadow, fronts_alone_are_lit_unless_both_sides_count) {
  Polygon_soup soup;
  level(soup, 0, 0, 0, 4);
  level(soup, 1, 1, -1, 1);
  EXPECT_EQ(areas(soup, {0, 0, -1}, true), Areas{});
  EXPECT_EQ(areas(soup, {0, 0, -1}, true, true), (Areas{{{0, lit}, 15}, {{0, 1}, 1}, {{1, lit}, 1}}));
}

TEST(Shadow, faces_in_one_plane_are_all_lit_there) {
  Polygon_soup soup;
  level(soup, 0, 0, 0, 4);
  level(soup, 1, 1, 0, 2);
  add(soup, {{2, 2, 0}, {2, 5, 0}, {5, 5, 0}, {5, 2, 0}});  // its front below
  EXPECT_EQ(areas(soup, {1, 1, 5}, false), (Areas{{{0, lit}, 16}, {{1, lit}, 4}}));
  EXPECT_EQ(areas(soup, {0, 0, 1}, true, true), (Areas{{{0, lit}, 16}, {{1, lit}, 4}, {{2, lit}, 9}}));
}

TEST(Shadow, a_light_in_a_plane_on_a_face_on_an_edge_or_at_a_corner_is_as_see_has_it) {
  Polygon_soup soup;
  cube(soup, 0, 2);
  level(soup, -5, -5, -3, 12);
  const Scene scene(soup);
  const Piece_boxes boxes(scene);
  // In the plane of the top, on it, on an edge of it, at a corner, within the cube.
  for (const Exact_point& light :
       {Exact_point{4, 4, 2}, {1, 1, 2}, {1, 0, 2}, {0, 0, 2}, {1, 1, 1}, {2, 2, 2}, {1, 1, 0}}) {
    const Exact_view view(scene, light);
    for (const bool two_sided : {false, true}) {
      Shadow_options options;
      options.two_sided = two_sided;
      EXPECT_EQ(harness::flaw_of(shadows(view, boxes, options), soup, scene, light, false, two_sided), "");
    }
  }
  EXPECT_TRUE(shadows(Exact_view(scene, {1, 1, 1}), boxes).lit.empty()) << "a lamp in a closed body lights nothing";
}

TEST(Shadow, a_sun_is_a_light_far_away) {
  const Polygon_soup soup = generate::make("city", 12, 3);
  const Scene scene(soup);
  const Piece_boxes boxes(scene);
  const std::vector<Exact_point> suns{{1, 2, 3}, {2, 1, -1}, {-3, 1, 1}, {1, -4, 2}, {-5, 7, 1}};
  for (const Exact_point& sun : std::span(suns).first(test_scenes::is_sanitized() ? 2 : suns.size())) {
    const Shadows by_sun = shadows(Exact_view(scene, Sun{sun}), boxes);
    EXPECT_EQ(harness::flaw_of(by_sun, soup, scene, sun, true, false), "");
    Exact_point far = sun;
    for (Rational& x : far) mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), 60);
    const Shadows by_light = shadows(Exact_view(scene, far), boxes);
    const auto lit_area = [&](const Shadows& shadows) {
      double area = 0;
      for (const Shadow_part& part : shadows.parts)
        for (std::size_t axis = 0; part.is_lit() && axis < 3; ++axis)
          area += std::fabs(nearest_double(harness::area_of(part.vertices, axis)));
      return area;
    };
    EXPECT_NEAR(lit_area(by_sun), lit_area(by_light), 1e-9 * lit_area(by_sun));
    EXPECT_EQ(by_sun.lit, by_light.lit);
  }
  EXPECT_THROW(Exact_view(scene, Sun{{0, 0, 0}}), std::invalid_argument);
}

TEST(Shadow, is_the_same_for_any_number_of_threads) {
  const Polygon_soup soup = generate::make("soup_constant_density", 200, 3);
  const Scene scene(soup);
  const Piece_boxes boxes(scene);
  const Exact_view view(scene, {3, 1, 2});
  Shadow_options options;
  std::vector<std::vector<Shadow_part>> made;
  for (const int threads : {1, 4}) {
    options.threads = threads;
    made.push_back(shadows(view, boxes, options).parts);
  }
  ASSERT_EQ(made[0].size(), made[1].size());
  for (std::size_t i = 0; i < made[0].size(); ++i) {
    EXPECT_EQ(made[0][i].by, made[1][i].by);
    EXPECT_EQ(made[0][i].vertices, made[1][i].vertices);
  }
}

TEST(Shadow, progress_ends_with_all_pieces) {
  Polygon_soup soup;
  for (int k = 0; k < 300; ++k) level(soup, 2 * k, 0, 0, 1);
  const Scene scene(soup);
  std::mutex one_at_a_time;
  std::set<std::size_t> told;
  Shadow_options options;
  options.progress = [&](std::size_t done, std::size_t all) {
    const std::lock_guard lock(one_at_a_time);
    if (all == 300) told.insert(done);  // and before it what the light sees, in its own units
  };
  shadows(Exact_view(scene, {1, 2, 3}), Piece_boxes(scene), options);
  EXPECT_EQ(told, (std::set<std::size_t>{256, 300}));
}

// ---- The space in shadow

TEST(Shadow_volume, is_all_that_is_behind_a_face_within_the_box) {
  Polygon_soup soup;
  level(soup, 0, 0, 0, 4);
  level(soup, 1, 1, 1, 1);
  const Scene scene(soup);
  const Shadow_volume below = shadow_volume(scene, Sun{{0, 0, 1}});
  EXPECT_EQ(below.box, (std::array<Exact_point, 2>{Exact_point{-1, -1, -1}, {5, 5, 2}}));
  EXPECT_EQ(below.casting, 2u);
  EXPECT_EQ(volume(below.soup), 16 + 1);
  EXPECT_EQ(volume(shadow_volume(scene, Sun{{0, 0, -3}}).soup), 2 * 16 + 0) << "the small one is in the large one's";
  EXPECT_EQ(volume(shadow_volume(scene, Sun{{1, 0, 0}}).soup), 0) << "edge-on";
  // A lamp above the middle of the small one; of the large one's the box cuts a part off.
  const Rational h(1, 2);
  const auto cube_of = [](const Rational& x) { return Rational(x * x * x); };
  const Rational on_top = Rational(7, 3), until_cut = 32 * (cube_of(Rational(7, 5)) - 1) / 3,
                 cut = 4 * (cube_of(Rational(23, 4)) - cube_of(Rational(28, 5))) / 9;
  EXPECT_EQ(volume(shadow_volume(scene, {3 * h, 3 * h, 2}).soup), on_top + until_cut + cut);
  EXPECT_EQ(shadow_volume(Scene(Polygon_soup()), {1, 2, 3}).soup.face_count(), 0u);
}

TEST(Shadow_volume, moves_with_its_scene) {
  for (const int by : {0, -100, 100}) {  // the origin is in the box, beyond it and before it
    Polygon_soup soup;
    level(soup, by, by, by, 4);
    level(soup, by + 1, by + 1, by + 1, 1);
    const Shadow_volume made = shadow_volume(Scene(soup), Sun{{0, 0, 1}});
    EXPECT_EQ(made.box, (std::array<Exact_point, 2>{Exact_point{by - 1, by - 1, by - 1}, {by + 5, by + 5, by + 2}}));
    EXPECT_EQ(volume(made.soup), 16 + 1);
  }
}

TEST(Shadow_volume, is_what_rays_say_and_closed) {
  generate::Random random(5);
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Polygon_soup soup = generate::make("soup", 8, seed);
    const Scene scene(soup);
    for (const Exact_point& light : {Exact_point{0, 0, 0}, Exact_point{3, -2, Rational(1, 3)}}) {
      const bool is_sun = seed % 2 == 0;
      const Exact_point at = is_sun && light == Exact_point{0, 0, 0} ? Exact_point{1, 2, -1} : light;
      const Shadow_volume made = is_sun ? shadow_volume(scene, Sun{at}) : shadow_volume(scene, at);
      EXPECT_EQ(harness::flaw_of(made, soup, scene, at, is_sun, 20, random), "") << seed;
      EXPECT_GT(volume(made.soup), 0);
    }
  }
}

}  // namespace
