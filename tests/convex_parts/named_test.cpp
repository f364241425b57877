// Polygons with a name: each claims its contour's kind and, where it is simple, a correct partition.

#include "../sample.h"
#include "oracle.h"

#include <sightline/kernel/time_limit.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

using namespace oracle;

namespace {

Polygon polygon(std::vector<std::vector<std::pair<long, long>>> loops) {
  Polygon result;
  for (const auto& loop : loops) {
    Loop& indices = result.loops.emplace_back();
    for (const auto& [x, y] : loop) {
      indices.push_back(static_cast<std::uint32_t>(result.points.size()));
      result.points.push_back({Integer(x), Integer(y)});
    }
  }
  return result;
}

/// The same polygon with one index for each point.
Polygon shared(const Polygon& given) {
  Polygon result;
  for (const Loop& loop : given.loops) {
    Loop& indices = result.loops.emplace_back();
    for (const std::uint32_t p : loop) {
      std::uint32_t q = 0;
      while (q < result.points.size() &&
             !(result.points[q].x == given.points[p].x && result.points[q].y == given.points[p].y))
        ++q;
      if (q == result.points.size()) result.points.push_back(given.points[p]);
      indices.push_back(q);
    }
  }
  return result;
}

void expect_simple(const Polygon& given, std::size_t most_pieces, bool exhaustive = true) {
  const Polygon once = shared(given);
  for (const Polygon* p : {&given, &once}) {
    const Convex_parts pieces = parts_of(*p), fine = triangles_of(*p);
    EXPECT_TRUE(is_partition(*p, pieces, true, exhaustive));
    EXPECT_TRUE(is_partition(*p, fine, true, exhaustive));
    EXPECT_LE(pieces.pieces.size(), fine.pieces.size());
    EXPECT_LE(pieces.pieces.size(), most_pieces);
    for (const Loop& t : fine.pieces) EXPECT_EQ(t.size(), 3u);
  }
}

void expect_contour(const Polygon& given, Contour kind) {
  const Polygon once = shared(given);
  for (const Polygon* p : {&given, &once})
    for (const Convex_parts& parts : {parts_of(*p), triangles_of(*p)}) {
      EXPECT_EQ(parts.contour, kind);
      EXPECT_TRUE(parts.pieces.empty());
    }
}

}  // namespace

TEST(Convex_parts, a_convex_polygon_is_one_piece) {
  expect_simple(polygon({{{0, 0}, {4, 0}, {4, 3}, {0, 3}}}), 1);
  expect_simple(polygon({{{0, 0}, {4, 0}, {1, 5}}}), 1);
  EXPECT_EQ(parts_of(polygon({{{4, 3}, {0, 3}, {0, 0}, {4, 0}}})).pieces, (std::vector<Loop>{{0, 1, 2, 3}}));
}

TEST(Convex_parts, straight_and_repeated_corners_are_dropped) {
  const Polygon p = polygon({{{0, 0}, {0, 0}, {2, 0}, {4, 0}, {4, 0}, {4, 3}, {2, 3}, {2, 3}, {0, 3}, {0, 0}}});
  expect_simple(p, 1);
  EXPECT_EQ(parts_of(p).pieces, (std::vector<Loop>{{0, 3, 5, 8}}));
}

TEST(Convex_parts, the_least_of_equal_indices_stands_for_all) {
  Polygon p = polygon({{{0, 0}, {4, 0}, {4, 3}, {0, 3}, {0, 0}}});
  p.loops = {{4, 1, 2, 3, 0}};
  EXPECT_EQ(parts_of(p).pieces, (std::vector<Loop>{{0, 1, 2, 3}}));
  p.loops = {{1, 2, 3, 0, 4}};
  EXPECT_EQ(parts_of(p).pieces, (std::vector<Loop>{{0, 1, 2, 3}}));
  p.loops = {{4, 1, 2}};
  EXPECT_EQ(parts_of(p).pieces, (std::vector<Loop>{{1, 2, 4}}));  // 0 is used by no loop
  p.loops = {{4, 1, 2}, {0}};
  EXPECT_EQ(parts_of(p).pieces, (std::vector<Loop>{{0, 1, 2}}));
}

TEST(Convex_parts, triangles_keep_straight_points_as_corners) {
  const Polygon p = polygon({{{0, 0}, {2, 0}, {4, 0}, {4, 3}}});
  EXPECT_EQ(triangles_of(p).pieces.size(), 2u);
  expect_simple(p, 1);
}

