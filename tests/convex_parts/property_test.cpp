// Laws on random polygons: star-shaped, orthogonal, and arbitrary index loops on a small lattice.

#include "../sample.h"
#include "oracle.h"

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <random>

using namespace oracle;

namespace {

/// Whole ranges from the first case on, not growing ones.
template <class T>
rc::Gen<T> full(rc::Gen<T> gen) {
  return rc::gen::resize(rc::kNominalSize, std::move(gen));
}

int half(const Planar_point& p) { return p.y > 0 || (p.y == 0 && p.x > 0) ? 0 : 1; }

/// Points sorted round the origin, one for each direction: a polygon star-shaped from the origin, or nothing.
Polygon star_shaped(std::vector<std::pair<long, long>> given) {
  Polygon p;
  for (const auto& [x, y] : given)
    if (x != 0 || y != 0) p.points.push_back({Integer(x), Integer(y)});
  const Planar_point origin{Integer(0), Integer(0)};
  const auto before = [&](const Planar_point& a, const Planar_point& b) {
    if (half(a) != half(b)) return half(a) < half(b);
    return cross(origin, a, b) > 0;
  };
  std::stable_sort(p.points.begin(), p.points.end(), before);
  p.points.erase(std::unique(p.points.begin(), p.points.end(),
                             [&](const auto& a, const auto& b) { return !before(a, b) && !before(b, a); }),
                 p.points.end());
  p.loops.emplace_back();
  for (std::uint32_t i = 0; i < p.points.size(); ++i) p.loops[0].push_back(i);
  for (std::size_t i = 0; i < p.points.size(); ++i)  // the origin strictly inside
    if (cross(origin, p.points[i], p.points[(i + 1) % p.points.size()]) <= 0) return {};
  return p;
}

void check_partition(const Polygon& p) {
  const Convex_parts pieces = parts_of(p), fine = triangles_of(p);
  const auto coarse_ok = is_partition(p, pieces, true, true), fine_ok = is_partition(p, fine, true, true);
  if (!coarse_ok) RC_FAIL(coarse_ok.message());
  if (!fine_ok) RC_FAIL(fine_ok.message());
  RC_ASSERT(pieces.pieces.size() <= fine.pieces.size());
  // No two pieces that share a whole side could be merged (a chain of sides in line is not looked at here).
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> side;
  for (std::size_t k = 0; k < pieces.pieces.size(); ++k)
    for (std::size_t i = 0, n = pieces.pieces[k].size(); i < n; ++i)
      side[{pieces.pieces[k][i], pieces.pieces[k][(i + 1) % n]}] = k;
  for (const auto& [ends, k] : side) {
    const auto other = side.find({ends.second, ends.first});
    if (other == side.end()) continue;
    const auto neighbour = [&](std::size_t piece, std::uint32_t corner, std::size_t step) {
      const Loop& loop = pieces.pieces[piece];
      const std::size_t at = static_cast<std::size_t>(std::find(loop.begin(), loop.end(), corner) - loop.begin());
      return loop[(at + loop.size() + step) % loop.size()];
    };
    const auto& q = p.points;
    const bool left_at_first = cross(q[neighbour(k, ends.first, static_cast<std::size_t>(-1))], q[ends.first],
                                     q[neighbour(other->second, ends.first, 1)]) >= 0;
    const bool left_at_second = cross(q[neighbour(other->second, ends.second, static_cast<std::size_t>(-1))],
                                      q[ends.second], q[neighbour(k, ends.second, 1)]) >= 0;
    RC_ASSERT(!(left_at_first && left_at_second));
  }
}

}  // namespace

RC_GTEST_PROP(Convex_parts_property, star_shaped_polygons, ()) {
  const long size = *rc::gen::element(3L, 10L, 1000L, 1L << 31);
  const auto corner = full(rc::gen::pair(rc::gen::inRange(-size, size + 1), rc::gen::inRange(-size, size + 1)));
  const Polygon p = star_shaped(*rc::gen::container<std::vector<std::pair<long, long>>>(
      static_cast<std::size_t>(*full(rc::gen::inRange(12, 60))), corner));
  RC_PRE(!p.points.empty());
  check_partition(p);
}

// A union of lattice cells grown from one cell without holes or pinches, walked round: many straight and cocircular
// points.
RC_GTEST_PROP(Convex_parts_property, orthogonal_polygons, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  constexpr int n = 12;
  bool cell[n + 2][n + 2] = {};
  cell[n / 2][n / 2] = true;
  const int rounds = static_cast<int>(random() % 300);
  for (int k = 0; k < rounds; ++k) {
    const int i = 1 + static_cast<int>(random() % n), j = 1 + static_cast<int>(random() % n);
    if (cell[i][j]) continue;
    // Add the cell where its eight neighbours change between full and empty exactly twice and one side is full.
    const bool ring[8] = {cell[i + 1][j], cell[i + 1][j + 1], cell[i][j + 1], cell[i - 1][j + 1],
                          cell[i - 1][j], cell[i - 1][j - 1], cell[i][j - 1], cell[i + 1][j - 1]};
    int changes = 0;
    for (int d = 0; d < 8; ++d) changes += ring[d] != ring[(d + 1) % 8];
    if (changes == 2 && (ring[0] || ring[2] || ring[4] || ring[6])) cell[i][j] = true;
  }
  // Directed cell sides with the inside on the left; without pinches each corner has one successor.
  std::map<std::pair<int, int>, std::pair<int, int>> next;
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= n; ++j)
      if (cell[i][j]) {
        if (!cell[i][j - 1]) next[{i, j}] = {i + 1, j};
        if (!cell[i + 1][j]) next[{i + 1, j}] = {i + 1, j + 1};
        if (!cell[i][j + 1]) next[{i + 1, j + 1}] = {i, j + 1};
        if (!cell[i - 1][j]) next[{i, j + 1}] = {i, j};
      }
  Polygon p;
  p.loops.emplace_back();
  auto at = next.begin()->first;
  do {
    p.loops[0].push_back(static_cast<std::uint32_t>(p.points.size()));
    p.points.push_back({Integer(at.first), Integer(at.second)});
    at = next.at(at);
  } while (at != next.begin()->first);
  RC_ASSERT(p.points.size() == next.size());
  check_partition(p);
}

