// The oracles of weak visibility: by answers worked out by hand, and against each other.
// SIGHTLINE_LONG: so many times the scenes, for a long run.

#include "../sample.h"
#include "parallel_planes.h"
#include "z3.h"

#include <gtest/gtest.h>

#include <sstream>

namespace weak_oracle {
namespace {

using weak_scenes::Projective_map;
using weak_scenes::rectangle;
using weak_scenes::reversed;

/// Of z3 for one sentence: what it can say it nearly always says sooner.
constexpr unsigned effort = 300000;

Rational tiny() { return weak_scenes::tiny_gap(); }
Flats flats_of_scene(const Weak_scene& scene) { return oracle::flats_of(sightline::Scene(scene.soup)); }

/// What came of asking.
struct Tally {
  std::size_t visible = 0, hidden = 0, unknown = 0, rays = 0;
  std::size_t asked() const { return visible + hidden + unknown; }
};

/// z3, where it is there, and rays must not contradict the truth, nor each other.
void ask(const Weak_scene& scene, Face_id target, std::size_t tries, Tally& tally) {
  std::optional<bool> z3;
  if (has_z3()) z3 = z3_says(scene, target, effort);
  const bool ray = find_sightline(scene, target, tries, 5).has_value();
  tally.visible += z3 == true;
  tally.hidden += z3 == false;
  tally.unknown += !z3;
  tally.rays += ray;
  EXPECT_TRUE(!z3 || !scene.truth || z3 == scene.truth)
      << scene.name << ", face " << target << ": z3 says " << z3.value_or(false);
  EXPECT_TRUE(!ray || scene.truth.value_or(true)) << scene.name << ", face " << target << ": a sightline";
  EXPECT_TRUE(!ray || z3.value_or(true)) << scene.name << ", face " << target << ": a sightline, but not for z3";
}

// ---- Linear programs

TEST(Weak_oracle_simplex, finds_optima_known_by_hand) {
  // 3 x + 5 y, x <= 4, 2 y <= 12, 3 x + 2 y <= 18: 36 at (2, 6).
  const Optimum textbook = maximise({{1, 0}, {0, 2}, {3, 2}}, {4, 12, 18}, {3, 5});
  EXPECT_EQ(textbook.value, 36);
  EXPECT_EQ(textbook.x, (std::vector<Rational>{2, 6}));
  EXPECT_EQ(maximise({{1, 1}}, {ratio(1, 3)}, {-1, -2}).value, 0);
  // Beale's: it cycles under the rule of the largest coefficient.
  const Optimum beale = maximise({{ratio(1, 4), -8, -1, 9}, {ratio(1, 2), -12, ratio(-1, 2), 3}, {0, 0, 1, 0}},
                                 {0, 0, 1}, {ratio(3, 4), -20, ratio(1, 2), -6});
  EXPECT_EQ(beale.value, ratio(5, 4));
  EXPECT_EQ(beale.x, (std::vector<Rational>{1, 0, 1, 0}));
  EXPECT_THROW(maximise({{-1, 1}}, {1}, {1, 0}), std::domain_error);
}

TEST(Weak_oracle_simplex, agrees_with_trying_all_vertices) {
  Random random(3);
  for (std::size_t round = 0; round < 200; ++round) {
    // In the plane, within [0, 4]^2.
    std::vector<std::vector<Rational>> rows{{1, 0}, {0, 1}};
    std::vector<Rational> bounds{4, 4};
    for (std::size_t k = random.below(5); k > 0; --k) {
      const Rational x = weak_scenes::integer(random, -3, 3), y = weak_scenes::integer(random, -3, 3);
      rows.push_back({x, y});
      bounds.push_back(weak_scenes::integer(random, 0, 6));
    }
    const std::vector<Rational> objective{weak_scenes::integer(random, -3, 3), weak_scenes::integer(random, -3, 3)};
    std::vector<std::vector<Rational>> lines = rows;
    std::vector<Rational> at_most = bounds;
    lines.push_back({-1, 0});
    lines.push_back({0, -1});
    at_most.push_back(0);
    at_most.push_back(0);
    Rational best = 0;  // at the origin, which satisfies all
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Rational d = Rational(lines[i][0] * lines[j][1] - lines[i][1] * lines[j][0]);
        if (sgn(d) == 0) continue;
        const Rational x = Rational((at_most[i] * lines[j][1] - lines[i][1] * at_most[j]) / d),
                       y = Rational((lines[i][0] * at_most[j] - at_most[i] * lines[j][0]) / d);
        bool inside = true;
        for (std::size_t k = 0; k < lines.size(); ++k)
          inside = inside && lines[k][0] * x + lines[k][1] * y <= at_most[k];
        if (inside) best = std::max(best, Rational(objective[0] * x + objective[1] * y));
      }
    const Optimum optimum = maximise(rows, bounds, objective);
    EXPECT_EQ(optimum.value, best);
    EXPECT_EQ(Rational(objective[0] * optimum.x[0] + objective[1] * optimum.x[1]), best);
  }
}

TEST(Weak_oracle_cells, have_an_inner_point_iff_they_are_not_flat) {
  const auto slab = [](const Rational& from, const Rational& to) {  // of the box [-1, 1]^4: from < a_x + b_y < to
    Cell cell;
    for (std::size_t i = 0; i < 4; ++i)
      for (const long sign : {-1, 1}) {
        Wall wall{{0, 0, 0, 0}, -1};
        wall.normal[i] = sign;
        cell.push_back(wall);
      }
    cell.push_back({{1, 0, 0, 1}, from});
    cell.push_back({{-1, 0, 0, -1}, Rational(-to)});
    return cell;
  };
  for (const Cell& cell :
       {slab(-5, 5), slab(ratio(-7, 3), -1), slab(1, Rational(1 + tiny())), slab(Rational(2 - tiny()), 3)}) {
    const std::optional<Line_point> point = inner_point(cell);
    ASSERT_TRUE(point);
    for (const Wall& wall : cell) EXPECT_GT(wall.height(*point), 0);
  }
  for (const Cell& cell : {slab(1, 1), slab(2, 3), slab(-3, -2), slab(1, ratio(1, 2)), slab(5, 6)})
    EXPECT_FALSE(inner_point(cell));
  const Cell cell = slab(-1, ratio(3, 2));
  const Line_point inside = *inner_point(cell);
  EXPECT_EQ(supremum(cell, inside, {1, 0, 0, 1}), ratio(3, 2));
  EXPECT_EQ(supremum(cell, inside, {-1, 0, 0, -1}), 1);
  EXPECT_EQ(supremum(cell, inside, {1, 2, 0, 0}), 3);
  EXPECT_EQ(supremum(cell, inside, {2, 0, 0, 1}), ratio(5, 2));  // at a_x = 1, b_y = 1/2
}

// ---- By hand

/// What is known of source [-1, 1]^2 at height 0 and the same target at height 1.
struct Known {
  const char* what;
  Faces occluders;
  bool visible;
};
std::vector<Known> known_scenes() {
  const Rational half = ratio(1, 2), third = ratio(1, 3), eps = tiny();
  const auto full = [&](const Rational& z) { return rectangle(-1, 1, -1, 1, z); };
  const auto left = [&](const Rational& to, const Rational& z) { return rectangle(-2, to, -2, 2, z); };
  const auto right = [&](const Rational& from, const Rational& z) { return rectangle(from, 2, -2, 2, z); };
  const auto far = [&](const Rational& from, const Rational& z) { return rectangle(-2, 2, from, 2, z); };
  return {{"nothing between", {}, true},
          {"just all of the shaft", {full(half)}, false},
          {"all but a strip", {rectangle(-1, Rational(1 - eps), -1, 1, third)}, true},
          {"a plate beside the shaft", {right(1, half)}, true},
          {"two halves that share an edge", {left(0, half), right(0, half)}, false},
          {"two halves apart", {left(0, half), right(eps, half)}, true},
          {"two halves at other heights", {left(0, half), right(0, third)}, true},
          // Lines to x = -1 that pass x = 0 at 1/4 are at x = -1/3 at 1/2.
          {"slats that a line passes", {left(0, ratio(1, 4)), right(ratio(-1, 4), half)}, true},
          {"slats up to the line to the target's edge", {left(0, ratio(1, 4)), right(Rational(-third), half)}, false},
          {"slats one part in 2^40 from it", {left(0, ratio(1, 4)), right(Rational(-third + eps), half)}, true},
          {"two slits across each other",
           {left(0, third), right(eps, third), far(eps, ratio(2, 3)), rectangle(-2, 2, -2, 0, ratio(2, 3))},
           true},
          {"a corner only is open",
           {rectangle(-2, ratio(9, 10), -2, 2, half), rectangle(ratio(1, 2), 2, -2, ratio(9, 10), half)},
           true},
          {"and that closed",
           {rectangle(-2, ratio(9, 10), -2, 2, half), rectangle(ratio(1, 2), 2, -2, ratio(9, 10), half),
            rectangle(ratio(9, 10), 1, ratio(9, 10), 1, half)},
           false}};
}

TEST(Weak_oracle_parallel_planes, decides_what_is_known_by_hand) {
  for (const Known& known : known_scenes()) {
    const Parallel_scene scene{rectangle(-1, 1, -1, 1, 0), rectangle(-1, 1, -1, 1, 1), known.occluders};
    const std::optional<Sightline> line = decide(scene);
    EXPECT_EQ(line.has_value(), known.visible) << known.what;
    EXPECT_TRUE(!line || proves_visible(flats_of_scene(in_space(scene, known.what, true)), scene.source, 0, *line))
        << known.what;
  }
}

TEST(Weak_oracle_z3, decides_what_is_known_by_hand) {
  if (!has_z3()) GTEST_SKIP() << "needs z3 (Debian: z3)";
  for (const Known& known : known_scenes()) {
    const Weak_scene scene =
        in_space({rectangle(-1, 1, -1, 1, 0), rectangle(-1, 1, -1, 1, 1), known.occluders}, known.what, known.visible);
    EXPECT_TRUE(Sentence(flats_of_scene(scene), scene.source, flats_of_scene(scene)[0]).linear());
    EXPECT_EQ(z3_says(scene, 0, effort), known.visible) << known.what;
  }
}

/// A floor [0, 2] x [-1, 1] and a wall above its edge x = 0, with more faces.
Weak_scene corner_of_a_room(const Faces& faces) {
  Faces all{{at(0, -1, 0), at(0, 1, 0), at(0, 1, 2), at(0, -1, 2)}};
  all.insert(all.end(), faces.begin(), faces.end());
  return {"corner of a room", weak_scenes::soup_of(all), rectangle(0, 2, -1, 1, 0), {0}, std::nullopt};
}

enum class Truth { hidden, hardly_visible, visible };

TEST(Weak_oracle_law, is_open_one_sided_and_knows_coplanar_faces) {
  struct Case {
    const char* what;
    Weak_scene scene;
    Truth truth;
  };
  const Points diagonal{at(0, -1, 0), at(1, -1, 1), at(1, 1, 1), at(0, 1, 0)},
      wall_lid{at(0, -3, 0), at(0, 3, 0), at(0, 3, 3), at(0, -3, 3)};
  const auto turned = [](Weak_scene scene) {
    scene.source = reversed(scene.source);
    return scene;
  };
  const auto to_the_back = [](Weak_scene scene) {
    scene.soup = sightline::generate::faces_reversed(scene.soup);
    return scene;
  };
  const auto fence = [](const Rational& x) { return Points{at(x, -2, -1), at(x, 2, -1), at(x, 2, 3), at(x, -2, 3)}; };
  const auto l_shaped_wall = [](Faces faces) {
    Weak_scene scene = corner_of_a_room({});
    faces.insert(faces.begin(), {at(0, -1, 0), at(0, 1, 0), at(0, 1, 2), at(0, 0, 2), at(0, 0, 1), at(0, -1, 1)});
    scene.soup = weak_scenes::soup_of(faces);
    return scene;
  };
  const auto low_end = [](Weak_scene scene) {
    scene.source = rectangle(0, 2, -1, 0, 0);
    return scene;
  };
  const std::vector<Case> cases{
      {"floor and wall", corner_of_a_room({}), Truth::visible},
      {"the floor looks down", turned(corner_of_a_room({})), Truth::hidden},
      {"the wall looks away", to_the_back(corner_of_a_room({})), Truth::hidden},
      {"a plate between, that shares their edge", corner_of_a_room({diagonal}), Truth::hidden},
      {"the same turned", corner_of_a_room({reversed(diagonal)}), Truth::hidden},
      {"the same, a strip missing",
       corner_of_a_room({{at(0, -1, 0), at(1, -1, 1), at(1, Rational(1 - tiny()), 1), at(0, Rational(1 - tiny()), 0)}}),
       Truth::hardly_visible},
      {"a lid in the wall's plane", corner_of_a_room({wall_lid}), Truth::visible},
      {"a lid in the floor's plane", corner_of_a_room({rectangle(-3, 3, -3, 3, 0)}), Truth::visible},
      {"a lid just above the floor, under which it sees the foot of the wall",
       corner_of_a_room({rectangle(-3, 3, -3, 3, tiny())}), Truth::hardly_visible},
      {"a fence across the floor", corner_of_a_room({fence(1)}), Truth::visible},
      {"a fence at its far edge", corner_of_a_room({fence(2)}), Truth::visible},
      {"a fence just before the wall", corner_of_a_room({fence(tiny())}), Truth::hardly_visible},
      {"an L-shaped wall, partly behind lids",
       l_shaped_wall({rectangle(-3, 3, -3, 3, 1), rectangle(-3, 3, -3, ratio(1, 2), ratio(1, 2))}), Truth::visible},
      // Whichever its two pieces are, in one of these cases only the first one is in sight, in another only the second.
      {"the top of an L-shaped wall above a screen",
       l_shaped_wall({{at(0, -3, 0), at(0, 3, 0), at(ratio(1, 4), 3, 1), at(ratio(1, 4), -3, 1)}}), Truth::visible},
      {"the low end of an L-shaped wall beside a partition",
       low_end(l_shaped_wall({{at(0, 0, 0), at(2, 0, 0), at(2, 0, 2), at(0, 0, 2)}})), Truth::visible},
      {"an L-shaped wall behind the plate", l_shaped_wall({fence(0), rectangle(0, 2, -1, 1, 3), diagonal}),
       Truth::hidden}};
  for (const Case& c : cases) {
    const bool ray = find_sightline(c.scene, 0, 200, 1).has_value();
    EXPECT_TRUE(c.truth == Truth::hardly_visible || ray == (c.truth == Truth::visible)) << c.what;
    EXPECT_TRUE(!has_z3() || z3_says(c.scene, 0, effort) == (c.truth != Truth::hidden)) << c.what;
  }
}

TEST(Weak_oracle_rays, prove_nothing_at_the_boundary) {
  const Points square = rectangle(-1, 1, -1, 1, 0);
  const Faces faces{reversed(rectangle(-1, 1, -1, 1, 2)),
                    rectangle(0, 5, -5, 5, 1),
                    {at(-5, ratio(1, 2), -1), at(5, ratio(1, 2), -1), at(5, ratio(1, 2), 3), at(-5, ratio(1, 2), 3)}};
  const Flats flats = oracle::flats_of(sightline::Scene(weak_scenes::soup_of(faces)));
  const auto proof = [&](const Exact_point& p, const Exact_point& q) {
    return proves_visible(flats, square, 0, {p, q});
  };
  const Rational left = ratio(-1, 3);
  EXPECT_TRUE(proof(at(left, 0, 0), at(left, 0, 2)));
  EXPECT_TRUE(proof(at(ratio(1, 4), 0, 0), at(ratio(-1, 2), 0, 2)));
  EXPECT_FALSE(proof(at(left, 0, 1), at(left, 0, 2))) << "p is above the source";
  EXPECT_FALSE(proof(at(-1, 0, 0), at(left, 0, 2))) << "p is on its edge";
  EXPECT_FALSE(proof(at(-2, 0, 0), at(left, 0, 2))) << "p is beside it";
  EXPECT_FALSE(proof(at(left, 0, 0), at(left, 1, 2))) << "q is on the target's edge";
  EXPECT_FALSE(proof(at(left, 0, 0), at(left, 0, ratio(3, 2)))) << "q is below the target";
  EXPECT_FALSE(proof(at(ratio(1, 3), 0, 0), at(ratio(1, 3), 0, 2))) << "through the plate";
  EXPECT_FALSE(proof(at(left, 0, 0), at(ratio(1, 3), 0, 2))) << "along its edge";
  EXPECT_FALSE(proof(at(left, 0, 0), at(left, ratio(1, 2), 2))) << "q is on a face that crosses the target";
  EXPECT_FALSE(proof(at(left, ratio(1, 2), 0), at(left, 0, 2))) << "p is on one that crosses the source";
  EXPECT_TRUE(proof(at(left, ratio(3, 4), 0), at(left, ratio(2, 3), 2)));
  EXPECT_FALSE(proves_visible(flats, reversed(square), 0, {at(left, 0, 0), at(left, 0, 2)})) << "the source looks down";
  EXPECT_FALSE(proves_visible(flats, square, 1, {at(left, 0, 0), at(left, 0, 2)})) << "another face";
  EXPECT_FALSE(proves_visible(flats, square, 1, {at(0, 0, 0), at(1, 0, 1)})) << "that looks up";
}

TEST(Weak_oracle_z3, says_of_single_pairs_what_exact_segments_say) {
  if (!has_z3()) GTEST_SKIP() << "needs z3 (Debian: z3)";
  Random random(11);
  std::size_t free = 0, blocked = 0, degenerate = 0;
  const auto coordinate = [&] { return ratio(random.between(-1, 8), 16); };
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(40); ++seed) {
    const Weak_scene scene = weak_scenes::families()[16 + seed % 2].make(seed);
    const Flats flats = flats_of_scene(scene);
    const Face_id target = scene.targets[random.below(scene.targets.size())];
    const Flat piece = *std::find_if(flats.begin(), flats.end(), [&](const Flat& flat) { return flat.face == target; });
    const Sentence sentence(flats, scene.source, piece);
    std::string text = sentence.text();
    std::vector<Sightline> pairs;
    for (std::size_t k = 0; k < 20; ++k) {
      const auto point = [&](const Points& of, const char* first, const char* second) {
        const Rational x = coordinate(), y = coordinate();
        text += std::string("(assert (= (* 16 ") + first + ") " + Rational(x * 16).get_str() + "))(assert (= (* 16 " +
                second + ") " + Rational(y * 16).get_str() + "))";
        return along(along(of[0], x, minus(of[1], of[0])), y, minus(of[2], of[0]));
      };
      text += "(push)";
      const Exact_point p = point(scene.source, "u", "v"), q = point(piece.corners, "s", "t");
      text += sentence.question() + "(pop)\n";
      pairs.push_back({p, q});
    }
    std::istringstream answers(z3_output(text, effort));
    for (const Sightline& pair : pairs) {
      std::string answer;
      answers >> answer;
      const bool proof = proves_visible(flats, scene.source, target, pair);
      ASSERT_TRUE(answer == "sat" || answer == "unsat") << answer;
      const bool in_a_plane = std::any_of(flats.begin(), flats.end(), [&](const Flat& flat) {
        return sgn(flat.height(pair.p)) == 0 || (sgn(flat.height(pair.q)) == 0 && flat.face != target);
      });
      EXPECT_TRUE(proof || answer == "unsat") << scene.name;
      EXPECT_TRUE(!proof || in_a_plane || answer == "sat") << scene.name;
      ++(proof ? free : blocked);
      degenerate += in_a_plane;
    }
  }
  EXPECT_GT(free, weak_scenes::seeds(50));
  EXPECT_GT(blocked, weak_scenes::seeds(50));
  EXPECT_GT(blocked + free, 2 * degenerate);
}