TEST(Convex_parts, a_straight_point_of_the_polygon_may_be_a_corner_of_a_piece) {
  // A cross whose arms' ends meet the middle square: pieces have corners where the outline is straight for others.
  expect_simple(polygon({{{0, 0}, {2, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}, {0, 2}}}), 2);
}

TEST(Convex_parts, letters) {
  expect_simple(polygon({{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 5}, {0, 5}}}), 2);                    // L
  expect_simple(polygon({{{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}}), 3);    // U
  expect_simple(polygon({{{0, 0}, {1, 0}, {1, 3}, {3, 3}, {3, 4}, {-2, 4}, {-2, 3}, {0, 3}}}), 3);  // T
}

TEST(Convex_parts, comb) {
  Polygon p;
  Loop loop;
  const long teeth = 500;
  const auto add = [&](long x, long y) {
    loop.push_back(static_cast<std::uint32_t>(p.points.size()));
    p.points.push_back({Integer(x), Integer(y)});
  };
  add(0, -1);
  add(2 * teeth, -1);
  for (long i = teeth; i > 0; --i) {
    add(2 * i, 10);
    add(2 * i - 1, 10);
    add(2 * i - 1, 0);
    add(2 * i - 2, 0);
  }
  p.loops = {loop};
  expect_simple(p, 2 * teeth + 1, false);
}

TEST(Convex_parts, rectangular_spiral) {
  // Walls of thickness 1, corridors of width 1.
  std::vector<std::pair<long, long>> outer, inner;
  long x = 0, y = 0, length = 200;
  const long dx[] = {1, 0, -1, 0}, dy[] = {0, 1, 0, -1};
  for (int k = 0; length > 4; ++k) {
    outer.emplace_back(x, y);
    // The inner line is offset to the left of the path by one.
    const int d = k % 4, e = (k + 3) % 4;
    inner.emplace_back(x + (k == 0 ? 0 : -dy[d] - dy[e]), y + (k == 0 ? 1 : dx[d] + dx[e]));
    x += length * dx[d];
    y += length * dy[d];
    if (k > 0) length -= 2;
  }
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  expect_simple(polygon({outer}), outer.size(), true);
}

TEST(Convex_parts, star) {
  std::vector<std::pair<long, long>> loop;
  for (int i = 0; i < 40; ++i) {
    const double angle = 6.283185307179586 * i / 40, r = i % 2 ? 1000 : 300;
    loop.emplace_back(std::lround(r * std::cos(angle)), std::lround(r * std::sin(angle)));
  }
  expect_simple(polygon({loop}), 21);
}

TEST(Convex_parts, keyhole) {
  // A frame as one loop: the bridge (0,0)-(2,2) is walked twice.
  expect_simple(polygon({{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {2, 2}, {2, 6}, {6, 6}, {6, 2}, {2, 2}}}), 4);
  // The same with a straight point on one side of the bridge only.
  expect_simple(polygon({{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {1, 1}, {2, 2}, {2, 6}, {6, 6}, {6, 2}, {2, 2}}}), 4);
}

TEST(Convex_parts, a_bridge_without_a_hole_does_not_cut) {
  // A slit with straight points inside a square: merged across all of it.
  expect_simple(polygon({{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {1, 1}, {2, 2}, {3, 3}, {5, 5}, {2, 2}}}), 1);
}

TEST(Convex_parts, spikes) {
  expect_simple(polygon({{{0, 0}, {4, 0}, {9, 0}, {4, 0}, {4, 4}, {0, 4}}}), 1);   // outwards, straight on
  expect_simple(polygon({{{0, 0}, {4, 0}, {4, 4}, {7, 7}, {4, 4}, {0, 4}}}), 1);   // outwards, askew
  expect_simple(polygon({{{0, 0}, {4, 0}, {4, 4}, {3, 2}, {4, 4}, {0, 4}}}), 3);   // inwards: its tip is a point inside
  expect_simple(polygon({{{0, 0}, {4, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}}}), 1);   // back along the edge
  expect_simple(polygon({{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 4}}}), 1);   // a whole diagonal and back
  expect_simple(polygon({{{0, 0}, {4, 0}, {-3, 0}, {4, 0}, {4, 4}, {0, 4}}}), 1);  // over the whole edge and beyond
  expect_simple(polygon({{{0, 0}, {6, 0}, {3, 3}, {6, 0}, {6, 6}}}), 1);           // up to an edge from within
}

