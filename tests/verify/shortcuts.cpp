// What spares the comparison of two cones: doubles, and planes of the sequence (P-20); and the checkers' threads.

#include "../sample.h"
#include "scenes.h"
#include "tree_order.h"

#include <sightline/algorithms/verify/pairs.h>
#include <sightline/algorithms/verify/parallel.h>
#include <sightline/algorithms/verify/planes_between.h>
#include <sightline/algorithms/verify/rounded_cones.h>
#include <sightline/harness/generate/families.h>

#include <atomic>
#include <numeric>
#include <thread>

namespace {

using namespace verify_test;
using order_check::Cone;
using order_check::Planes_between;
using order_check::Rounded_cone;
using test_scenes::least;
using test_scenes::sample;
using verify_test::Scene;

const Exact_point at_origin = at(0, 0, 0);

Rational power_of_two(long exponent) {
  Rational result = 1;
  (exponent < 0 ? mpq_div_2exp : mpq_mul_2exp)(result.get_mpq_t(), result.get_mpq_t(),
                                               static_cast<mp_bitcnt_t>(std::abs(exponent)));
  return result;
}

/// A triangle some way off, of which a corner is moved by about 2^-exponent, and all scaled.
Points triangle_near(Dice& dice, const Points& about, long exponent, const Rational& scale) {
  Points result = about;
  result[static_cast<std::size_t>(roll(dice, 0, 2))][static_cast<std::size_t>(roll(dice, 0, 2))] +=
      power_of_two(-exponent) * roll(dice, -3, 3);
  for (Exact_point& p : result)
    for (Rational& x : p) x *= scale;
  return result;
}

/// On which side of the plane of b, as seen from the origin, corner k of a is: from its definition.
int side_beyond(const Points& a, std::size_t k, const Points& b) {
  const Exact_point normal = order_check::cross(order_check::minus(b[1], b[0]), order_check::minus(b[2], b[0]));
  const auto height = [&](const Exact_point& p) -> Rational {
    return normal[0] * (p[0] - b[0][0]) + normal[1] * (p[1] - b[0][1]) + normal[2] * (p[2] - b[0][2]);
  };
  return -sgn(height(a[k])) * sgn(height(at_origin));
}

TEST(Rounded_cones, know_sides_or_say_nothing) {
  Dice dice(1);
  std::size_t told = 0, silent = 0, close = 0, signs_told = 0, sides_told = 0;
  for (int trial = 0; trial < sample(20000); ++trial) {
    const long exponent = roll(dice, 0, 70);
    Points about;
    for (int k = 0; k < 3; ++k) about.push_back(at(roll(dice, 5, 900), roll(dice, -9, 900), roll(dice, -9, 9)));
    const Rational scale = power_of_two(trial % 3 == 0 ? roll(dice, -2000, 2000) : 0);
    const Points a = triangle_near(dice, about, exponent, scale), b = triangle_near(dice, about, exponent, scale);
    if (certificate_check::is_zero(order_check::newell_normal(a)) ||
        certificate_check::is_zero(order_check::newell_normal(b)))
      continue;
    const Cone cone_a(a, at_origin), cone_b(b, at_origin);
    if (cone_a.edge_on || cone_b.edge_on) continue;
    const Rounded_cone rounded_a(cone_a), rounded_b(cone_b);
    for (std::size_t ray = 0; ray < 3; ++ray) {
      const std::optional<int> side = order_check::side_to_plane(rounded_a, ray, rounded_b);
      const int expected = side_beyond(a, ray, b);
      ASSERT_TRUE(!side || *side == expected) << trial;
      for (const order_check::Integer_vector& plane : cone_a.edge_planes) {
        const std::optional<int> sign = order_check::sign_in_doubles(order_check::rounded(plane), rounded_b.rays[ray]);
        ASSERT_TRUE(!sign || *sign == certificate_check::sign_of_dot(plane, cone_b.rays[ray])) << trial;
        signs_told += sign.has_value();
      }
      for (std::size_t edge = 0; edge < 3; ++edge) {
        const std::optional<int> sign = order_check::side_of_edge(rounded_a, edge, rounded_b.rays[ray]);
        ASSERT_TRUE(!sign || *sign == certificate_check::sign_of_dot(cone_a.edge_planes[edge], cone_b.rays[ray]))
            << trial;
        sides_told += sign.has_value();
      }
      told += side.has_value();
      silent += !side && expected != 0;
      close += side && exponent > 25;
    }
    order_check::Pair_check check;
    const bool is_nearer = check.nearer_somewhere(cone_a, cone_b);
    ASSERT_FALSE(nowhere_nearer(rounded_a, rounded_b) && is_nearer) << trial;
    ASSERT_EQ(check.nearer_somewhere(cone_a, rounded_a, cone_b, rounded_b), is_nearer) << trial;
  }
  EXPECT_GT(told, least(10000u));
  EXPECT_GT(signs_told, least(20000u));
  EXPECT_GT(sides_told, least(1000u));
  EXPECT_GT(silent, least(2000u));
  EXPECT_GT(close, least(200u));
}

TEST(Rounded_cones, of_squares_over_one_another_tell_which_is_nearer) {
  const Rounded_cone near(Cone(rectangle(-1, 1, -1, 1, 1), at_origin)),
      far(Cone(rectangle(-1, 1, -1, 1, 2), at_origin));
  EXPECT_TRUE(nowhere_nearer(far, near));
  EXPECT_FALSE(nowhere_nearer(near, far));
  EXPECT_FALSE(nowhere_nearer(near, near));  // as near: doubles cannot tell
}

TEST(Planes_between, tell_all_pairs_of_a_stack_and_none_of_one_upside_down) {
  for (const std::size_t count : {2u, 3u, 130u, 500u}) {
    std::vector<Cone> right, wrong;
    for (std::size_t k = 0; k < count; ++k) {
      const auto height = static_cast<long>(k) + 1;
      wrong.emplace_back(rectangle(-1, 1, -1, 1, height), at_origin);
      right.emplace_back(rectangle(-1, 1, -1, 1, static_cast<long>(count) - height + 1), at_origin);
    }
    const std::vector<Rounded_cone> rounded_right(right.begin(), right.end()),
        rounded_wrong(wrong.begin(), wrong.end());
    const Planes_between of_right(right, rounded_right), of_wrong(wrong, rounded_wrong);
    for (std::size_t later = 0; later < count; ++later)
      for (std::size_t earlier = 0; earlier < later; ++earlier) {
        ASSERT_TRUE(of_right.in_order(earlier, later)) << earlier << ' ' << later;
        ASSERT_FALSE(of_wrong.in_order(earlier, later)) << earlier << ' ' << later;
      }
  }
}

TEST(Planes_between, are_right_of_sequences_that_are_nearly_in_order) {
  std::size_t told = 0, nearer = 0, in_a_plane = 0;
  for (unsigned seed = 0; seed < sample(40u); ++seed) {
    Dice dice(seed);
    std::vector<Points> polygons;
    for (long k = 0; k < 160; ++k) {  // from far to near, some in the plane of others, some out of order
      const Rational height = 200 - k / 3 * 3 + (roll(dice, 0, 9) == 0 ? roll(dice, -40, 40) : 0);
      Points p = rectangle(roll(dice, -9, -1), roll(dice, 1, 9), roll(dice, -9, -1), roll(dice, 1, 9), 0);
      const bool tilted = roll(dice, 0, 3) == 0;
      for (Exact_point& q : p) q[2] = height + (tilted ? Rational(q[0] * ratio(roll(dice, 0, 1), 4)) : Rational(0));
      if (tilted) p.resize(3);  // three points are in a plane
      polygons.push_back(p);
    }
    std::vector<Cone> cones;
    for (const Points& p : polygons) cones.emplace_back(p, at_origin);
    const std::vector<Rounded_cone> rounded(cones.begin(), cones.end());
    const Planes_between planes(cones, rounded);
    order_check::Pair_check check;
    for (std::size_t later = 0; later < cones.size(); ++later)
      for (std::size_t earlier = 0; earlier < later; ++earlier) {
        if (cones[earlier].edge_on || cones[later].edge_on) continue;
        const bool is_told = planes.in_order(earlier, later),
                   is_nearer = check.nearer_somewhere(cones[earlier], cones[later]);
        ASSERT_FALSE(is_told && is_nearer) << seed << ": " << earlier << ' ' << later;
        told += is_told;
        nearer += is_nearer;
        in_a_plane += is_told && cones[earlier].nearness == cones[later].nearness;
      }
  }
  EXPECT_GT(told, least(10000u));
  EXPECT_GT(nearer, least(1000u));
  EXPECT_GT(in_a_plane, 0u);
}

/// How many of a certificate's fragments its cuts leave to be compared.
std::size_t not_settled(const Order_certificate& certificate) {
  std::vector<Cone> cones;
  for (const Order_fragment& fragment : certificate.fragments) cones.emplace_back(fragment.vertices, certificate.eye);
  const std::vector<Rounded_cone> rounded(cones.begin(), cones.end());
  const Planes_between planes(cones, rounded, 1, order_check::cut_places(certificate));
  std::size_t count = 0;
  for (std::size_t i = 0; i < cones.size(); ++i) count += !planes.is_settled(i);
  return count;
}

/// Squares over one another, from far to near.
Scene good_stack(std::size_t count) {
  Scene scene;
  scene.seen_from(at(0, 0, static_cast<long>(count) + 1));
  for (std::size_t k = 0; k < count; ++k) {
    const Points square = rectangle(-1, 1, -1, 1, static_cast<long>(k));
    scene.draw(scene.face(square), square);
  }
  return scene;
}

TEST(Cuts, of_a_tree_leave_no_pair_whichever_planes_the_eye_is_in) {
  std::size_t fragments = 0, with_planes = 0;
  for (const char* family : {"uniform", "coplanar", "edge_on", "touching", "lattice_faces", "crossing_faces", "boxes"})
    for (std::uint64_t seed = 1; seed <= sample(40u); ++seed) {
      generate::Family_parameters parameters;
      parameters.seed = seed;
      const generate::Posed_scene posed = generate::family(family).make(parameters);
      const sightline::Scene scene(posed.soup);
      const Order_certificate certificate = certificate_of_tree(scene, posed.eye);
      ASSERT_EQ(certificate.cuts.depths.size(), certificate.fragments.size());
      ASSERT_EQ(not_settled(certificate), 0u) << family << ' ' << seed;
      fragments += certificate.fragments.size();
      with_planes += !certificate.cuts.others.empty();
    }
  EXPECT_GT(fragments, least(2000u));
  EXPECT_GT(with_planes, least(20u));
}

TEST(Cuts, by_planes_of_no_fragment_settle_what_is_beside_them) {
  // Two heaps, of which neither has a plane between them: the eye looks along that plane, or down on it.
  for (const Exact_point& eye : {at(0, 0, 9), at(-5, 1, 9)}) {
    Scene scene;
    scene.seen_from(eye);
    for (const long x : {1L, -3L})
      for (const long z : {0L, 1L, 2L}) {
        const Points square = rectangle(x, x + 2, -1, 1, x > 0 ? Rational(z) : Rational(z + ratio(1, 2)));
        scene.draw(scene.face(square), square);
      }
    Order_cuts& cuts = scene.certificate.cuts;
    cuts.depths = {3, 2, 1, 3, 2, 1};
    EXPECT_GT(not_settled(scene.certificate), 0u);
    cuts.others = {{3, 0, {1, 0, 0, 0}}};
    EXPECT_EQ(not_settled(scene.certificate), 0u);
    cuts.others = {{3, 0, {-1, 0, 0, 0}}};  // turned, or in front of the eye
    EXPECT_GT(not_settled(scene.certificate), 0u);
    expect_accepted(scene);
  }
}

TEST(Cuts, of_more_levels_than_paths_tell_settle_what_they_cut) {
  Scene scene;
  scene.seen_from(at(0, 0, 1000));
  for (long k = 0; k < 300; ++k) {
    const Points square = rectangle(-1, 1, -1, 1, k);
    scene.draw(scene.face(square), square);
    scene.certificate.cuts.depths.push_back(static_cast<std::uint32_t>(k));
  }
  EXPECT_EQ(not_settled(scene.certificate), 0u);
  std::swap(scene.certificate.fragments[200], scene.certificate.fragments[250]);
  EXPECT_GT(not_settled(scene.certificate), 0u);
  expect_rejected(scene, "is nearer", {200, 201});
}

TEST(Cuts, of_the_level_behind_the_last_that_paths_tell_tell_nothing_of_the_first) {
  // The last square is behind the first, and 64 squares beside them are cut off one at a time until these two are left.
  Scene scene;
  scene.seen_from(at(0, 0, 1000));
  for (long k = 0; k < 66; ++k) {
    const bool is_beside = k != 0 && k != 65;
    const Points square = rectangle(is_beside ? 10 : 0, is_beside ? 11 : 1, 0, 1, k == 0 ? 5 : is_beside ? 10 + k : 1);
    scene.draw(scene.face(square), square);
    scene.certificate.cuts.depths.push_back(static_cast<std::uint32_t>(66 - k));
  }
  expect_rejected(scene, "is nearer", {0, 65});
}

TEST(Cuts, of_no_use_leave_no_more_than_no_cuts_do) {
  for (const std::uint32_t count : {1024u, test_scenes::is_sanitized() ? 1100u : 3000u})
    for (const bool from_behind : {false, true}) {  // one at a time
      Scene scene = good_stack(count);
      for (std::uint32_t k = 0; k < count; ++k) scene.certificate.cuts.depths.push_back(from_behind ? count - k : k);
      EXPECT_EQ(not_settled(scene.certificate), 0u);
      expect_accepted(scene);
      for (const std::size_t k : {std::size_t{5}, std::size_t{count / 2}, std::size_t{count - 5}}) {
        std::swap(scene.certificate.fragments[k], scene.certificate.fragments[k + 1]);
        expect_rejected(scene, "is nearer", {k, k + 1});
        std::swap(scene.certificate.fragments[k], scene.certificate.fragments[k + 1]);
      }
    }
}

TEST(Cuts, of_no_use_tell_of_the_pairs_that_no_cuts_tell_of) {
  Scene scene = good_stack(300);
  Order_cuts& cuts = scene.certificate.cuts;
  for (std::uint32_t k = 0; k < 300; ++k) {
    cuts.depths.push_back(1);
    cuts.others.push_back({k, k, {1, 0, 0, 0}});  // through the eye, and all of them
  }
  std::vector<Cone> cones;
  for (const Order_fragment& fragment : scene.certificate.fragments)
    cones.emplace_back(fragment.vertices, scene.certificate.eye);
  const std::vector<Rounded_cone> rounded(cones.begin(), cones.end());
  const Planes_between planes(cones, rounded, 1, order_check::cut_places(scene.certificate));
  for (std::size_t later = 0; later < 300; ++later) {
    ASSERT_TRUE(planes.is_settled(later));
    for (std::size_t earlier = 0; earlier < later; ++earlier) ASSERT_TRUE(planes.in_order(earlier, later));
  }
}

TEST(Cuts, that_settle_more_than_no_cuts_do_are_kept_where_they_leave_many_open) {
  // Two heaps, of which neither has a plane between them but one that is said; the second one's other cut is of no use.
  constexpr std::uint32_t count = 150;
  Scene scene;
  scene.seen_from(at(0, 0, 2 * count));
  for (const long x : {1L, -3L})
    for (std::uint32_t k = 0; k < count; ++k) {
      const Points square = rectangle(x, x + 2, -1, 1, x > 0 ? Rational(k) : Rational(k + ratio(1, 2)));
      scene.draw(scene.face(square), square);
    }
  EXPECT_GE(not_settled(scene.certificate), count);
  for (std::uint32_t k = 0; k < 2 * count; ++k) scene.certificate.cuts.depths.push_back(10 + k % count);
  scene.certificate.cuts.others = {{count, 0, {1, 0, 0, 0}}};
  EXPECT_EQ(not_settled(scene.certificate), 0u);
  scene.certificate.cuts.others.push_back({count + 80, 1, {1, 0, 0, 0}});  // all of the heap is behind it
  EXPECT_EQ(not_settled(scene.certificate), 80u);
  expect_accepted(scene);
  std::swap(scene.certificate.fragments[count + 3], scene.certificate.fragments[count + 90]);
  EXPECT_FALSE(scene.verdict().accepted);
}

/// Depths of a tree over `count` fragments that is balanced but for a chain of single ones at every leaf.
void hang_chains(std::vector<std::uint32_t>& depths, std::size_t begin, std::size_t end, std::uint32_t depth) {
  constexpr std::size_t chain = 40;
  for (; end - begin <= chain && begin < end; ++begin, ++depth) depths[begin] = depth;
  if (begin == end) return;
  const std::size_t middle = begin + (end - begin) / 2;
  depths[middle] = depth;
  hang_chains(depths, begin, middle, depth + 1);
  hang_chains(depths, middle + 1, end, depth + 1);
}

TEST(Cuts, of_deep_and_small_parts_are_followed_to_the_end) {
  Scene scene = good_stack(2000);
  scene.certificate.cuts.depths.resize(2000);
  hang_chains(scene.certificate.cuts.depths, 0, 2000, 0);
  EXPECT_EQ(not_settled(scene.certificate), 0u);
}

TEST(Cuts, by_planes_that_cannot_tell_settle_nothing) {
  // The nearer square first: on their sides of all of these, if only these were planes, or not in front of the eye.
  Scene scene;
  const Points far = rectangle(-1, 1, -1, 1, 0), near = rectangle(-1, 1, -1, 1, 1);
  scene.seen_from(at(0, 0, 3)).face(far);
  scene.face(near);
  scene.draw(1, near).draw(0, far);
  scene.certificate.cuts.depths = {1, 1};
  using Plane = std::array<Rational, 4>;
  const Plane planes[] = {
      {0, 0, 0, 0}, {0, 0, 0, 1},  {0, 0, 0, -1}, {0, 0, 1, ratio(-1, 2)}, {0, 0, -1, ratio(1, 2)}, {0, 0, 1, -1},
      {0, 0, 1, 0}, {0, 0, 1, -3}, {0, 0, -1, 3}, {0, 0, 1, -9},           {0, 0, -1, ratio(1, 9)}, {1, 0, 0, 0}};
  for (const Plane& plane : planes)
    for (const std::uint32_t place : {0u, 1u, 2u, 4294967295u}) {
      scene.certificate.cuts.others = {{place, 0, plane}};
      EXPECT_GT(not_settled(scene.certificate), 0u) << plane[2] << ' ' << plane[3];
      expect_rejected(scene, "is nearer", {0, 1});
    }
}

TEST(Cuts, settle_nothing_on_the_wrong_side_of_planes_that_doubles_take_for_one) {
  const Integer large = Integer(1) << 60;
  const Integer distance = large - 1;
  const auto over = [](const auto& height) {  // the same directions from the origin, about
    Points polygon = rectangle(1, 2, 1, 2, 0);
    for (Exact_point& p : polygon) p[2] = height(p);
    return polygon;
  };
  const auto at_height = [&](const Rational& z) { return over([&](const Exact_point&) { return z; }); };
  struct Two {
    Exact_point eye;
    Points nearer, farther;
  };
  const Two all[] = {{at(0, 0, large), at_height(1), at_height(0)},  // of one normal
                     {at(0, 0, 0),                                   // of one distance
                      over([&](const Exact_point& p) { return Rational((distance - p[0]) / large); }),
                      at_height(Rational(distance, large))},
                     {at(0, 0, 3), at_height(1 + tiny(60)), at_height(1)}};
  for (const auto& [eye, nearer, farther] : all)
    for (const bool is_right : {true, false})
      for (const std::uint32_t depth : {0u, 1u, 2u}) {
        Scene scene;
        scene.seen_from(eye).face(nearer);
        scene.face(farther);
        if (is_right) scene.draw(1, farther).draw(0, nearer);
        else scene.draw(0, nearer).draw(1, farther);
        scene.certificate.cuts.depths = {1, depth};
        EXPECT_EQ(not_settled(scene.certificate) == 0, is_right);
        if (is_right) expect_accepted(scene);
        else expect_rejected(scene, "is nearer", {0, 1});
      }
}

TEST(Cuts, are_passed_over_where_depths_are_not_as_many_as_fragments) {
  Scene scene = good_stack(3);
  scene.certificate.cuts.others = {{1, 0, {0, 0, -1, 1}}};
  for (const std::size_t depths : {0u, 1u, 2u, 3u, 4u, 1000u}) {
    scene.certificate.cuts.depths.assign(depths, 1);
    const order_check::Cut_places places = order_check::cut_places(scene.certificate);
    EXPECT_EQ(places.depths.size(), depths == 3 ? 3u : 0u);
    EXPECT_EQ(places.others.size(), depths == 3 ? 1u : 0u);
    expect_accepted(scene);
  }
}

TEST(Cuts, are_by_the_plane_that_they_name) {
  Dice dice(5);
  std::size_t behind = 0, in_front = 0, through = 0;
  for (int trial = 0; trial < sample(2000); ++trial) {
    Scene scene = good_stack(2);
    const auto any = [&] {
      const long parts = roll(dice, 1, 3);
      return ratio(roll(dice, -4, 4), parts);
    };
    const std::array<Rational, 4> plane{any(), any(), any(), any()};
    if (plane[0] == 0 && plane[1] == 0 && plane[2] == 0) continue;
    const Rational z = any(), y = any(), x = any();
    const Exact_point eye = at(x, y, z);
    scene.seen_from(eye);
    scene.certificate.cuts = {{0, 0}, {{1, 0, plane}}};
    const Rational of_eye = plane[0] * eye[0] + plane[1] * eye[1] + plane[2] * eye[2] + plane[3];
    const std::vector<order_check::Cut_places::Cut> found = order_check::cut_places(scene.certificate).others;
    ASSERT_EQ(found.size(), of_eye <= 0 ? 1u : 0u);
    (of_eye < 0 ? behind : of_eye > 0 ? in_front : through) += 1;
    if (found.empty()) continue;
    // The same plane, with the eye as the origin: a positive multiple of it.
    const Cone& cone = found[0].plane;
    std::size_t k = 0;
    while (plane[k] == 0) ++k;
    const Rational factor = cone.nearness[k] / plane[k];
    ASSERT_GT(factor, 0);
    for (k = 0; k < 3; ++k) ASSERT_EQ(cone.nearness[k], factor * plane[k]);
    ASSERT_EQ(cone.distance, -factor * of_eye);
  }
  EXPECT_GT(behind, least(500u));
  EXPECT_GT(in_front, least(500u));
  EXPECT_GT(through, least(10u));
}

TEST(Cuts, are_looked_at_once_for_each_place) {
  Scene scene = good_stack(3);
  Order_cuts& cuts = scene.certificate.cuts;
  cuts.depths = {5, 5, 5};
  const auto below = [](long distance) { return std::array<Rational, 4>{0, 0, -1, 4 - distance}; };  // the eye
  // Of each place the first of the least depth that is a plane, and not in front of the eye.
  cuts.others = {{2, 3, below(0)}, {1, 9, below(0)},     {0, 0, below(1)},         {3, 0, below(1)},
                 {2, 1, {}},       {2, 1, {0, 0, 1, 0}}, {1, 4, below(3)},         {2, 2, below(2)},
                 {1, 4, below(1)}, {2, 2, below(0)},     {4294967295, 0, below(1)}};
  const std::vector<order_check::Cut_places::Cut> found = order_check::cut_places(scene.certificate).others;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].place, 1u);
  EXPECT_EQ(found[0].depth, 4u);
  EXPECT_EQ(found[0].plane.distance, 3);
  EXPECT_EQ(found[1].place, 2u);
  EXPECT_EQ(found[1].depth, 2u);
  EXPECT_EQ(found[1].plane.distance, 2);
}