// ---- Against each other

TEST(Weak_oracle_parallel_planes, decides_pairs_that_touch_and_are_2_to_the_minus_40_apart) {
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(test_scenes::sample(60u)); ++seed) {
    const Closed_and_reopened pair = closed_and_reopened(seed);
    EXPECT_FALSE(decide(pair.closed)) << seed;
    const std::optional<Sightline> line = decide(pair.reopened);
    ASSERT_TRUE(line) << seed;
    EXPECT_TRUE(proves_visible(flats_of_scene(in_space(pair.reopened, "", true)), pair.reopened.source, 0, *line))
        << seed;
  }
}

TEST(Weak_oracle_parallel_planes, splits_what_is_free_into_disjoint_cells_of_free_lines) {
  Random random(2);
  std::size_t cells = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Parallel_scene scene = random_parallel(random, 3);
    const std::vector<Free_cell> free = free_cells(scene, 1000);
    const Flats flats = flats_of_scene(in_space(scene, "", std::nullopt));
    EXPECT_EQ(!free.empty(), decide(scene).has_value());
    cells += free.size();
    for (const Free_cell& cell : free) {
      for (const Wall& wall : cell.cell) EXPECT_GT(wall.height(cell.inside), 0);
      EXPECT_TRUE(proves_visible(flats, scene.source, 0,
                                 {at(cell.inside[0], cell.inside[1], 0), at(cell.inside[2], cell.inside[3], 1)}));
    }
    // Every random line is free iff it is in one of them; on the boundary of some it is not asked.
    for (std::size_t k = 0; k < 50; ++k) {
      const Exact_point p = random_inner_point(scene.source, random), q = random_inner_point(scene.target, random);
      const Line_point line{p[0], p[1], q[0], q[1]};
      std::size_t within = 0;
      bool boundary = false;
      for (const Free_cell& cell : free) {
        int least = 1;
        for (const Wall& wall : cell.cell) least = std::min(least, sgn(wall.height(line)));
        within += least > 0;
        boundary = boundary || least == 0;
      }
      EXPECT_TRUE(boundary || within == (proves_visible(flats, scene.source, 0, {p, q}) ? 1 : 0)) << within;
    }
  }
  EXPECT_GT(cells, 50u);
}