TEST(Convex_parts, a_spike_that_crosses_an_edge_is_a_crossing) {
  expect_contour(polygon({{{0, 0}, {4, 0}, {4, 4}, {-3, 2}, {4, 4}, {0, 4}}}), Contour::self_intersecting);
}

TEST(Convex_parts, holes) {
  const std::vector<std::pair<long, long>> square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const std::vector<std::pair<long, long>> hole{{2, 2}, {4, 2}, {4, 4}, {2, 4}}, second{{6, 5}, {8, 5}, {7, 9}};
  for (const bool reverse : {false, true}) {
    auto h = hole;
    if (reverse) h = {hole.rbegin(), hole.rend()};
    expect_simple(polygon({square, h}), 4);
    expect_simple(polygon({square, h, second}), 9);
    expect_simple(polygon({square, second, h}), 9);
  }
  expect_simple(polygon({square, {{0, 0}, {4, 2}, {2, 4}}}), 4);                // touches in a corner
  expect_simple(polygon({square, {{0, 5}, {4, 2}, {4, 7}}}), 5);                // touches an edge
  expect_simple(polygon({square, {{0, 0}, {10, 10}, {0, 10}}}), 1);             // shares two edges
  expect_simple(polygon({square, {{0, 2}, {4, 2}, {4, 4}, {0, 4}}}), 3);        // shares part of an edge
  expect_simple(polygon({square, hole, {{4, 4}, {6, 4}, {6, 6}, {4, 6}}}), 9);  // holes touch in a corner
  expect_simple(polygon({square, hole, {{4, 3}, {6, 3}, {6, 6}, {4, 6}}}), 9);  // holes share part of an edge
  expect_simple(polygon({square, {{1, 1}, {9, 9}, {5, 5}}}), 1);                // a slit
  expect_simple(polygon({square, {{5, 5}}, {}}), 1);                            // a point, nothing
  expect_simple(polygon({square, {{5, 5}, {5, 5}, {6, 5}}}), 4);                // an edge and back
  expect_contour(polygon({square, square}), Contour::zero_area);
  expect_contour(polygon({square, hole, hole}), Contour::self_intersecting);
  expect_contour(polygon({square, {{1, 1}, {9, 1}, {9, 9}, {1, 9}}, hole}),
                 Contour::self_intersecting);                                                  // a hole in a hole
  expect_contour(polygon({square, {{11, 1}, {12, 1}, {12, 2}}}), Contour::self_intersecting);  // outside
  expect_contour(polygon({square, {{5, 5}, {15, 5}, {15, 6}}}), Contour::self_intersecting);   // half outside
}

TEST(Convex_parts, contours_that_are_not_simple) {
  expect_contour(polygon({{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 4}, {0, 4}}}),
                 Contour::self_intersecting);                                               // double-wound square
  expect_contour(polygon({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}), Contour::self_intersecting);  // bow-tie
  expect_contour(polygon({{{0, 0}, {9, 9}, {4, 0}, {0, 4}}}), Contour::self_intersecting);  // unequal bow-tie
  expect_contour(polygon({{{0, 0}, {0, 4}, {4, 4}, {4, 0}}}), Contour::self_intersecting);  // clockwise
  expect_contour(polygon({{{0, 0}, {0, 4}, {4, 4}}}), Contour::self_intersecting);          // clockwise triangle
  expect_contour(polygon({{{0, 0}, {0, 4}, {4, 4}, {1, 3}}}), Contour::self_intersecting);  // clockwise, concave
  // Pentagram: every turn is to the left, but it goes round twice.
  expect_contour(polygon({{{0, 10}, {-6, -8}, {9, 3}, {-9, 3}, {6, -8}}}), Contour::self_intersecting);
  // A loop in a loop, both counterclockwise, no edges crossing.
  expect_contour(polygon({{{0, 0}, {9, 0}, {0, 9}, {0, 0}, {3, 1}, {1, 3}}}), Contour::self_intersecting);
}

TEST(Convex_parts, figure_eight_through_a_vertex) {
  expect_simple(polygon({{{0, 0}, {4, 0}, {4, 4}, {8, 4}, {8, 8}, {4, 8}, {4, 4}, {0, 4}}}), 2);  // lobes of one sense
  expect_contour(polygon({{{0, 0}, {4, 4}, {8, 8}, {8, 0}, {4, 4}, {0, 8}}}), Contour::self_intersecting);  // of both
}