TEST(Cuts, are_followed_for_as_long_as_progress_lets_them) {
  Scene scene = good_stack(3000);
  for (std::uint32_t k = 0; k < 3000; ++k) scene.certificate.cuts.depths.push_back(k);
  for (std::uint32_t k = 0; k < 3000; ++k)  // none of them is a plane
    scene.certificate.cuts.others.push_back({1, k, {}});
  for (const int threads : {1, 3}) {
    std::atomic<int> asking = 0;
    std::size_t before_pairs = 0;
    Verify_options options;
    options.threads = threads;
    options.progress = [&](std::size_t done, std::size_t) {
      EXPECT_EQ(++asking, 1);
      before_pairs += done == 0;
      --asking;
    };
    const auto asked = [&] {
      before_pairs = 0;
      EXPECT_TRUE(verify_order(scene.soup, scene.certificate, options).accepted);
      return before_pairs;
    };
    const std::size_t all = asked();
    Order_cuts cuts;
    std::swap(cuts, scene.certificate.cuts);
    const std::size_t without = asked();
    scene.certificate.cuts.depths = cuts.depths;
    const std::size_t with_depths = asked();
    EXPECT_GT(with_depths, without + 60);
    EXPECT_EQ(all, with_depths + 3000);
    std::swap(cuts, scene.certificate.cuts);
  }
}

