// The one surface of a face that is not planar (P-22): what the checker takes, against all triangulations there are,
// and against what scenes are made of.

#include "../sample.h"
#include "../soup.h"
#include "scenes.h"

#include <sightline/algorithms/verify/surface.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/harness/generate/families.h>
#include <sightline/kernel/scene/scene.h>

#include <optional>
#include <set>

namespace {

using namespace verify_test;
using certificate_check::Face;
using certificate_check::Skew_face;
using test_scenes::least;
using test_scenes::sample;
using test_scenes::soup_of;

// ---- Surfaces as sorted triangles

using Triangles = std::vector<Points>;

Points from_least(Points triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

Triangles sorted(Triangles triangles) {
  for (Points& triangle : triangles) triangle = from_least(std::move(triangle));
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

Triangles turned_round(Triangles triangles) {
  for (Points& triangle : triangles) triangle = reversed(triangle);
  return sorted(triangles);
}

/// What a scene makes of a face.
Triangles made(const Polygon_soup& soup, Face_id face = 0) {
  const sightline::Scene scene(soup);
  Triangles triangles;
  for (const Piece& piece : scene.pieces()) {
    if (piece.face != face) continue;
    triangles.push_back(scene.corner_points(piece));
  }
  return sorted(triangles);
}
Triangles made(const Points& loop) { return made(soup_of({loop})); }

/// Why the checker rejects them; empty: it does not.
std::string flaw(const Polygon_soup& soup, const Triangles& triangles, Face_id face = 0) {
  std::vector<certificate_check::Surface_piece> pieces;
  for (const Points& triangle : triangles) pieces.push_back({&triangle, "piece"});
  try {
    check_surface("the face", Face(soup, face), pieces);
  } catch (const certificate_check::Rejection& rejection) {
    return rejection.verdict.why;
  }
  return {};
}
std::string flaw(const Points& loop, const Triangles& triangles) { return flaw(soup_of({loop}), triangles); }

/// All triangulations of a polygon's corners [first, last], as triangles of places.
std::vector<Triangles> triangulations(const Points& loop, std::size_t first, std::size_t last) {
  if (last - first < 2) return {{}};
  std::vector<Triangles> all;
  for (std::size_t middle = first + 1; middle < last; ++middle)
    for (const Triangles& left : triangulations(loop, first, middle))
      for (const Triangles& right : triangulations(loop, middle, last)) {
        Triangles& whole = all.emplace_back(left);
        whole.insert(whole.end(), right.begin(), right.end());
        whole.push_back({loop[first], loop[middle], loop[last]});
      }
  return all;
}

/// Corners on a small grid, so that many lie on lines and circles; or around the z axis, so that its projection is
/// simple.
Points random_loop(Dice& dice, std::size_t size, bool around) {
  Points loop;
  const std::vector<std::pair<long, long>> ring{{5, 0},  {4, 3},   {3, 4},  {0, 5},  {-3, 4}, {-4, 3},
                                                {-5, 0}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};  // on one circle
  if (!around) {
    while (loop.size() < size) loop.push_back(at(roll(dice, -2, 2), roll(dice, -2, 2), roll(dice, -2, 2)));
    return loop;
  }
  std::set<std::size_t> places;
  while (places.size() < size) places.insert(dice() % ring.size());
  for (const std::size_t k : places) {
    const long in = roll(dice, 0, 4) == 0 ? 2 : 5;  // some are nearer
    loop.push_back(at(ratio(in * ring[k].first, 5), ratio(in * ring[k].second, 5), roll(dice, -1, 1)));
  }
  return loop;
}

TEST(Surface, is_one_of_all_triangulations_of_a_polygon) {
  Dice dice(1);
  std::size_t along_an_axis = 0, ties = 0, cones = 0;
  for (int trial = 0; trial < sample(1200); ++trial) {
    const std::size_t size = 4 + dice() % 3;
    const Points loop = random_loop(dice, size, trial % 3 != 0);
    const Polygon_soup soup = soup_of({loop});
    const Face face(soup, 0);
    if (face.planar || face.loops[0].size() != size) continue;
    const Skew_face skew(face);
    const Triangles own = made(soup);
    if (skew.loops.empty()) {
      EXPECT_TRUE(own.empty());
      continue;
    }
    ASSERT_EQ(flaw(soup, own), "") << trial;
    std::size_t accepted = 0;
    for (const Triangles& triangles : triangulations(loop, 0, size - 1))
      if (flaw(soup, triangles).empty()) {
        ++accepted;
        EXPECT_EQ(sorted(triangles), own) << trial;
      } else {
        ties += flaw(soup, triangles).find("should be the other one") != std::string::npos;
      }
    const bool all_differ = std::set<Exact_point>(loop.begin(), loop.end()).size() == size;
    if (all_differ && skew.loops[0].size() == size && skew.axis()) {
      EXPECT_EQ(accepted, 1u) << trial;
      ++along_an_axis;
    } else {
      EXPECT_LE(accepted, 1u) << trial;
      ++cones;
    }
  }
  EXPECT_GT(along_an_axis, least(500u));
  EXPECT_GT(ties, least(1000u));
  EXPECT_GT(cones, least(200u));
}

TEST(Surface, does_not_depend_on_accidents_of_the_loop) {
  Dice dice(2);
  std::size_t faces = 0;
  for (int trial = 0; trial < sample(400); ++trial) {
    const Points loop = random_loop(dice, 4 + dice() % 5, trial % 2 != 0);
    const Triangles own = made(loop);
    if (own.empty() || Face(soup_of({loop}), 0).planar) continue;
    ++faces;
    // Begun elsewhere, with repeated and straight points, and with spikes.
    Points other = loop;
    std::rotate(other.begin(), other.begin() + static_cast<std::ptrdiff_t>(dice() % loop.size()), other.end());
    for (int k = 0; k < 3; ++k) {
      const std::size_t i = dice() % other.size();
      const Exact_point p = other[i], q = other[(i + 1) % other.size()];
      Points extra;
      switch (dice() % 3) {
        case 0: extra = {p}; break;
        case 1: extra = {at((2 * p[0] + q[0]) / 3, (2 * p[1] + q[1]) / 3, (2 * p[2] + q[2]) / 3)}; break;
        default: extra = {at(roll(dice, -9, 9), roll(dice, -9, 9), roll(dice, -9, 9)), p}; break;
      }
      other.insert(other.begin() + static_cast<std::ptrdiff_t>(i) + 1, extra.begin(), extra.end());
    }
    EXPECT_EQ(made(other), own) << trial;
    EXPECT_EQ(flaw(other, own), "") << trial;
    EXPECT_EQ(made(soup_of({other, loop})), own) << trial;
    EXPECT_EQ(made(soup_of({loop, other})), own) << trial;
    // The other way round, moved, and scaled.
    EXPECT_EQ(made(reversed(loop)), turned_round(own)) << trial;
    EXPECT_EQ(flaw(reversed(loop), turned_round(own)), "") << trial;
    const auto moved = [](Points points) {
      for (Exact_point& p : points) p = at(p[0] * ratio(7, 3) + 1000, p[1] * ratio(7, 3) - 5, p[2] * ratio(7, 3));
      return points;
    };
    Triangles there = own;
    for (Points& triangle : there) triangle = moved(triangle);
    EXPECT_EQ(made(moved(loop)), sorted(there)) << trial;
  }
  EXPECT_GT(faces, least(200u));
}

TEST(Surface, of_a_face_with_holes_has_no_other_diagonal) {
  std::size_t flips = 0;
  for (std::uint64_t seed = 0; seed < sample(120u); ++seed) {
    generate::Family_parameters parameters;
    parameters.seed = seed;
    const Polygon_soup soup = generate::family("twisted_holes").make(parameters).soup;
    const sightline::Scene scene(soup);
    for (const Face_id f : scene.non_planar()) {
      const Triangles own = made(soup, f);
      ASSERT_EQ(flaw(soup, own, f), "") << seed;
      for (std::size_t i = 0; i < own.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b) {
              const Points &t = own[i], &u = own[j];
              if (t[a] != u[(b + 1) % 3] || t[(a + 1) % 3] != u[b]) continue;
              Triangles flipped = own;
              flipped[i] = {t[a], u[(b + 2) % 3], t[(a + 2) % 3]};
              flipped[j] = {t[(a + 1) % 3], t[(a + 2) % 3], u[(b + 2) % 3]};
              EXPECT_NE(flaw(soup, flipped, f), "") << seed;
              ++flips;
            }
    }
  }
  EXPECT_GT(flips, least(200u));
}

TEST(Surface, is_no_choice_of_the_forger) {
  const Points saddle = {at(0, 0, 0), at(4, 0, 1), at(4, 4, 0), at(0, 4, 1)};
  const auto corners = [](const Points& all, std::initializer_list<std::size_t> which) {
    Points result;
    for (const std::size_t k : which) result.push_back(all[k]);
    return result;
  };
  // Seen along z the corners are on one circle: the diagonal from the least of them.
  EXPECT_EQ(flaw(saddle, {corners(saddle, {0, 1, 2}), corners(saddle, {0, 2, 3})}), "");
  EXPECT_NE(flaw(saddle, {corners(saddle, {0, 1, 3}), corners(saddle, {1, 2, 3})}).find("should be the other one"),
            std::string::npos);
  // One corner moved in or out a little: then one diagonal is shorter.
  for (const int in : {-1, 1}) {
    Points moved = saddle;
    moved[2] = at(4 - in * tiny(100), 4, 0);
    moved[0] = at(in * tiny(100), 0, 0);
    EXPECT_EQ(flaw(moved, {corners(moved, {0, 1, 2}), corners(moved, {0, 2, 3})}).empty(), in == 1);
    EXPECT_EQ(flaw(moved, {corners(moved, {0, 1, 3}), corners(moved, {1, 2, 3})}).empty(), in == -1);
  }
  // A spike gives no triangle and its reverse, in the plane of other faces or not.
  const Points spiked = {at(12, 9, 1), at(12, -21, 1), at(13, -21, 1), at(13, 0, 2), at(-9, 12, 1), at(13, 0, 2)};
  const Triangles without = made(Points(spiked.begin(), spiked.begin() + 4));
  ASSERT_EQ(without.size(), 2u);
  EXPECT_EQ(made(spiked), without);
  EXPECT_EQ(flaw(spiked, without), "");
  Triangles phantom = without;
  phantom.push_back(corners(spiked, {0, 3, 4}));
  phantom.push_back(corners(spiked, {0, 4, 3}));
  EXPECT_NE(flaw(spiked, phantom), "");
  // Nor do edges that are walked back elsewhere on the loop, as a bridge to a hole.
  const Points bridge = {at(0, 0, 0), at(8, 0, 0), at(8, 8, 1), at(0, 8, 0), at(0, 0, 0),
                         at(2, 2, 0), at(2, 4, 0), at(4, 4, 0), at(4, 2, 0), at(2, 2, 0)};
  EXPECT_EQ(flaw(bridge, made(bridge)), "");
  EXPECT_EQ(made(bridge).size(), 8u);
  // No triangle may cross such an edge, though its two ways cancel: here it joins corners 0 and 5 (4 is 0 again).
  const Points crossed = {at(0, 0, 0), at(10, 0, 0), at(10, 10, 1), at(0, 10, 0), at(0, 0, 0),
                          at(6, 4, 0), at(4, 3, 0),  at(4, 6, 0),   at(6, 6, 0),  at(6, 4, 0)};
  EXPECT_EQ(flaw(crossed, made(crossed)), "");
  Triangles over_it;
  for (const std::initializer_list<std::size_t> triangle : std::initializer_list<std::initializer_list<std::size_t>>{
           {1, 2, 5}, {2, 8, 5}, {2, 3, 8}, {3, 7, 8}, {3, 0, 7}, {0, 6, 7}, {0, 1, 6}, {1, 5, 6}})
    over_it.push_back(corners(crossed, triangle));
  EXPECT_NE(flaw(crossed, over_it).find("is crossed by an edge of the face"), std::string::npos)
      << flaw(crossed, over_it);
}

TEST(Surface, is_the_cone_from_the_least_point_where_no_projection_is_simple) {
  const Points tangle = {at(0, 0, 0), at(10, 0, 10), at(0, 10, 10), at(10, 10, 0), at(5, -5, 5), at(-3, 7, -4)};
  Triangles cone;
  for (std::size_t k = 0; k < 4; ++k) cone.push_back({tangle[5], tangle[k], tangle[k + 1]});
  EXPECT_EQ(made(tangle), sorted(cone));
  EXPECT_EQ(flaw(tangle, cone), "");
  for (std::size_t k = 0; k < 5; ++k) {
    Triangles other;
    for (std::size_t i = 1; i < 5; ++i) other.push_back({tangle[k], tangle[(k + i) % 6], tangle[(k + i + 1) % 6]});
    EXPECT_NE(flaw(tangle, other).find("the triangles from its least point"), std::string::npos);
  }
  Triangles less = cone;
  less.pop_back();
  EXPECT_NE(flaw(tangle, less), "");
  // Edges that pass corners, there and in part back, are so much less.
  const Points passing = {at(0, 0, 0), at(4, 0, 0), at(4, 4, 2), at(2, 0, 0), at(0, 4, 2), at(1, -3, 5)};
  EXPECT_EQ(flaw(passing, made(passing)), "");
}

}  // namespace