TEST(Convex_parts, zero_area) {
  expect_contour(Polygon{}, Contour::zero_area);
  expect_contour(polygon({{}}), Contour::zero_area);
  expect_contour(polygon({{{1, 1}}}), Contour::zero_area);
  expect_contour(polygon({{{1, 1}, {1, 1}, {1, 1}, {1, 1}}}), Contour::zero_area);
  expect_contour(polygon({{{1, 1}, {2, 3}}}), Contour::zero_area);
  expect_contour(polygon({{{1, 1}, {2, 3}, {3, 5}}}), Contour::zero_area);
  expect_contour(polygon({{{0, 0}, {9, 9}, {3, 3}, {7, 7}, {1, 1}}}), Contour::zero_area);
  expect_contour(polygon({{{0, 0}, {4, 0}, {4, 4}, {4, 0}}}), Contour::zero_area);  // there and back
  expect_contour(polygon({{{0, 0}, {4, 0}, {4, 4}, {9, 9}, {4, 4}, {4, 0}}}), Contour::zero_area);
}

TEST(Convex_parts, an_index_out_of_range_throws) {
  Polygon p = polygon({{{0, 0}, {4, 0}, {4, 4}}});
  p.loops[0].push_back(3);
  EXPECT_THROW(parts_of(p), std::out_of_range);
  EXPECT_THROW(triangles_of(p), std::out_of_range);
}

TEST(Convex_parts, does_not_depend_on_size_or_place_of_the_coordinates) {
  const Polygon small =
      polygon({{{0, 0}, {8, 0}, {8, 8}, {4, 3}, {0, 8}, {1, 4}, {1, 3}}, {{2, 1}, {4, 1}, {4, 2}, {3, 2}}});
  const auto expected = parts_of(small).pieces;
  const auto expected_triangles = triangles_of(small).pieces;
  for (const unsigned bits : {1u, 20u, 45u, 60u, 300u, 2000u, 5000u}) {
    Polygon large = small;
    const Integer scale = (Integer(1) << bits) + 12345, x = (Integer(1) << (2 * bits)) + 7,
                  y = -(Integer(1) << bits) - 99;
    for (Planar_point& p : large.points) {
      p.x = p.x * scale + x;
      p.y = p.y * scale + y;
    }
    EXPECT_EQ(parts_of(large).pieces, expected) << bits;
    EXPECT_EQ(triangles_of(large).pieces, expected_triangles) << bits;
  }
}

TEST(Convex_parts, one_unit_beside_a_degeneracy) {
  for (const unsigned bits : {10u, 52u, 53u, 54u, 64u, 200u, 2000u}) {
    const Integer m = Integer(1) << bits, s = m + 1;
    // A quadrilateral whose fourth corner is one unit inside, on, or outside its diagonal.
    for (const int off : {-1, 0, 1}) {
      Polygon p;
      p.points = {{Integer(0), Integer(0)},
                  {Integer(2 * s), Integer(0)},
                  {Integer(2 * s), Integer(2 * m)},
                  {s, Integer(m + off)}};
      p.loops = {{0, 1, 2, 3}};
      const Convex_parts parts = parts_of(p);
      EXPECT_TRUE(is_partition(p, parts, true, true)) << bits << " " << off;
      ASSERT_EQ(parts.pieces.size(), off < 0 ? 2u : 1u);
      EXPECT_EQ(parts.pieces[0].size(), off > 0 ? 4u : 3u);
    }
    // A hole's corner one unit before, on, or beyond the edge.
    for (const int off : {-1, 0, 1}) {
      Polygon p;
      p.points = {{Integer(0), Integer(0)}, {Integer(2 * s), Integer(0)},         {Integer(2 * s), Integer(2 * m)},
                  {s, Integer(m + off)},    {Integer(s + s / 2), Integer(m / 4)}, {Integer(s + s / 2), Integer(m / 3)}};
      p.loops = {{0, 1, 2}, {3, 4, 5}};
      const Convex_parts parts = parts_of(p);
      EXPECT_EQ(parts.contour, off > 0 ? Contour::self_intersecting : Contour::simple) << bits;
      EXPECT_TRUE(off > 0 || is_partition(p, parts, true, true)) << bits << " " << off;
    }
  }
}

TEST(Convex_parts, coordinates_of_very_unequal_size) {
  // One point at 2^4000, the others within 2: bounds of the small ones must not collapse to zero.
  Polygon p;
  const Integer far = Integer(1) << 4000;
  p.points = {{Integer(0), Integer(0)},
              {far, Integer(-1)},
              {Integer(2), Integer(2)},
              {Integer(1), Integer(1)},
              {Integer(0), Integer(2)}};
  p.loops = {{0, 1, 2, 3, 4}};
  EXPECT_TRUE(is_partition(p, parts_of(p), true, true));
  EXPECT_TRUE(is_partition(p, triangles_of(p), true, true));
}