TEST(Cuts, are_asked_about_by_one_thread_at_a_time) {
  constexpr std::size_t count = 6000;  // two parts that threads have for themselves
  const Scene scene = good_stack(count);
  std::vector<Cone> cones;
  std::vector<std::uint32_t> depths;
  for (std::size_t k = 0; k < count; ++k) {
    cones.emplace_back(scene.certificate.fragments[k].vertices, scene.certificate.eye);
    depths.push_back(k == count / 2 ? 0 : static_cast<std::uint32_t>(1 + k % (count / 2)));
  }
  const std::vector<Rounded_cone> rounded(cones.begin(), cones.end());
  std::atomic<int> asking = 0, asked = 0, together = 0;
  certificate_check::Workers workers(2);
  workers.go_on = [&] {
    together += ++asking > 1;
    ++asked;
    std::this_thread::yield();
    --asking;
  };
  const Planes_between planes(cones, rounded, workers, {depths});
  EXPECT_GT(asked, 200);
  EXPECT_EQ(together, 0);
}

TEST(Cuts, change_no_verdict) {
  std::size_t accepted = 0, rejected = 0;
  for (unsigned seed = 0; seed < sample(300u); ++seed) {
    generate::Family_parameters parameters;
    parameters.seed = seed;
    const generate::Posed_scene posed = generate::family(seed % 2 == 0 ? "uniform" : "edge_on").make(parameters);
    const sightline::Scene scene(posed.soup);
    Order_certificate certificate = certificate_of_tree(scene, posed.eye);
    Dice dice(seed);
    const long last = static_cast<long>(certificate.fragments.size()) - 1;
    if (last < 1) continue;
    const auto any = [&] { return static_cast<std::size_t>(roll(dice, 0, last)); };
    for (long k = roll(dice, 0, 2); k > 0; --k) std::swap(certificate.fragments[any()], certificate.fragments[any()]);
    Order_certificate without = certificate;
    without.cuts = {};
    const Verdict expected = verify_order(posed.soup, without);
    for (int trial = 0; trial < 4; ++trial) {  // its own cuts, then others
      const Verdict verdict = verify_order(posed.soup, certificate);
      ASSERT_EQ(verdict.accepted, expected.accepted) << seed << ": " << verdict.why;
      ASSERT_EQ(verdict.why, expected.why) << seed;
      std::vector<std::uint32_t>& depths = certificate.cuts.depths;
      std::swap(depths[any()], depths[any()]);
      if (trial == 2) depths.pop_back();
      std::array<Rational, 4> plane;
      for (Rational& x : plane) x = roll(dice, -2, 2);
      if (trial == 1) mpz_set_ui(plane[1].get_den_mpz_t(), 0);  // no number
      certificate.cuts.others.push_back(
          {static_cast<std::uint32_t>(any() * 2), static_cast<std::uint32_t>(roll(dice, 0, 3)), plane});
    }
    (expected.accepted ? accepted : rejected) += 1;
  }
  EXPECT_GT(accepted, least(20u));
  EXPECT_GT(rejected, least(20u));
}

