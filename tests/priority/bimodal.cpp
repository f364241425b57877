// The highest corner of a convex polygon over a plane, by bisection, against looking at all corners.

#include "../sample.h"
#include "support.h"

#include <sightline/algorithms/priority/bimodal.h>
#include <sightline/algorithms/priority/eye_order.h>

#include <random>

using namespace priority_test;

namespace {

using test_scenes::sample;

static_assert(Slope_traits<Exact_traits>);

/// A convex polygon of n edges with integer coordinates in the plane spanned by u and v: random edges, and one that
/// closes it, in order of angle. Most of them look one way, so that few edges rise or few fall over a plane. Begun
/// anywhere.
Points lattice_polygon(long n, const std::array<long, 3>& u, const std::array<long, 3>& v, std::mt19937& random) {
  const auto any = [&](long reach) {
    return static_cast<long>(random() % static_cast<unsigned long>(2 * reach + 1)) - reach;
  };
  const long reach = n < 100 ? 4 : 1000, bias_x = any(9), bias_y = any(9);
  std::vector<std::pair<long, long>> edges;
  long x = 0, y = 0;
  while (static_cast<long>(edges.size()) + 1 < n) {
    const long dx = any(reach), dy = any(reach);
    if ((dx == 0 && dy == 0) || (dx * bias_x + dy * bias_y < 0 && random() % 8 != 0)) continue;
    edges.emplace_back(dx, dy);
    x += dx;
    y += dy;
  }
  if (x != 0 || y != 0) edges.emplace_back(-x, -y);
  const auto half = [](const std::pair<long, long>& d) { return d.second < 0 || (d.second == 0 && d.first < 0); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) {
    return half(a) != half(b) ? half(a) < half(b) : a.first * b.second > a.second * b.first;
  });
  Points corners;
  x = y = 0;
  for (const auto& [dx, dy] : edges) {
    corners.push_back(at(x * u[0] + y * v[0], x * u[1] + y * v[1], x * u[2] + y * v[2]));
    x += dx;
    y += dy;
  }
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random() % corners.size()), corners.end());
  return corners;
}

TEST(Bimodal, finds_the_highest_corner_of_any_polygon_over_any_plane) {
  std::mt19937 random(5);
  const auto small = [&] { return static_cast<long>(random() % 7) - 3; };
  std::size_t compared = 0, level = 0, parallel = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const std::array<long, 3> u{small(), small(), small()}, v{small(), small(), small()};
    const long n = std::array<long, 5>{4, 6, 9, 20, 70}[static_cast<std::size_t>(trial % 5)];
    Polygon_soup soup = soup_of({lattice_polygon(n, u, v, random)});
    for (int k = 0; k < 8; ++k)
      add_face(soup, {at(small(), small(), small()), at(small(), small(), small()), at(small(), small(), small())});
    add_face(soup, {at(0, 0, 9), at(u[0], u[1], 9 + u[2]), at(v[0], v[1], 9 + v[2])});  // parallel
    const Related scene(std::move(soup));
    if (scene.relation.size() == 0 || scene.traits.face(0) != 0) continue;  // u and v are parallel
    const auto& polygon = scene.relation[0];
    for (std::uint32_t j = 1; j < scene.relation.size(); ++j)
      for (const Plane plane : {scene.relation.plane(j), scene.relation.plane(j).opposite()}) {
        Predicate_counts counts;
        const std::uint32_t found = highest_corner(scene.traits, polygon, scene.traits.prepare(plane), counts);
        ASSERT_LT(found, polygon.size);
        const std::array<Rational, 4> h = scene.scene.file_coefficients(plane);
        std::vector<Rational> heights;
        for (const auto& corner : polygon) {
          const Exact_point p = scene.traits.position(*corner.vertex);
          heights.push_back(h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3]);
        }
        const Rational most = *std::max_element(heights.begin(), heights.end());
        ASSERT_EQ(heights[found], most) << "trial " << trial << ", plane " << j << ", " << polygon.size << " corners";
        Polygon_store<Exact_traits> store;
        const std::uint32_t from_behind =
            highest_corner(scene.traits, turned_round(polygon, store), scene.traits.prepare(plane), counts);
        ASSERT_EQ(heights[polygon.size - 1 - from_behind], most) << "turned round, trial " << trial << ", plane " << j;
        const auto highest = std::count(heights.begin(), heights.end(), most);
        ++compared;
        level += highest > 1;
        parallel += highest == static_cast<long>(polygon.size);
      }
  }
  EXPECT_GT(compared, 4000u);
  EXPECT_GT(level, 300u);
  EXPECT_GT(parallel, 300u);
}