TEST(Convex_parts, ten_thousand_vertices_in_less_than_a_second_or_two) {
  std::mt19937_64 random(1);
  const std::size_t n = 10000;
  const auto ring = [&](double least, double spread, double turns, bool back) {
    std::vector<std::pair<long, long>> loop;
    for (std::size_t i = 0; i < n / (back ? 2 : 1); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(n / (back ? 2 : 1)),
                   angle = 6.283185307179586 * turns * t;
      const double r = 1e9 * (least + (back ? 10 * t : 0) + spread * static_cast<double>(random() % 1000) / 1000);
      loop.emplace_back(std::lround(r * std::cos(angle)), std::lround(r * std::sin(angle)));
    }
    if (back)
      for (std::size_t i = n / 2; i-- > 0;) {
        const double t = static_cast<double>(i) / static_cast<double>(n / 2), angle = 6.283185307179586 * turns * t;
        const double r = 1e9 * (least + 10 * t - 0.3);
        loop.emplace_back(std::lround(r * std::cos(angle)), std::lround(r * std::sin(angle)));
      }
    return polygon({loop});
  };
  // Hub: 2500 thin petals through one point.
  std::vector<std::pair<long, long>> petals;
  for (std::size_t i = 0; i < n / 4; ++i)
    for (const double part : {-1.0, 0.1, 0.9}) {
      const double angle = 6.283185307179586 * (static_cast<double>(i) + part) / (n / 4), r = part < 0 ? 0 : 1e9;
      petals.emplace_back(std::lround(r * std::cos(angle)), std::lround(r * std::sin(angle)));
    }
  // Slit: a square with a bridge of n / 2 straight points, walked twice.
  std::vector<std::pair<long, long>> slit{{0, 0}, {20000, 0}, {20000, 20000}, {0, 20000}, {0, 0}};
  for (long i = 1; i < 5000; ++i) slit.emplace_back(i, i);
  for (long i = 4999; i-- > 1;) slit.emplace_back(i, i);
  const std::vector<std::pair<const char*, Polygon>> cases{{"star-shaped", ring(1, 1, 1, false)},
                                                           {"spiral", ring(1, 0, 10, true)},
                                                           {"circle", ring(1, 0, 1, false)},
                                                           {"petals", shared(polygon({petals}))},
                                                           {"slit", polygon({slit})}};
  for (const auto& [name, p] : cases) {
    const auto start = std::chrono::steady_clock::now();
    const Convex_parts parts = parts_of(p);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_TRUE(is_partition(p, parts, true, false)) << name;
    EXPECT_LT(seconds, 60) << name;  // generous: sanitizers and shared machines
    std::printf("  %-12s %6zu corners %6zu pieces %.3f s\n", name, p.loops[0].size(), parts.pieces.size(), seconds);
  }
}

/// Where a contour returns to one corner, a triangulation has as many edges there: none is looked for among all others.
TEST(Convex_parts, contours_that_return_to_one_corner_often_take_no_square_of_it) {
  const auto seconds_of = [](std::size_t petals, bool has_own_points) {
    Polygon p;
    p.points.push_back({Integer(0), Integer(0)});
    Loop& loop = p.loops.emplace_back();
    for (std::size_t i = 0; i < petals; ++i) {
      loop.push_back(has_own_points ? static_cast<std::uint32_t>(p.points.size()) : 0);
      if (has_own_points) p.points.push_back(p.points[0]);
      for (const double part : {0.0, 0.5}) {
        const double angle = 6.283185307179586 * (static_cast<double>(i) + part) / static_cast<double>(petals),
                     r = 1e7 * (1 + static_cast<double>(7919 * i % 101) / 300);
        loop.push_back(static_cast<std::uint32_t>(p.points.size()));
        p.points.push_back({Integer(std::lround(r * std::cos(angle))), Integer(std::lround(r * std::sin(angle)))});
      }
    }
    const double start = sightline::processor_seconds();
    EXPECT_EQ(parts_of(p).pieces.size(), petals);
    return sightline::processor_seconds() - start;
  };
  // Eight times as many: the square of it would take 64 times as long.
  const std::size_t petals = test_scenes::is_sanitized() ? 500 : 2000;
  for (const bool has_own_points : {false, true})
    EXPECT_LT(seconds_of(8 * petals, has_own_points), 32 * seconds_of(petals, has_own_points) + 0.1);
}