/// Squares over one another from far to near, of which some are exchanged.
Scene stack_with_exchanged(const std::vector<std::pair<std::size_t, std::size_t>>& exchanged) {
  constexpr long count = 500;
  Scene scene;
  scene.seen_from(at(0, 0, count + 1));
  for (long k = 0; k < count; ++k) {
    const Points square = rectangle(-1, 1, -1, 1, k);
    scene.face(square);
    scene.draw(static_cast<Face_id>(k), square);
  }
  for (const auto& [i, j] : exchanged) std::swap(scene.certificate.fragments[i], scene.certificate.fragments[j]);
  return scene;
}

TEST(Threads_of_checkers, change_no_verdict) {
  using Pairs_exchanged = std::vector<std::pair<std::size_t, std::size_t>>;
  for (const Pairs_exchanged& exchanged : {Pairs_exchanged{}, {{3, 4}}, {{490, 499}, {100, 400}, {7, 450}}}) {
    Scene scene = stack_with_exchanged(exchanged);
    const auto verdict_with = [&](int threads) {
      Verify_options options;
      options.threads = threads;
      return verify_order(scene.soup, scene.certificate, options);
    };
    const Verdict one = verdict_with(1);
    EXPECT_EQ(one.accepted, exchanged.empty()) << one.why;
    for (const int threads : {2, 5}) {
      const Verdict more = verdict_with(threads);
      EXPECT_EQ(more.accepted, one.accepted);
      EXPECT_EQ(more.why, one.why);
      EXPECT_EQ(more.fragments, one.fragments);
    }
  }
  // And with faces at fault, the first of them.
  Scene scene = stack_with_exchanged({});
  for (const std::size_t i : {123, 321, 456})
    std::reverse(scene.certificate.fragments[i].vertices.begin(), scene.certificate.fragments[i].vertices.end());
  Verify_options options;
  for (const int threads : {1, 2, 5}) {
    options.threads = threads;
    const Verdict verdict = verify_order(scene.soup, scene.certificate, options);
    EXPECT_FALSE(verdict.accepted);
    EXPECT_EQ(verdict.fragments, (std::vector<std::size_t>{123})) << verdict.why;
  }
}

