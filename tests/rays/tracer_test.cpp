// Rays by boxes, by a tree and by the definition: worked by hand, drawn at random, and as far as each stage decides.

#include "../sample.h"

#include <gtest/gtest.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/rays/by_tree.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/harness/generate/rays.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/laws/trace.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace sightline;

namespace {

using Hits = std::vector<Face_hit>;

constexpr Met_side front = Met_side::front, back = Met_side::back, along = Met_side::along;
constexpr Ray_start open = Ray_start::open, closed = Ray_start::closed;

/// The hits by boxes, if a tree and the definition say the same, first and all.
Hits hits(const Polygon_soup& soup, const Exact_ray& ray, Ray_start start = open) {
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  const Exact_traits traits(scene);
  const Exact_tree tree = build_bsp(traits);
  Ray_counters counters;
  const Hits all = tracer.all(ray, start, counters);
  EXPECT_EQ(all, all_hits(traits, tree, ray, start));
  EXPECT_EQ(all, harness::hits_by_definition(soup, scene, ray, start));
  EXPECT_EQ(only_first(all), tracer.first(ray, start, counters));
  EXPECT_EQ(only_first(all), first_hits(traits, tree, ray, start));
  return all;
}

Face_id square(Polygon_soup& soup, const Exact_point& corner, std::size_t across, const Rational& side) {
  std::vector<Point_id> loop;
  for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    Exact_point p = corner;
    p[(across + 1) % 3] += i * side;
    p[(across + 2) % 3] += j * side;
    loop.push_back(soup.add_point(p[0], p[1], p[2]));
  }
  return soup.add_face(loop);
}

TEST(Trace, both_sides_are_met_and_named) {
  Polygon_soup soup;
  square(soup, {0, 0, 0}, 2, 1);
  const Rational half(1, 2);
  EXPECT_EQ(hits(soup, {{half, half, 3}, {0, 0, -2}}), (Hits{{0, front, Rational(3, 2), Rational(3, 2)}}));
  EXPECT_EQ(hits(soup, {{half, half, -3}, {0, 0, 1}}), (Hits{{0, back, 3, 3}}));
  EXPECT_EQ(hits(soup, {{half, half, -3}, {0, 0, -1}}), Hits{});
}

TEST(Trace, a_face_is_met_in_its_corners_and_edges_too) {
  Polygon_soup soup;
  square(soup, {0, 0, 0}, 2, 1);
  square(soup, {1, 0, 0}, 2, 1);
  square(soup, {1, 1, 0}, 2, 1);
  const Rational half(1, 2);
  EXPECT_EQ(hits(soup, {{1, 1, 1}, {0, 0, -1}}), (Hits{{0, front, 1, 1}, {1, front, 1, 1}, {2, front, 1, 1}}));
  EXPECT_EQ(hits(soup, {{1, half, 1}, {0, 0, -1}}), (Hits{{0, front, 1, 1}, {1, front, 1, 1}}));
  EXPECT_EQ(hits(soup, {{0, half, 1}, {0, 0, -1}}), (Hits{{0, front, 1, 1}}));
  const Rational beside = Rational(-1) / Rational(Integer(1) << 200);
  EXPECT_EQ(hits(soup, {{beside, half, 1}, {0, 0, -1}}), Hits{});
}

TEST(Trace, a_corner_is_met_and_a_step_beside_it_nothing_however_long_numbers_are) {
  for (int bits = 4; bits < 70; ++bits) {
    Polygon_soup soup;
    const Integer length = (Integer(1) << bits) * 5 / 7;  // of many digits that differ
    const Rational side(length);
    square(soup, {0, 0, 0}, 2, side);
    square(soup, {1, 1, -9}, 2, 1);  // so that a step is 1
    const Exact_point origin{Rational(length / 3), Rational(length / 11), Rational(length / 2 + 7)};
    for (const int dx : {-1, 0, 1})
      for (const int dy : {-1, 0, 1}) {
        const Exact_ray ray{origin, {side + dx - origin[0], side + dy - origin[1], -origin[2]}};
        const bool is_met = dx <= 0 && dy <= 0;
        EXPECT_EQ(hits(soup, ray), is_met ? (Hits{{0, front, 1, 1}}) : Hits{}) << bits << ' ' << dx << ' ' << dy;
      }
  }
}

