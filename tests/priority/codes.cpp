// The codes of pairs of faces against plain rationals: the Lemma, insides that meet, planes between, and what rays
// pierce first.

#include "../sample.h"
#include "support.h"

#include <sightline/algorithms/priority/pair_code.h>
#include <sightline/kernel/traits/point_traits.h>
#include <sightline/harness/generate/shapes.h>

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

using namespace priority_test;

namespace {

using test_scenes::least;
using test_scenes::sample;

using Codes = std::vector<std::vector<Pair_code>>;

template <class Traits>
Codes codes_of(const Priority_relation<Traits>& relation) {
  Relation_counters counters;
  Codes codes(relation.size());
  for (std::uint32_t i = 0; i < relation.size(); ++i)
    for (std::uint32_t j = 0; j < relation.size(); ++j) codes[i].push_back(pair_code(relation, i, j, counters));
  return codes;
}

bool parallel(const Flat& a, const Flat& b) {
  const Exact_point line = cross(a.normal, b.normal);
  return line[0] == 0 && line[1] == 0 && line[2] == 0;
}
bool coplanar(const Flat& a, const Flat& b) { return parallel(a, b) && a.height(b.corners[0]) == 0; }

/// Whether the relative interiors meet, the planes being across one another: a's open chord in b's plane, cut down by
/// the lines of b's edges, keeps a length.
bool insides_meet(const Flat& a, const Flat& b) {
  if (parallel(a, b)) return false;
  Points chord;
  for (std::size_t k = 0; k < a.corners.size(); ++k) {
    const Exact_point &p = a.corners[k], &q = a.corners[(k + 1) % a.corners.size()];
    const Rational from = b.height(p), to = b.height(q);
    if (from == 0) chord.push_back(p);
    if (sgn(from) * sgn(to) < 0) chord.push_back(along(p, from / (from - to), minus(q, p)));
  }
  if (chord.size() != 2) return false;
  const auto on_side = [&](int side) {
    return std::any_of(a.corners.begin(), a.corners.end(),
                       [&](const Exact_point& p) { return sgn(b.height(p)) == side; });
  };
  if (!on_side(1) || !on_side(-1)) return false;  // the chord is an edge
  Rational low = 0, high = 1;
  for (std::size_t k = 0; k < b.corners.size(); ++k) {
    const Exact_point& p = b.corners[k];
    const Exact_point inward = cross(b.normal, minus(b.corners[(k + 1) % b.corners.size()], p));
    const Rational from = dot(inward, minus(chord[0], p)), to = dot(inward, minus(chord[1], p));
    if (from <= 0 && to <= 0) return false;
    if (from < 0) low = std::max(low, Rational(from / (from - to)));
    if (to < 0) high = std::min(high, Rational(from / (from - to)));
  }
  return low < high;
}

/// Whether a plane has polygons on its closed sides as told, neither of them all on it.
bool is_between(const priority_detail::Normal_and_point& plane, const Flat& front, const Flat& back) {
  const auto extremes = [&](const Flat& flat) {
    std::pair<int, int> least_most{1, -1};
    for (const Exact_point& p : flat.corners) {
      const int side = sgn(Rational(dot(plane.normal, minus(p, plane.point))));
      least_most = {std::min(least_most.first, side), std::max(least_most.second, side)};
    }
    return least_most;
  };
  return extremes(front) == std::pair{0, 1} || extremes(front) == std::pair{1, 1}
             ? extremes(back) == std::pair{-1, 0} || extremes(back) == std::pair{-1, -1}
             : false;
}

/// The code that the definitions ask for.
Precedence expected_code(const Flats& flats, const Matrix& arcs, std::size_t i, std::size_t j) {
  if (!arcs[i][j]) return arcs[j][i] ? Precedence::second : Precedence::never;
  if (!arcs[j][i]) return Precedence::first;
  return insides_meet(flats[i], flats[j]) ? Precedence::crossing : Precedence::by_plane;
}

/// Where a ray goes through the insides of faces that its eye is strictly in front of, nearest first.
using Hits = std::vector<std::pair<Rational, std::uint32_t>>;
Hits pierced(const Flats& flats, const Exact_point& eye, const Exact_point& towards) {
  Hits hits;
  for (std::uint32_t i = 0; i < flats.size(); ++i) {
    if (flats[i].height(eye) <= 0) continue;
    const std::optional<Rational> t = flats[i].crossing(eye, towards);
    if (t && *t > 0 && flats[i].holds(along(eye, *t, minus(towards, eye))) == 1) hits.emplace_back(*t, i);
  }
  std::sort(hits.begin(), hits.end());
  return hits;
}

/// Eyes of each kind: in general place, in a face's plane, at a corner, and where the line through two faces comes
/// from.
Exact_point eye_towards(const Flats& flats, const Exact_point& target, std::uint64_t kind, Random& random) {
  const auto corner = [&] {
    const Points& corners = flats[random.below(flats.size())].corners;
    return corners[random.below(corners.size())];
  };
  const auto times = [&] { return ratio(random.between(-9, 9), 4); };
  switch (kind % 5) {
    case 0: return along(along(corner(), times(), minus(corner(), corner())), times(), minus(corner(), corner()));
    case 1: {
      const Points& c = flats[random.below(flats.size())].corners;
      return along(along(c[0], times(), minus(c[1], c[0])), times(), minus(c[2], c[0]));
    }
    case 2: return corner();
    default:
      return along(target, ratio(random.between(1, 40), 8),
                   minus(target, inside_of(flats[random.below(flats.size())].corners, random)));
  }
}

TEST(Pair_code, is_that_of_the_definitions_on_degenerate_scenes_and_its_planes_are_between) {
  std::map<Precedence, std::size_t> met;
  std::size_t touching_planes = 0;
  for (std::uint64_t k = 0; k < sample(2000u); ++k) {
    const Related scene(degenerate_soup(k));
    const Matrix arcs = arcs_of(scene.flats);
    const Codes codes = codes_of(scene.relation);
    for (std::uint32_t i = 0; i < codes.size(); ++i)
      for (std::uint32_t j = 0; j < codes.size(); ++j) {
        const Pair_code& code = codes[i][j];
        ASSERT_EQ(code.precedence, expected_code(scene.flats, arcs, i, j)) << "scene " << k << ": " << i << ", " << j;
        ASSERT_EQ(code.plane.has_value(), code.precedence == Precedence::by_plane)
            << "scene " << k << ": " << i << ", " << j;
        ++met[code.precedence];
        if (!code.plane) continue;
        ASSERT_TRUE(is_between(*code.plane, scene.flats[i], scene.flats[j])) << "scene " << k << ": " << i << ", " << j;
        ASSERT_EQ(code.first_is_nearer(code.plane->point), std::nullopt) << "from an eye in the plane";
        ASSERT_EQ(code.first_is_nearer(along(code.plane->point, 1, code.plane->normal)), true);
        ASSERT_EQ(code.first_is_nearer(along(code.plane->point, -1, code.plane->normal)), false);
        touching_planes += scene.flats[i].crossing(scene.flats[j].corners[0], scene.flats[j].corners[1]) == Rational(0);
      }
  }
  for (const Precedence p : {Precedence::never, Precedence::first, Precedence::second, Precedence::crossing})
    EXPECT_GT(met[p], least(5000u)) << static_cast<int>(p);
  EXPECT_GT(met[Precedence::by_plane], least(500u));
  EXPECT_EQ(met[Precedence::first], met[Precedence::second]);
  EXPECT_GT(touching_planes, least(10u));
}

TEST(Pair_code, tells_the_order_of_all_faces_that_a_ray_pierces_and_that_do_not_cross) {
  std::size_t two = 0, three = 0, four = 0, crossing = 0, in_one_plane = 0;
  std::map<Precedence, std::size_t> decided;
  Relation_counters counters;
  for (std::uint64_t k = 0; k < sample(2400u); ++k) {
    Random random(k);
    const Related scene(degenerate_soup(k));
    if (scene.flats.empty()) continue;
    for (std::uint64_t ray = 0; ray < 15; ++ray) {
      const Exact_point target = inside_of(scene.flats[random.below(scene.flats.size())].corners, random),
                        eye = eye_towards(scene.flats, target, ray, random);
      const Hits hits = pierced(scene.flats, eye, target);
      two += hits.size() >= 2;
      three += hits.size() >= 3;
      four += hits.size() >= 4;
      for (std::size_t a = 0; a < hits.size(); ++a)
        for (std::size_t b = 0; b < hits.size(); ++b) {
          const std::uint32_t i = hits[a].second, j = hits[b].second;
          if (i == j) continue;
          const Pair_code code = pair_code(scene.relation, i, j, counters);
          if (code.precedence == Precedence::crossing) {
            ++crossing;
          } else if (hits[a].first == hits[b].first) {  // insides at one distance: one plane, or they cross
            ASSERT_TRUE(coplanar(scene.flats[i], scene.flats[j]) && code.precedence == Precedence::never)
                << "scene " << k << ": " << i << ", " << j;
            ASSERT_EQ(code.first_is_nearer(eye), std::nullopt);
            ++in_one_plane;
          } else {
            ASSERT_NE(code.precedence, Precedence::never) << "scene " << k << ": " << i << ", " << j;
            ASSERT_EQ(code.first_is_nearer(eye), std::optional<bool>(hits[a].first < hits[b].first))
                << "scene " << k << ": " << i << ", " << j;
            ++decided[code.precedence];
          }
        }
    }
  }
  EXPECT_GT(two, least(4000u));
  EXPECT_GT(three, least(400u));
  EXPECT_GE(four, least(50u));
  EXPECT_GT(crossing, least(1000u));
  EXPECT_GT(in_one_plane, least(50u));
  EXPECT_GT(decided[Precedence::first], least(2000u));
  EXPECT_EQ(decided[Precedence::first], decided[Precedence::second]);
  EXPECT_GT(decided[Precedence::by_plane], least(200u));
}

// ---- The paper's components

/// Rays through inner points of two different faces, from beyond the first: what they pierce, if they pierce both.
template <class Function>
void look_through_pairs(const Flats& flats, int rays, Function tell) {
  Random random(9);
  for (int ray = 0; ray < rays; ++ray) {
    const std::size_t i = random.below(flats.size()), j = (i + 1 + random.below(flats.size() - 1)) % flats.size();
    const Exact_point a = inside_of(flats[i].corners, random), b = inside_of(flats[j].corners, random);
    const Exact_point eye = along(a, ratio(random.between(1, 200), 10), minus(a, b));
    if (flats[i].height(eye) > 0 && flats[j].height(eye) > 0) tell(eye, pierced(flats, eye, a));
  }
}

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

TEST(Figure_9, of_a_ring_of_four_only_neighbours_conflict_and_each_such_case_has_one_answer) {
  // The outer sides of a pinwheel: each runs on past the next one's line. Opposite ones are back to back.
  const Related scene(soup_of({wall(3, 2, 8, 2), wall(4, 3, 4, 8), wall(3, 4, -2, 4), wall(2, 3, 2, -2)}));
  EXPECT_TRUE(same_arcs(asked(scene.relation), Matrix{{0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}, {1, 0, 0, 0}}));
  const Codes codes = codes_of(scene.relation);
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(codes[i][i].precedence, Precedence::never);
    EXPECT_EQ(codes[i][(i + 1) % 4].precedence, Precedence::first) << i;
    EXPECT_EQ(codes[i][(i + 2) % 4].precedence, Precedence::never) << i;
    EXPECT_EQ(codes[i][(i + 3) % 4].precedence, Precedence::second) << i;
  }
  Pairs conflicts;
  look_through_pairs(scene.flats, 4000, [&](const Exact_point& eye, const Hits& hits) {
    ASSERT_EQ(hits.size(), 2u) << "never three of the four";
    EXPECT_EQ(codes[hits[0].second][hits[1].second].first_is_nearer(eye), true);
    conflicts.emplace(hits[0].second, hits[1].second);
  });
  EXPECT_EQ(conflicts, (Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 0}})) << "AB, BC, CD, DA, and all of them";
}