TEST(Bimodal, takes_logarithmically_many_predicates) {
  std::mt19937 random(77);
  Polygon_soup soup = soup_of({lattice_polygon(4000, {1, 2, 0}, {0, 1, 3}, random)});
  add_face(soup, {at(0, 0, 0), at(5, 1, 0), at(2, 1, 7)});
  const Related scene(std::move(soup));
  ASSERT_GE(scene.relation[0].size, 3900u);
  Predicate_counts counts;
  highest_corner(scene.traits, scene.relation[0], scene.relation.cutter(1), counts);
  EXPECT_LE(counts.total(), 60u);
  EXPECT_GE(counts.total(), 10u);
}

TEST(Bimodal, decides_the_relation_of_polygons_of_many_corners) {
  // Discs above each other, one across both, and triangles.
  std::mt19937 random(3);
  Polygon_soup soup = soup_of({lattice_polygon(sample(300), {1, 0, 0}, {0, 1, 0}, random),
                               lattice_polygon(sample(600), {1, 0, 1}, {0, 1, 2}, random),
                               reversed(lattice_polygon(sample(300), {0, 1, 1}, {1, 0, 0}, random))});
  for (int k = 0; k < 20; ++k) {
    const auto any = [&] { return ratio(static_cast<long>(random() % 200001) - 100000, 1); };
    add_face(soup, {at(any(), any(), any()), at(any(), any(), any()), at(any(), any(), any())});
  }
  const Related scene(std::move(soup));
  const Matrix expected = arcs_of(sides_of(scene.flats));
  Relation_counters counters;
  std::size_t arcs = 0;
  for (std::uint32_t i = 0; i < scene.relation.size(); ++i)
    for (std::uint32_t j = 0; j < scene.relation.size(); ++j) {
      ASSERT_EQ(scene.relation.may_obscure(i, j, counters), expected[i][j] != 0) << i << " < " << j;
      const Arcs both = scene.relation.arcs(i, j, counters);
      ASSERT_TRUE(both.forth == (expected[i][j] != 0) && both.back == (expected[j][i] != 0)) << i << ", " << j;
      arcs += expected[i][j] != 0;
    }
  EXPECT_GT(arcs, 60u);
  // From behind they are turned round, edges and all.
  const Priority_tree<Exact_traits> tree = build_priority_tree(scene.traits, {true, false, {}});
  const Eye_order<Exact_traits> order = back_to_front(scene.traits, tree, at(100, 50, -2000000));
  EXPECT_GE(order.polygons.size(), scene.relation.size());
  Relation_counters few;
  scene.relation.may_obscure(0, 3, few);
  EXPECT_LE(few.predicates.total(), 110u) << "of 100 corners and more";
}

TEST(Orientation, of_three_planes_is_the_determinant_of_their_normals) {
  std::mt19937 random(9);
  Polygon_soup soup;
  const auto any = [&] { return ratio(static_cast<long>(random() % 2001) - 1000, 1); };
  for (int k = 0; k < 40; ++k)
    add_face(soup, {at(any(), any(), any()), at(any(), any(), any()), at(any(), any(), any())});
  for (int k = 0; k < 10; ++k) add_face(soup, {at(k, 0, 0), at(k + 1, 0, 0), at(k, 1, k % 3)});
  const Related scene(std::move(soup));
  Predicate_counts counts;
  std::size_t zeros = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::array<Plane, 3> planes;
    for (Plane& plane : planes) {
      plane = scene.relation.plane(static_cast<std::uint32_t>(random() % scene.relation.size()));
      if (random() % 2) plane = plane.opposite();
    }
    std::array<std::array<Integer, 4>, 3> h;
    for (std::size_t k = 0; k < 3; ++k) h[k] = scene.traits.predicates().coefficients(planes[k]);
    const Integer determinant = h[0][0] * (h[1][1] * h[2][2] - h[1][2] * h[2][1]) -
                                h[0][1] * (h[1][0] * h[2][2] - h[1][2] * h[2][0]) +
                                h[0][2] * (h[1][0] * h[2][1] - h[1][1] * h[2][0]);
    ASSERT_EQ(static_cast<int>(scene.traits.predicates().orientation(planes[0], planes[1], planes[2], counts)),
              sgn(determinant))
        << trial;
    zeros += sgn(determinant) == 0;
  }
  EXPECT_GT(zeros, 500u);
  EXPECT_GT(counts.combinatorial, 100u);
}

}  // namespace