TEST(Weak_oracles, agree_on_parallel_planes) {
  Tally level, projected;
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(test_scenes::sample(300u)); ++seed) {
    const Weak_scene scene = parallel_planes_scene(seed);
    const bool is_level =
        std::all_of(scene.source.begin(), scene.source.end(), [](const Exact_point& p) { return sgn(p[2]) == 0; });
    ask(scene, 0, 20, is_level ? level : projected);
  }
  if (!has_z3()) GTEST_SKIP() << "with rays only: needs z3 (Debian: z3)";
  if (test_scenes::is_sanitized()) return;  // so few scenes may be of one kind
  for (const Tally& tally : {level, projected}) {
    EXPECT_GT(4 * tally.visible, tally.asked());
    EXPECT_GT(6 * tally.hidden, tally.asked());
    EXPECT_LT(2 * tally.unknown, tally.asked());
    EXPECT_GT(tally.rays, 0u);
  }
  EXPECT_LT(100 * level.unknown, level.asked());  // these are linear
}

class Weak_families : public testing::TestWithParam<std::size_t> {};

TEST_P(Weak_families, have_the_truth_that_z3_and_rays_find) {
  const weak_scenes::Family& family = weak_scenes::families()[GetParam()];
  Tally tally;
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(test_scenes::is_sanitized() ? 2 : 6); ++seed) {
    const Weak_scene scene = family.make(seed);
    ASSERT_FALSE(scene.targets.empty()) << scene.name;
    for (std::size_t k = 0; k < std::min<std::size_t>(scene.targets.size(), 2); ++k) {
      ask(scene, scene.targets[k], 20, tally);
    }
  }
  if (!has_z3()) GTEST_SKIP() << "with rays only: needs z3 (Debian: z3)";
  if (test_scenes::is_sanitized()) return;  // two scenes may be all visible, or all hidden
  EXPECT_GT(tally.visible, 0u);
  EXPECT_GT(tally.hidden, 0u);
  EXPECT_LT(4 * tally.unknown, 3 * tally.asked());  // folded surfaces are hard
}