TEST(Threads_of_checkers, call_all_once_or_throw_what_comes_first) {
  for (const int threads : {0, 1, 2, 7})
    for (const std::size_t count : {0u, 1u, 10u, 1000u}) {
      std::vector<std::atomic<int>> calls(count);
      certificate_check::for_each_below(count, 1, threads, [&](std::size_t i) { ++calls[i]; });
      EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](const std::atomic<int>& n) { return n == 1; }));
    }
  for (const int threads : {1, 2, 7})
    for (int trial = 0; trial < 50; ++trial) {
      std::vector<std::atomic<int>> calls(300);
      try {
        certificate_check::for_each_below(calls.size(), 1, threads, [&](std::size_t i) {
          ++calls[i];
          if (i % 100 == 99) throw i;
        });
        ADD_FAILURE() << "nothing was thrown";
      } catch (const std::size_t i) {
        EXPECT_EQ(i, 99u);
      }
      EXPECT_TRUE(std::all_of(calls.begin(), calls.begin() + 100, [](const std::atomic<int>& n) { return n == 1; }));
    }
}

TEST(Threads_of_checkers, ask_before_each_step_one_at_a_time_and_end_with_what_that_throws) {
  for (const int threads : {1, 2, 7})
    for (const std::size_t enough : {0u, 1u, 200u}) {  // steps that are allowed
      std::atomic<std::size_t> asking = 0, steps = 0;
      std::size_t asked = 0;
      Verify_options options;
      options.threads = threads;
      options.progress = [&](std::size_t done, std::size_t total) {
        EXPECT_EQ(++asking, 1u);
        EXPECT_EQ(done, 0u);
        EXPECT_EQ(total, 17u);
        --asking;
        if (asked == enough) throw std::string("enough");
        ++asked;
      };
      const certificate_check::Workers workers(options, 17);
      EXPECT_THROW(certificate_check::for_each_below(1000, 1, workers, [&](std::size_t) { ++steps; }), std::string);
      EXPECT_EQ(steps, enough);
      EXPECT_EQ(asked, enough);
    }
}

}  // namespace