TEST(Figure_9, three_that_obscure_one_another_in_a_cycle_are_a_complete_subgraph_that_no_ray_pierces) {
  // The long outer sides of a triangle's blades: the end of each is in front of the next one's line.
  const Related scene(soup_of({wall(1, 0, 8, 0), wall(3, 1, -4, 8), wall(0, 3, 0, -8)}));
  const Codes codes = codes_of(scene.relation);
  Pairs conflicts;
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(codes[i][(i + 1) % 3].precedence, Precedence::first) << i;
  look_through_pairs(scene.flats, 6000, [&](const Exact_point& eye, const Hits& hits) {
    ASSERT_EQ(hits.size(), 2u) << "never all three";
    EXPECT_EQ(codes[hits[0].second][hits[1].second].first_is_nearer(eye), true);
    conflicts.emplace(hits[0].second, hits[1].second);
  });
  EXPECT_EQ(conflicts, (Pairs{{0, 1}, {1, 2}, {2, 0}}));
}

TEST(Figure_9, three_bars_over_each_other_are_pierced_by_one_ray_only_from_eyes_whose_codes_are_an_order) {
  const Related scene(generate::bars(3));
  const Codes codes = codes_of(scene.relation);
  const auto turns =
      [&](const Exact_point& eye) {  // of the three codes round the ring, those that say that the first is nearer
        return (codes[0][1].first_is_nearer(eye) == true) + (codes[1][2].first_is_nearer(eye) == true) +
               (codes[2][0].first_is_nearer(eye) == true);
      };
  for (std::uint32_t i = 0; i < 3; ++i)
    EXPECT_EQ(codes[i][(i + 1) % 3].precedence, Precedence::by_plane)
        << "sloping bars: from low enough the other one is nearer";
  EXPECT_EQ(turns(at(0, 0, 1000)), 3) << "from above, each is over the next";
  std::size_t in_cycles = 0, in_orders = 0, all_three = 0;
  look_through_pairs(scene.flats, 6000, [&](const Exact_point& eye, const Hits& hits) {
    for (std::size_t a = 0; a + 1 < hits.size(); ++a)
      EXPECT_EQ(codes[hits[a].second][hits[a + 1].second].first_is_nearer(eye), true);
    const bool cycle = turns(eye) == 3 || turns(eye) == 0;
    ++(cycle ? in_cycles : in_orders);
    all_three += hits.size() == 3;
    EXPECT_TRUE(hits.size() == 2 || !cycle);
  });
  EXPECT_GT(in_cycles, 100u);
  EXPECT_GT(in_orders, 500u);
  EXPECT_GT(all_three, 0u);
}