TEST_P(Weak_families, are_the_same_for_the_same_seed_and_hold_what_they_promise) {
  const weak_scenes::Family& family = weak_scenes::families()[GetParam()];
  std::set<std::string> texts;
  const auto text = [](const Weak_scene& scene) {
    std::string all = scene.name.substr(0, scene.name.find(' '));
    for (std::size_t i = 0; i < scene.soup.coordinates.size(); ++i)
      all += ' ' + sightline::to_string(scene.soup.coordinates[i]);
    return all;
  };
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Weak_scene scene = family.make(seed);
    EXPECT_EQ(scene.name, family.name + ' ' + std::to_string(seed));
    EXPECT_EQ(text(scene), text(family.make(seed)));
    texts.insert(text(scene));
    EXPECT_LE(scene.soup.face_count(), 20u);
    const Half_space plane = plane_of(scene.source);
    EXPECT_TRUE(lies_in(scene.source, plane)) << scene.name;
    for (std::size_t k = 0; k < scene.source.size(); ++k) {
      const Points corner{scene.source[k], scene.source[(k + 1) % scene.source.size()],
                          scene.source[(k + 2) % scene.source.size()]};
      EXPECT_GT(dot(plane_of(corner).normal, plane.normal), 0) << scene.name;
    }
    const sightline::Scene read(scene.soup);
    for (const Face_id target : scene.targets)
      EXPECT_TRUE(std::any_of(read.pieces().begin(), read.pieces().end(), [&](const sightline::Piece& piece) {
        return piece.face == target;
      })) << scene.name;
  }
  EXPECT_GE(texts.size(), 10u);
}