TEST(Trace, a_ray_in_a_plane_meets_faces_in_parts) {
  Polygon_soup soup;
  square(soup, {1, 0, 0}, 2, 2);  // 0 from x = 1 to 3
  square(soup, {3, 0, 0}, 2, 1);  // 1 from 3 to 4
  square(soup, {2, 0, 0}, 0, 1);  // 2 across, at x = 2
  EXPECT_EQ(hits(soup, {{0, Rational(1, 2), 0}, {1, 0, 0}}),
            (Hits{{0, along, 1, 3}, {2, back, 2, 2}, {1, along, 3, 4}}));
  EXPECT_EQ(hits(soup, {{0, 1, 0}, {Rational(1, 2), 0, 0}}),
            (Hits{{0, along, 2, 6}, {2, back, 4, 4}, {1, along, 6, 8}}));
  // Through a corner alone.
  EXPECT_EQ(hits(soup, {{0, 3, 0}, {1, -1, 0}}), (Hits{{0, along, 1, 3}, {2, back, 2, 2}, {1, along, 3, 3}}));
}

TEST(Trace, what_holds_an_open_start_is_passed_over_all_along) {
  Polygon_soup soup;
  // An L in two pieces or more, and a square in its plane further on.
  const std::vector<std::array<int, 2>> corners{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
  std::vector<Point_id> loop;
  for (const auto& [x, y] : corners) loop.push_back(soup.add_point(Rational(x), Rational(y), 0));
  soup.add_face(loop);
  square(soup, {5, 0, 0}, 2, 1);
  const Exact_ray ray{{Rational(1, 2), Rational(1, 2), 0}, {1, 0, 0}};
  EXPECT_EQ(hits(soup, ray), (Hits{{1, along, Rational(9, 2), Rational(11, 2)}}));
  EXPECT_EQ(hits(soup, ray, closed),
            (Hits{{0, along, 0, Rational(7, 2)}, {1, along, Rational(9, 2), Rational(11, 2)}}));
  // Out of a leg, across the notch, into the other one: two parts of one face.
  EXPECT_EQ(hits(soup, {{-1, 4, 0}, {1, -1, 0}}), (Hits{{0, along, 1, 2}, {0, along, 3, 4}}));
  // From the face, off it.
  EXPECT_EQ(hits(soup, {{Rational(1, 2), Rational(1, 2), 0}, {0, 0, 1}}), Hits{});
  EXPECT_EQ(hits(soup, {{Rational(1, 2), Rational(1, 2), 0}, {0, 0, 1}}, closed), (Hits{{0, back, 0, 0}}));
}

TEST(Trace, a_hole_lets_rays_through_but_not_along_its_edges) {
  Polygon_soup soup;
  square(soup, {0, 0, 0}, 2, 3);
  std::vector<Point_id> hole;
  for (const auto& [x, y] : {std::pair{1, 1}, {1, 2}, {2, 2}, {2, 1}})
    hole.push_back(soup.add_point(Rational(x), Rational(y), 0));
  soup.add_hole(hole);
  const auto down = [](const Rational& x, const Rational& y) { return Exact_ray{{x, y, 1}, {0, 0, -1}}; };
  EXPECT_EQ(hits(soup, down(Rational(3, 2), Rational(3, 2))), Hits{});
  EXPECT_EQ(hits(soup, down(1, Rational(3, 2))), (Hits{{0, front, 1, 1}}));
  EXPECT_EQ(hits(soup, down(1, 1)), (Hits{{0, front, 1, 1}}));
  EXPECT_EQ(hits(soup, {{-1, Rational(3, 2), 0}, {1, 0, 0}}), (Hits{{0, along, 1, 2}, {0, along, 3, 4}}));
}

TEST(Trace, spikes_and_what_joins_two_parts_of_a_face_are_met_by_nothing) {
  Polygon_soup soup;
  std::vector<Point_id> spiked, joined;
  for (const auto& [x, y] : {std::pair{0, 0}, {0, -1}, {0, 3}, {-1, 0}}) spiked.push_back(soup.add_point(x, y, 0));
  soup.add_face(spiked);
  for (const auto& [x, y] : {std::pair{9, 0}, {7, 1}, {7, 0}, {5, 0}, {4, 0}, {5, -1}, {5, 0}, {7, 0}})
    joined.push_back(soup.add_point(x, y, 0));
  soup.add_face(joined);
  const Rational half(1, 2);
  const auto down = [&](const Rational& x, const Rational& y) { return hits(soup, {{x, y, 1}, {0, 0, -1}}).size(); };
  EXPECT_EQ(down(0, -half), 0u);
  EXPECT_EQ(down(0, -1), 0u);
  EXPECT_EQ(down(0, 0), 1u);
  EXPECT_EQ(down(0, half), 1u);
  EXPECT_EQ(down(-half, 0), 1u);
  EXPECT_EQ(down(7, half), 1u);
  EXPECT_EQ(down(5, -half), 1u);
  EXPECT_EQ(down(6, 0), 0u) << "between the parts";
  EXPECT_EQ(down(7, 0), 1u);
  EXPECT_EQ(hits(soup, {{half * 13, 0, 0}, {1, 0, 0}}), (Hits{{1, along, half, half * 5}}));
}

TEST(Trace, a_direction_must_not_be_zero) {
  const Scene scene{Polygon_soup()};
  const Ray_tracer tracer(scene);
  Ray_counters counters;
  EXPECT_THROW(tracer.first({{0, 0, 0}, {0, 0, 0}}, open, counters), std::domain_error);
  EXPECT_THROW(tracer.nearest({{0, 0, 0}, {0, 0, 0}}, open, counters), std::domain_error);
  EXPECT_TRUE(tracer.all({{0, 0, 0}, {0, 0, 1}}, open, counters).empty());
}

TEST(Trace, scenes_of_some_size_are_met_as_by_definition) {
  for (const char* kind : {"city", "soup_constant_density"}) {
    const Polygon_soup soup = generate::make(kind, 60, 5);
    const Scene scene(soup);
    const Ray_tracer tracer(scene);
    generate::Random random(3);
    Ray_counters counters;
    for (int turn = 0; turn < 8; ++turn)
      for (const generate::Ray_kind& rays : generate::ray_kinds()) {
        const Exact_ray ray = rays.make(soup, random);
        EXPECT_EQ(tracer.all(ray, open, counters), harness::hits_by_definition(soup, scene, ray, open)) << rays.name;
      }
    EXPECT_LT(counters.pieces, counters.rays * scene.pieces().size() / 2) << "boxes leave out more than half";
  }
}

// ---- Stages

/// Rays that pass an edge at 2^-k: doubles are to decide as far as they can, and exact numbers the rest.
TEST(Trace, doubles_decide_unless_a_ray_is_close_to_an_edge) {
  Polygon_soup soup;
  square(soup, {0, 0, 0}, 2, 1);
  square(soup, {0, 0, -7}, 2, 8);
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  for (int k = 1; k <= 60; ++k)
    for (const int side : {-1, 1}) {
      const double x = side * std::ldexp(1.0, -k);
      Ray_counters counters;
      const Ray_tracer::Nearest near = tracer.nearest({{x, 0.5, 3}, {0, 0, -1}}, open, counters);
      EXPECT_EQ(near.face, side > 0 ? 0u : Ray_tracer::Nearest::nothing) << k;
      if (k <= 38) {
        EXPECT_EQ(counters.exact_pieces, 0u) << k;
      } else if (k >= 56) {
        EXPECT_GE(counters.exact_pieces, 1u) << k;
      }
    }
}

/// A tree of boxes is worth its nodes: what is behind the face that is met is not looked at, though doubles could not
/// tell whether it is met.
TEST(Trace, doubles_decide_before_a_seam_that_is_hidden) {
  const Rational half(1, 2);
  Polygon_soup soup;
  const auto add = [&](const std::vector<std::array<int, 2>>& corners, const Rational& z) {
    std::vector<Point_id> loop;
    for (const auto& [x, y] : corners) loop.push_back(soup.add_point(Rational(x), Rational(y), z));
    soup.add_face(loop);
  };
  add({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}, 0);  // in two pieces, which meet at its notch
  add({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, half);
  const Scene scene(soup);
  ASSERT_EQ(scene.pieces().size(), 3u);
  const Ray_tracer tracer(scene);
  Ray_counters counters;
  EXPECT_EQ(tracer.nearest({{1, 1, 3}, {0, 0, -1}}, open, counters).face, 1u);
  EXPECT_EQ(counters.exact_pieces, 0u);
  EXPECT_EQ(tracer.nearest({{1, 1, -3}, {0, 0, 1}}, open, counters).face, 0u);
  EXPECT_GE(counters.exact_pieces, 1u);
}

TEST(Trace, faces_closer_than_doubles_tell_are_ordered_exactly) {
  const Rational gap = Rational(1) / Rational(Integer(1) << 90);
  Polygon_soup soup;
  square(soup, {0, 0, 0}, 2, 1);
  square(soup, {0, 0, gap}, 2, 1);
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  Ray_counters counters;
  const Double_ray down{{0.375, 0.25, 2}, {0, 0, -1}}, up{{0.375, 0.25, -2}, {0, 0, 1}};
  EXPECT_EQ(tracer.nearest(down, open, counters).face, 1u);
  EXPECT_EQ(tracer.nearest(up, open, counters).face, 0u);
  EXPECT_EQ(counters.exact_orders, 2u);
  EXPECT_EQ(hits(soup, up.exact()), (Hits{{0, back, 2, 2}, {1, back, 2 + gap, 2 + gap}}));
}

/// The six faces of a box at `low`; beside it a triangle of 2^-bits, which makes coordinates longer than machine
/// numbers.
Polygon_soup box(const Exact_point& low, const Rational& size, int bits = 0) {
  Polygon_soup soup;
  for (int i = 0; i < 8; ++i)
    soup.add_point(low[0] + (i & 1) * size, low[1] + (i >> 1 & 1) * size, low[2] + (i >> 2) * size);
  for (const std::array<Point_id, 4>& face :
       {std::array<Point_id, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    soup.add_face({face.begin(), face.end()});
  if (bits > 0) {
    const Rational aside = low[0] - 9, little = Rational(1) / Rational(Integer(1) << bits);
    soup.add_face({soup.add_point(aside, aside, aside), soup.add_point(aside + little, aside, aside),
                   soup.add_point(aside, aside + little, aside)});
  }
  return soup;
}

TEST(Trace, faces_that_share_what_is_met_are_tied_without_their_parameters) {
  struct Case {
    Exact_point low;
    Rational size;
    int bits;
  };
  // Machine numbers without a division; a grid in thirds; the same farther away; numbers too long for machines.
  const Rational third(1, 3);
  for (const Case& c :
       {Case{{0, 0, 0}, 1, 0}, {{third, 0, -third}, third, 0}, {{1000, 1, 7}, 1, 0}, {{0, 0, 0}, 1, 70}}) {
    const Polygon_soup soup = box(c.low, c.size, c.bits);
    const Scene scene(soup);
    const Ray_tracer tracer(scene);
    for (std::uint32_t target = 0; target < 27; ++target) {  // corners, middles of edges and of faces, the middle
      Exact_ray ray{{c.low[0] - 3, c.low[1] - 5, c.low[2] - 7}, {}};
      const std::array<std::uint32_t, 3> at{target % 3, target / 3 % 3, target / 9};
      for (std::size_t k = 0; k < 3; ++k) ray.direction[k] = c.low[k] + at[k] * c.size / 2 - ray.origin[k];
      Double_ray doubles;
      bool is_double = true;
      for (std::size_t k = 0; k < 3; ++k) {
        doubles.origin[k] = nearest_double(ray.origin[k]);
        doubles.direction[k] = nearest_double(ray.direction[k]);
        is_double =
            is_double && exact(doubles.origin[k]) == ray.origin[k] && exact(doubles.direction[k]) == ray.direction[k];
      }
      if (!is_double) ray = doubles.exact();
      Ray_counters counters, exactly;
      const Ray_tracer::Nearest near = tracer.nearest(doubles, open, counters);
      const Hits first = tracer.first(ray, open, exactly);
      ASSERT_EQ(first.empty(), near.face == Ray_tracer::Nearest::nothing);
      if (first.empty()) continue;
      EXPECT_EQ(near.face, first.front().face);
      EXPECT_EQ(near.side, first.front().side);
      EXPECT_EQ(near.tied, first.size() > 1);
      EXPECT_LE(exact(near.low), first.front().t);
      EXPECT_GE(exact(near.high), first.front().t);
      const bool meets_corner_or_edge = (at[0] == 1) + (at[1] == 1) + (at[2] == 1) < 2;
      EXPECT_TRUE(is_double || !meets_corner_or_edge || c.size != 1);
      if (near.tied && meets_corner_or_edge) EXPECT_EQ(counters.exact_orders, 0u) << target;
      if (near.tied) EXPECT_EQ(exactly.exact_orders, 1u) << target;
    }
  }
}

/// Of a corner between two edges in line the line may meet both edges' line, and not the corner.
TEST(Trace, faces_that_meet_a_line_at_different_places_of_one_edge_are_told_apart) {
  Polygon_soup soup;
  const Point_id p = soup.add_point(0, 0, 0), q = soup.add_point(2, 0, 0), r = soup.add_point(4, 0, 0),
                 s = soup.add_point(4, 4, 0), u = soup.add_point(4, 4, 1);
  soup.add_face({p, q, r, s});
  soup.add_face({p, q, r, u});
  soup.add_face({p, r, u});
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0}) {
    Ray_counters counters;
    const Double_ray ray{{x + 1, -1, 5}, {-1, 1, -5}};
    const Ray_tracer::Nearest near = tracer.nearest(ray, open, counters);
    const Hits first = hits(soup, ray.exact());
    EXPECT_EQ(first.size(), 3u);
    EXPECT_EQ(near.face, 0u);
    EXPECT_TRUE(near.tied);
  }
}

TEST(Trace, scenes_smaller_than_the_least_double_are_met_exactly) {
  // Two squares about the origin, of a size whose inverse no double holds; the origin is all that a double hits there.
  const Rational size = Rational(1) / Rational(Integer("1" + std::string(330, '0')));
  Polygon_soup soup;
  for (const int z : {-1, 1}) square(soup, {-size, -size, z * size}, 2, 2 * size);
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  for (const double x : {0.0, 0x1p-1074}) {
    const Double_ray up{{x, 0, 0}, {0, 0, 1}};
    Ray_counters counters;
    EXPECT_EQ(tracer.first(up.exact(), open, counters).size(), x == 0 ? 1u : 0u);
    EXPECT_EQ(tracer.nearest(up, open, counters).face, x == 0 ? 1u : Ray_tracer::Nearest::nothing);
  }
}

TEST(Trace, small_scenes_are_met_from_where_doubles_end_in_their_unit) {
  // A triangle across the ray, with a corner that makes the grid wider than a double.
  Polygon_soup soup;
  const double wide = 0x1p-539, high = 0x1p-546;
  const Point_id a = soup.add_point(-wide, wide, -high), b = soup.add_point(wide, -wide, -high),
                 c = soup.add_point(high, 0x1p-596, high);
  soup.add_face({a, b, c});
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  for (int power = 475; power < 500; ++power) {
    const double far = std::ldexp(1.8, power);
    const Double_ray ray{{far, far, far}, {-1, -1, -1}};
    Ray_counters counters;
    EXPECT_EQ(tracer.first(ray.exact(), open, counters), harness::hits_by_definition(soup, scene, ray.exact(), open))
        << power;
    EXPECT_EQ(tracer.first(ray.exact(), open, counters).size(), 1u) << power;
    EXPECT_EQ(tracer.nearest(ray, open, counters).face, 0u) << power;
  }
  const Exact_ray away{{exact(0x1p480), exact(0x1p480), exact(0x1p480)}, {1, 1, 1}};
  Ray_counters counters;
  EXPECT_TRUE(tracer.first(away, open, counters).empty());
}

TEST(Trace, scenes_about_points_that_no_double_holds_are_met_exactly) {
  // A square, and a triangle beside it that makes the scene large; the ray passes a quarter of the least double beside
  // the square. The middle of the scene is none of its doubles.
  const Rational size = Rational(1) / Rational(Integer("1" + std::string(322, '0')));
  const long wide = 1L << 46;
  Polygon_soup soup;
  const auto face = [&](const std::vector<std::array<long, 2>>& corners) {
    std::vector<Point_id> loop;
    for (const auto& [x, y] : corners) loop.push_back(soup.add_point(Rational(x * size), Rational(y * size), 0));
    soup.add_face(loop);
  };
  face({{384, -51}, {484, -51}, {484, 50}, {384, 50}});
  face({{256 - wide, 1000}, {256 + wide, 1000}, {256, 2001}});
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  const Double_ray beside{{7772 * 0x1p-1074, 0, -0x1p-1060}, {0, 0, 1}};
  Ray_counters counters;
  EXPECT_TRUE(tracer.first(beside.exact(), open, counters).empty());
  EXPECT_EQ(tracer.nearest(beside, open, counters).face, Ray_tracer::Nearest::nothing);
}

TEST(Trace, rays_from_afar_are_as_sure) {
  const Polygon_soup soup = generate::make("city", 20, 9);
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  generate::Random random(11);
  for (const int power : {4, 19, 30, 60, 300, 1000, 1100, 3000}) {
    for (int turn = 0; turn < 4; ++turn) {
      Exact_ray ray = generate::ray_kinds()[1].make(soup, random);
      const Exact_point to = point_at(ray, 1);
      Rational distance = 1;
      mpq_mul_2exp(distance.get_mpq_t(), distance.get_mpq_t(), static_cast<mp_bitcnt_t>(power));
      for (std::size_t k = 0; k < 3; ++k) ray.origin[k] = to[k] - distance * ray.direction[k];
      Ray_counters counters;
      const Hits all = tracer.all(ray, open, counters);
      EXPECT_EQ(all, harness::hits_by_definition(soup, scene, ray, open)) << power;
      EXPECT_FALSE(all.empty());
      EXPECT_LT(counters.exact_pieces, scene.pieces().size()) << power;
      for (Rational& x : ray.direction) x = -x;
      EXPECT_TRUE(tracer.all(ray, open, counters).empty());
    }
  }
}

TEST(Trace, rays_whose_numbers_are_no_doubles_find_boxes_too) {
  const Polygon_soup soup = generate::make("city", test_scenes::is_sanitized() ? 40 : 200, 9);
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  const Exact_point middle = scene.position({0, 0, 0, 1});
  Integer huge, wide;
  mpz_ui_pow_ui(huge.get_mpz_t(), 10, 300);
  mpz_ui_pow_ui(wide.get_mpz_t(), 10, 700);
  const Rational small(1, huge), third(1, 3);
  for (const Rational& height : {Rational(1000), Rational(huge), Rational(wide)}) {
    const Exact_point origin{middle[0] + third, middle[1] + small, height};
    for (const Rational& length : {Rational(1), small, Rational(huge), Rational(1, wide), Rational(wide)}) {
      Ray_counters counters;
      const Exact_ray down{origin, {0, 0, -length}}, aslant{origin, {1 / height, 0, -1}}, aside{origin, {1, 0, -third}},
          up{origin, {third, 0, 1}};
      std::size_t met = 0;
      for (const Exact_ray& ray : {down, aslant, aside, up}) {
        const Hits all = tracer.all(ray, open, counters);
        EXPECT_EQ(all, harness::hits_by_definition(soup, scene, ray, open)) << height << ' ' << length;
        EXPECT_EQ(tracer.first(ray, open, counters), only_first(all));
        met += !all.empty();
      }
      EXPECT_EQ(met, 2u);
      EXPECT_LT(counters.exact_pieces, 20u) << height << ' ' << length;
    }
  }
}

TEST(Trace, bounds_hold_parameters_beyond_doubles) {
  const Scene scene(generate::make("city", 200, 9));
  const Ray_tracer tracer(scene);
  const Exact_point middle = scene.position({0, 0, 0, 1});
  Ray_counters counters;
  const Double_ray down{{nearest_double(middle[0]), nearest_double(middle[1]), 1e300}, {0, 0, -1e-300}};
  const Hits first = tracer.first(down.exact(), open, counters);
  ASSERT_FALSE(first.empty());
  const Ray_tracer::Nearest nearest = tracer.nearest(down, open, counters);
  EXPECT_EQ(nearest.face, first[0].face);
  EXPECT_EQ(nearest.low, std::numeric_limits<double>::max());
  EXPECT_EQ(nearest.high, std::numeric_limits<double>::infinity());
}

TEST(Trace, boxes_hold_all_that_rays_meet) {
  // Boxes alone: of points in them, along axes, and with corners on the sides of boxes.
  generate::Random random(21);
  std::vector<Ray_boxes::Box> boxes(200);
  const auto coordinate = [&] { return static_cast<double>(random.between(-16, 16)) / 16; };
  for (Ray_boxes::Box& box : boxes)
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = coordinate(), b = random.chance(1, 3) ? a : coordinate();
      box.low[k] = std::min(a, b);
      box.high[k] = std::max(a, b);
    }
  const Ray_boxes tree(boxes);
  for (int turn = 0; turn < 400; ++turn) {
    const Ray_boxes::Box& aim = boxes[random.below(boxes.size())];
    Ray_boxes::Ray ray{};
    std::array<double, 3> to;
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      to[k] = random.chance(1, 2) ? aim.low[k] : aim.high[k];
      ray.origin[k] = random.chance(1, 3) ? to[k] : 4 * coordinate();
      size = std::max(size, std::fabs(to[k] - ray.origin[k]));
    }
    if (size == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) ray.direction[k] = (to[k] - ray.origin[k]) / size;
    bool found = false;
    tree.visit(
        ray,
        [&](std::uint32_t first, std::uint32_t count) {
          for (std::uint32_t i = first; i < first + count; ++i) found = found || &boxes[tree.order()[i]] == &aim;
        },
        [&] { return size; });
    EXPECT_TRUE(found) << turn;
  }
}

}  // namespace