// ---- Laws

/// The other one first.
Precedence exchanged(Precedence p) {
  return p == Precedence::first ? Precedence::second : p == Precedence::second ? Precedence::first : p;
}

/// The image in a mirror: x and -z exchange places, loops go round the other way so that fronts stay fronts.
Polygon_soup mirrored(const Flats& flats) {
  std::vector<Points> faces;
  for (const Flat& flat : flats) {
    Points image;
    for (const Exact_point& p : flat.corners) image.push_back(at(-p[2], p[1], -p[0]));
    faces.push_back(reversed(image));
  }
  return soup_of(faces);
}

TEST(Pair_code, mirrors_with_the_scene_exchanges_with_the_arguments_and_reverses_with_the_fronts) {
  std::size_t ordered = 0, by_plane = 0;
  for (std::uint64_t k = 0; k < sample(500u); ++k) {
    Random random(k);
    const Related scene(moved(touching_soup(random), k % 3 == 2 ? Move::far : Move::none, k));
    const Related mirror(mirrored(scene.flats)), back(generate::faces_reversed(scene.soup)),
        rotated(generate::rotated(scene.soup, generate::rotation(2, 1, -1, 1)));
    const Codes codes = codes_of(scene.relation), in_mirror = codes_of(mirror.relation),
                from_behind = codes_of(back.relation), elsewhere = codes_of(rotated.relation);
    ASSERT_TRUE(in_mirror.size() == codes.size() && from_behind.size() == codes.size() &&
                elsewhere.size() == codes.size())
        << "scene " << k;
    for (std::uint32_t i = 0; i < codes.size(); ++i)
      for (std::uint32_t j = 0; j < codes.size(); ++j) {
        const Precedence code = codes[i][j].precedence;
        ASSERT_EQ(codes[j][i].precedence, exchanged(code)) << "scene " << k << ": " << i << ", " << j;
        ASSERT_EQ(in_mirror[i][j].precedence, code) << "scene " << k << ": " << i << ", " << j;
        ASSERT_EQ(elsewhere[i][j].precedence, code) << "scene " << k << ": " << i << ", " << j;
        ASSERT_EQ(from_behind[i][j].precedence, exchanged(code)) << "scene " << k << ": " << i << ", " << j;
        ordered += code == Precedence::first;
        by_plane += code == Precedence::by_plane;
        if (code != Precedence::by_plane) continue;
        for (const Pair_code* plane :
             {&from_behind[i][j],
              &codes[i][j]})  // the senses of planes do not follow the fronts, they follow the arguments
          ASSERT_TRUE(is_between(*plane->plane, scene.flats[i], scene.flats[j]))
              << "scene " << k << ": " << i << ", " << j;
        ASSERT_TRUE(is_between(*codes[j][i].plane, scene.flats[j], scene.flats[i]))
            << "scene " << k << ": " << i << ", " << j;
      }
  }
  EXPECT_GT(ordered, least(3000u));
  EXPECT_GT(by_plane, least(100u));
}