INSTANTIATE_TEST_SUITE_P(All, Weak_families, testing::Range<std::size_t>(0, weak_scenes::families().size()),
                         [](const testing::TestParamInfo<std::size_t>& i) {
                           return weak_scenes::families()[i.param].name;
                         });

// ---- Projective maps

TEST(Weak_projection, keeps_sightlines_and_blocked_segments) {
  Random random(4);
  std::size_t free = 0, mirrored = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Weak_scene scene = weak_scenes::families()[seed % 2 == 0 ? 16 : 17].make(seed);
    const Projective_map map =
        seed % 3 == 0 ? weak_scenes::random_axes(random) : weak_scenes::random_projection(scene, random);
    const Weak_scene other = project(scene, map);
    const Flats flats = flats_of_scene(scene), images = flats_of_scene(other);
    ASSERT_EQ(flats.size(), images.size());
    mirrored += weak_scenes::image(map, scene.source[0]) != other.source[0];
    for (std::size_t k = 0; k < 20; ++k) {
      const Face_id target = scene.targets[random.below(scene.targets.size())];
      const Exact_point p = random_inner_point(scene.source, random);
      const auto piece =
          std::find_if(flats.begin(), flats.end(), [&](const Flat& flat) { return flat.face == target; });
      const Exact_point q = random_inner_point(piece->corners, random);
      const bool proof = proves_visible(flats, scene.source, target, {p, q});
      EXPECT_EQ(proves_visible(images, other.source, target,
                               Sightline{weak_scenes::image(map, p), weak_scenes::image(map, q)}),
                proof)
          << scene.name;
      free += proof;
    }
  }
  EXPECT_GT(free, 100u);
  EXPECT_GT(mirrored, 5u);
}

TEST(Weak_projection, refuses_maps_that_tear_or_flatten_the_scene) {
  const Weak_scene scene = corner_of_a_room({});  // x in [0, 2]
  const auto with_weight = [](const Rational& x, const Rational& constant) {
    Projective_map map = weak_scenes::scaling(1, at(0, 0, 0));
    map[3] = {x, 0, 0, constant};
    return map;
  };
  EXPECT_NO_THROW(project(scene, with_weight(-1, ratio(21, 10))));
  EXPECT_THROW(project(scene, with_weight(-1, 2)), std::invalid_argument);
  EXPECT_THROW(project(scene, with_weight(-1, 1)), std::invalid_argument);
  EXPECT_THROW(project(scene, with_weight(1, -3)), std::invalid_argument);
  EXPECT_THROW(project(scene, weak_scenes::scaling(0, at(1, 1, 1))), std::invalid_argument);
}

}  // namespace
}  // namespace weak_oracle