namespace {

/// Points of a small lattice, each twice, and no loops yet.
Polygon lattice(int side) {
  Polygon p;
  for (int copy = 0; copy < 2; ++copy)
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) p.points.push_back({Integer(i), Integer(j)});
  return p;
}

/// Any kind of contour is as the definition says, and simple ones are partitioned.
Contour check_against_the_definition(Polygon& p) {
  if (twice_area(p.points, p.loops[0]) < 0) std::reverse(p.loops[0].begin(), p.loops[0].end());
  const Contour expected = contour(p);
  const Convex_parts pieces = parts_of(p), fine = triangles_of(p);
  RC_ASSERT(pieces.contour == expected);
  RC_ASSERT(fine.contour == expected);
  if (expected == Contour::simple) check_partition(p);
  else RC_ASSERT(pieces.pieces.empty() && fine.pieces.empty());
  return expected;
}

}  // namespace

RC_GTEST_PROP(Convex_parts_property, arbitrary_loops_on_a_small_lattice, ()) {
  Polygon p = lattice(*full(rc::gen::inRange(2, 5)));
  const auto index = full(rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(p.points.size())));
  const int loops = *full(rc::gen::inRange(1, 4));
  for (int k = 0; k < loops; ++k)
    p.loops.push_back(
        *rc::gen::container<Loop>(static_cast<std::size_t>(*full(rc::gen::inRange(0, k == 0 ? 10 : 5))), index));
  RC_TAG(static_cast<int>(check_against_the_definition(p)));
}

// Walks to neighbouring lattice points cross seldom: many of them are weakly simple, with spikes and keyholes.
TEST(Convex_parts_property, walks_on_a_small_lattice) {
  std::mt19937_64 random(7);
  int kinds[3] = {};
  const int walks = test_scenes::is_sanitized() ? 1500 : 6000;
  for (int k = 0; k < walks; ++k) {
    const int side = 3 + static_cast<int>(random() % 2), steps = 3 + static_cast<int>(random() % 12);
    Polygon p = lattice(side);
    p.loops.emplace_back();
    int x = static_cast<int>(random() % 3), y = static_cast<int>(random() % 3), dx = 1, dy = 0;
    for (int step = 0; step < steps; ++step) {
      p.loops[0].push_back(static_cast<std::uint32_t>(static_cast<int>(random() % 2) * side * side + x * side + y));
      if (random() % 3 != 0) {  // turn left by 45 or 90 degrees, or anywhere
        const int turns = random() % 4 == 0 ? static_cast<int>(random() % 8) : 1 + static_cast<int>(random() % 2);
        for (int t = 0; t < turns; ++t) {
          const int ex = dx - dy, ey = dx + dy;
          dx = (ex > 0) - (ex < 0);
          dy = (ey > 0) - (ey < 0);
        }
      }
      if (x + dx >= 0 && x + dx < side && y + dy >= 0 && y + dy < side) {
        x += dx;
        y += dy;
      }
    }
    if (random() % 3 == 0)
      p.loops.push_back({static_cast<std::uint32_t>(random() % 9), static_cast<std::uint32_t>(random() % 9),
                         static_cast<std::uint32_t>(random() % 9)});
    std::string shown;
    for (const Loop& loop : p.loops) {
      for (const std::uint32_t q : loop) shown += " " + std::to_string(q);
      shown += ";";
    }
    try {
      ++kinds[static_cast<int>(check_against_the_definition(p))];
    } catch (const rc::detail::CaseResult& failure) {
      FAIL() << "side " << side << " loops" << shown << "\n" << failure;
    }
  }
  for (const int kind : kinds) EXPECT_GT(kind, walks / 12);
  std::printf("  simple %d, zero area %d, self-intersecting %d\n", kinds[0], kinds[1], kinds[2]);
}

// Law L4: the start of a loop, the sense and the order of holes do not matter.
RC_GTEST_PROP(Convex_parts_property, the_start_of_a_loop_does_not_matter, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  Polygon p;
  for (int i = 0; i < 16; ++i) p.points.push_back({Integer(i % 4), Integer(i / 4)});
  p.loops = {{0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4}, {5, 6, 10}, {}};
  for (std::uint64_t k = random() % 4; k > 0; --k) p.loops[2].push_back(static_cast<std::uint32_t>(random() % 16));
  Polygon q = p;
  for (Loop& loop : q.loops)
    if (!loop.empty())
      std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random() % loop.size()), loop.end());
  for (std::size_t k = 1; k < 3; ++k)
    if (random() % 2) std::reverse(q.loops[k].begin(), q.loops[k].end());
  if (random() % 2) std::swap(q.loops[1], q.loops[2]);
  const Convex_parts a = parts_of(p), b = parts_of(q);
  RC_ASSERT(a.contour == b.contour);
  if (a.contour == Contour::simple) {
    check_partition(p);
    check_partition(q);
    RC_ASSERT(twice_area(p) == twice_area(q));
  }
  RC_ASSERT(parts_of(p).pieces == a.pieces);  // the same input, the same output
}