TEST(Pair_code, is_the_same_under_other_exact_kernels) {
  std::size_t pairs = 0, planes = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    const Related scene(degenerate_soup(k + 70000));
    const Point_traits<CGAL::Epeck> epeck(scene.scene);
    const Point_traits<CGAL::Cartesian<CGAL::Gmpq>> gmpq(scene.scene);
    const Codes expected = codes_of(scene.relation), lazy = codes_of(Priority_relation(epeck)),
                eager = codes_of(Priority_relation(gmpq));
    for (std::uint32_t i = 0; i < expected.size(); ++i)
      for (std::uint32_t j = 0; j < expected.size(); ++j) {
        ASSERT_EQ(lazy[i][j].precedence, expected[i][j].precedence) << "scene " << k << ": " << i << ", " << j;
        ASSERT_EQ(eager[i][j].precedence, expected[i][j].precedence) << "scene " << k << ": " << i << ", " << j;
        ++pairs;
        if (expected[i][j].precedence != Precedence::by_plane) continue;
        ++planes;
        ASSERT_TRUE(is_between(*lazy[i][j].plane, scene.flats[i], scene.flats[j]))
            << "scene " << k << ": " << i << ", " << j;
        ASSERT_TRUE(is_between(*eager[i][j].plane, scene.flats[i], scene.flats[j]))
            << "scene " << k << ": " << i << ", " << j;
      }
  }
  EXPECT_GT(pairs, 4000u);
  EXPECT_GT(planes, 30u);
}

}  // namespace
