// The cut-set tracker against testing every face: along paths that are smooth, that jump, and that go where everything
// is degenerate.

#include "support.h"
#include "../sample.h"

#include <sightline/algorithms/cutset/motion.h>
#include <sightline/algorithms/cutset/update_1977.h>
#include <sightline/kernel/traits/point_traits.h>
#include <sightline/harness/generate/shapes.h>

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <cstdlib>

namespace cutset_test {
namespace {

using Random = std::mt19937_64;

Body random_hull(Random& random) {
  for (;;) {
    const std::int64_t size = between(random, 1, 12);
    std::vector<Whole> points(static_cast<std::size_t>(between(random, 4, 18)));
    for (Whole& p : points)
      p = {between(random, -size, size), between(random, -size, size), between(random, -size, size)};
    if (Body body = hull(points); !body.faces.empty()) return body;
  }
}

/// Viewpoints round a body: jumps, small steps, then walks in planes of faces, along edges and through vertices, out of
/// the body and to infinity.
std::vector<Lattice_eye> path_round(const Body& body, Random& random, std::size_t frames) {
  std::vector<Lattice_eye> path;
  const auto point = [&] { return body.points[random() % body.points.size()]; };
  const auto mixed = [&](const Whole& a, std::int64_t wa, const Whole& b,
                         std::int64_t wb) {  // (wa a + wb b) / (wa + wb), off the segment too
    Lattice_eye eye{{}, wa + wb};
    for (std::size_t k = 0; k < 3; ++k) eye.at[k] = wa * a[k] + wb * b[k];
    if (eye.w < 0) {
      eye.w = -eye.w;
      eye.at = {-eye.at[0], -eye.at[1], -eye.at[2]};
    }
    return eye;
  };
  while (path.size() < frames) {
    const std::int64_t reach = between(random, 1, 40);
    switch (random() % 8) {
      case 0:  // a jump
        path.push_back(
            {{between(random, -reach, reach), between(random, -reach, reach), between(random, -reach, reach)},
             between(random, 1, 3)});
        break;
      case 1: {  // small steps
        Whole at{between(random, -1000 * reach, 1000 * reach), between(random, -1000 * reach, 1000 * reach),
                 between(random, -1000 * reach, 1000 * reach)};
        const Whole step{between(random, -reach, reach), between(random, -reach, reach),
                         between(random, -reach, reach)};
        for (int k = 0; k < 12; ++k) {
          path.push_back({at, 1000});
          for (std::size_t a = 0; a < 3; ++a) at[a] += step[a];
        }
        break;
      }
      case 2: {  // along an edge, both ends beyond it
        const auto& face = body.faces[random() % body.faces.size()];
        const std::size_t k = random() % face.size();
        for (std::int64_t t = -3; t <= 7; ++t)
          path.push_back(mixed(body.points[face[k]], 4 - t, body.points[face[(k + 1) % face.size()]], t));
        break;
      }
      case 3: {  // in a face's plane
        const auto& face = body.faces[random() % body.faces.size()];
        const Whole p = body.points[face[0]], u = minus(body.points[face[1]], p), v = minus(body.points[face[2]], p);
        const std::int64_t s = between(random, -6, 6), t = between(random, -6, 6);
        for (std::int64_t k = 0; k < 8; ++k) {
          Lattice_eye eye{{}, 1};
          for (std::size_t a = 0; a < 3; ++a) eye.at[a] = p[a] + (s + k) * u[a] + (t - k) * v[a];
          path.push_back(eye);
        }
        break;
      }
      case 4: {  // through a vertex
        const Whole p = point(), d{between(random, -2, 2), between(random, -2, 2), between(random, -2, 2)};
        for (std::int64_t k = -4; k <= 4; ++k)
          path.push_back({{2 * p[0] + k * d[0], 2 * p[1] + k * d[1], 2 * p[2] + k * d[2]}, 2});
        break;
      }
      case 5:  // inside or on it
        path.push_back(mixed(point(), between(random, 1, 5), point(), between(random, 0, 5)));
        path.push_back(path.back());
        break;
      case 6: {  // at infinity, also along faces
        Whole d = random() % 2 == 0 ? minus(point(), point())
                                    : Whole{between(random, -3, 3), between(random, -3, 3), between(random, -3, 3)};
        if (d == Whole{0, 0, 0}) d = {0, 0, 1};
        path.push_back({d, 0});
        if (random() % 2 == 0) path.push_back({{3 * d[0] + 1, 3 * d[1], 3 * d[2]}, 0});
        break;
      }
      case 7:  // far away
        path.push_back({{between(random, -1, 1) * 1'000'000'000 + 1, between(random, -1, 1) * 1'000'000'000,
                         between(random, -1, 1) * 1'000'000'000},
                        1});
        break;
    }
  }
  return path;
}

/// Clusters of changed nodes without one at the cut-set before.
std::uint64_t births(const Face_graph& graph, const std::vector<bool>& before, const std::vector<bool>& after) {
  std::vector<bool> at_cut(graph.size()), seen(graph.size());
  for (const std::uint32_t e : cut_of(graph, before))
    at_cut[graph.edges()[e].first] = at_cut[graph.edges()[e].second] = true;
  std::uint64_t found = 0;
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    if (seen[i] || before[i] == after[i]) continue;
    std::vector<std::uint32_t> cluster{i};
    seen[i] = true;
    bool touched = false;
    for (std::size_t k = 0; k < cluster.size(); ++k) {
      touched = touched || at_cut[cluster[k]];
      for (const Face_graph::Edge& edge : graph.edges())
        for (const auto& [a, b] : {std::pair(edge.first, edge.second), std::pair(edge.second, edge.first)})
          if (a == cluster[k] && !seen[b] && before[b] != after[b]) {
            seen[b] = true;
            cluster.push_back(b);
          }
    }
    found += !touched;
  }
  return found;
}

std::size_t frames_wanted() { return std::getenv("SIGHTLINE_LONG") != nullptr ? 1200 : 60; }

TEST(Tracker, agrees_with_testing_every_face_of_random_hulls) {
  Random random(1);
  std::uint64_t frames = 0, searches = 0, exact = 0, found = 0;
  for (int trial = 0; trial < test_scenes::sample(1000); ++trial) {
    const Body body = random_hull(random);
    const Stage stage(body.soup());
    ASSERT_EQ(stage.graph.size(), body.faces.size());
    ASSERT_EQ(stage.graph.components().size(), 1u);
    ASSERT_TRUE(stage.graph.is_convex(0)) << "trial " << trial;
    Cut_set_tracker tracker(stage.traits, stage.graph);
    std::vector<bool> before(body.faces.size());
    for (const Lattice_eye& eye : path_round(body, random, frames_wanted())) {
      tracker.move_to(eye.view());
      const std::vector<bool> on = on_view(stage.graph, body, eye);
      ASSERT_TRUE(agrees(tracker, stage.graph, on)) << "trial " << trial << ", frame " << frames << ": " << eye.at[0]
                                                    << ' ' << eye.at[1] << ' ' << eye.at[2] << " / " << eye.w;
      ASSERT_EQ(tracker.on_view_count(), static_cast<std::size_t>(std::count(on.begin(), on.end(), true)));
      ASSERT_EQ(tracker.last().births, births(stage.graph, before, on)) << "trial " << trial << ", frame " << frames;
      std::vector<std::uint32_t> changed;
      for (std::uint32_t i = 0; i < on.size(); ++i)
        if (on[i] != before[i]) changed.push_back(i);
      ASSERT_EQ(sorted(tracker.changed()), changed);
      before = on;
      ++frames;
    }
    searches += tracker.counters().searches;
    exact += tracker.counters().exact;
    found += tracker.counters().births;
  }
  EXPECT_GE(frames, test_scenes::least(60'000u));
  EXPECT_GT(searches, test_scenes::least(1000u));
  EXPECT_GT(exact, test_scenes::least(1000u));
  EXPECT_GT(found, test_scenes::least(1000u));
}

TEST(Tracker, agrees_on_scenes_of_any_kind) {
  Random random(2);
  const std::vector<std::pair<std::string, std::size_t>> kinds{
      {"city", 12},         {"city_rotated", 8}, {"rooms", 1},   {"soup", 60},           {"terrain", 100},
      {"menger_sponge", 1}, {"grid", 2},         {"lattice", 2}, {"convex_sphere", 200}, {"bars", 5}};
  for (const auto& [kind, size] : kinds) {
    const Stage stage(generate::make(kind, size, 3));
    const auto box = stage.scene.box();
    Cut_set_tracker tracker(stage.traits, stage.graph);
    std::vector<bool> before(stage.graph.size());
    Exact_point at = box[0], step{0, 0, 0};
    for (int frame = 0; frame < test_scenes::sample(120); ++frame) {
      Viewpoint view{at, false};
      if (frame % 24 == 7) view = {{Rational(between(random, -3, 3)), Rational(between(random, -3, 3)), 1}, true};
      if (frame % 24 == 13)
        view.at = stage.scene.position(static_cast<std::uint32_t>(random() % stage.scene.points().size()));
      if (frame % 8 == 0) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Rational side = box[1][k] - box[0][k];
          at[k] = box[0][k] + side * Rational(between(random, -50, 150), 100);
          step[k] = side * Rational(between(random, -9, 9), 1000);
        }
      }
      tracker.move_to(view);
      const std::vector<bool> on = on_view(stage.graph, view);
      ASSERT_TRUE(agrees(tracker, stage.graph, on)) << kind << ", frame " << frame;
      ASSERT_EQ(tracker.last().births, births(stage.graph, before, on)) << kind << ", frame " << frame;
      for (std::size_t k = 0; k < 3; ++k) at[k] += step[k];
      before = on;
    }
  }
}

// ---- One step at a time

const Lattice_eye sees_right{{9, 0, 0}, 1}, sees_left{{-9, 0, 0}, 1}, sees_nothing{{0, 0, 0}, 1},
    sees_corner{{9, 9, 9}, 1};

TEST(Tracker, finds_the_far_side_of_a_cube_where_the_plain_update_ends_with_an_empty_cut_set) {
  const Body body = box({-1, -1, -1}, {1, 1, 1});
  const Stage stage(body.soup());
  Cut_set_1977 plain(stage.traits, stage.graph, sees_right.view(), Reading_1977::mended);
  EXPECT_EQ(plain.cut_edges().size(), 4u);
  plain.update_1977(sees_left.view());
  EXPECT_TRUE(plain.cut_edges().empty());
  EXPECT_FALSE(agrees(plain, stage.graph, on_view(stage.graph, body, sees_left)));
  plain.update_1977(sees_right.view());  // and it never comes back
  EXPECT_TRUE(plain.cut_edges().empty());

  Cut_set_tracker tracker(stage.traits, stage.graph);
  tracker.move_to(sees_right.view());
  const Cut_set_counters counters = tracker.move_to(sees_left.view());
  EXPECT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, body, sees_left)));
  EXPECT_EQ(counters.searches, 1u);
  EXPECT_EQ(counters.births, 1u);
  EXPECT_EQ(counters.changed, 2u);
  EXPECT_EQ(counters.tests, 6u);
  EXPECT_EQ(counters.away, 1u) << "all others were at the cut-set";
}

TEST(Tracker, sees_again_what_a_viewpoint_inside_did_not_see) {
  const Body body = box({-1, -1, -1}, {1, 1, 1});
  const Stage stage(body.soup());
  Cut_set_1977 plain(stage.traits, stage.graph, sees_nothing.view(), Reading_1977::mended);
  EXPECT_EQ(plain.update_1977(sees_right.view()), 0u);
  EXPECT_FALSE(agrees(plain, stage.graph, on_view(stage.graph, body, sees_right)));
  Cut_set_tracker tracker(stage.traits, stage.graph);
  for (const Lattice_eye& eye : {sees_nothing, sees_right, sees_nothing, sees_corner, sees_nothing,
                                 Lattice_eye{{1, 0, 0}, 1}, Lattice_eye{{1, 1, 1}, 1}, sees_left}) {
    tracker.move_to(eye.view());
    EXPECT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, body, eye)));
  }
}

TEST(Tracker, keeps_edges_to_faces_that_were_checked_already_where_the_paper_to_the_letter_loses_them) {
  const Body body = box({-1, -1, -1}, {1, 1, 1});
  const Stage stage(body.soup());
  const Lattice_eye next{{9, 2, 0}, 1};  // +y joins +x
  Cut_set_1977 literal(stage.traits, stage.graph, sees_right.view(), Reading_1977::literal),
      mended(stage.traits, stage.graph, sees_right.view(), Reading_1977::mended);
  literal.update_1977(next.view());
  mended.update_1977(next.view());
  EXPECT_FALSE(agrees(literal, stage.graph, on_view(stage.graph, body, next)));
  EXPECT_EQ(literal.cut_edges().size(), 4u);  // of six: those from +y to the faces of +-z are missing
  EXPECT_TRUE(agrees(mended, stage.graph, on_view(stage.graph, body, next)));
  Cut_set_tracker tracker(stage.traits, stage.graph);
  tracker.move_to(sees_right.view());
  tracker.move_to(next.view());
  EXPECT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, body, next)));
}

TEST(Tracker, turns_an_edge_round_where_both_its_ends_change) {
  const Body body = box({-1, -1, -1}, {1, 1, 1});
  const Stage stage(body.soup());
  const Lattice_eye next{{0, 9, 0}, 1};
  Cut_set_1977 literal(stage.traits, stage.graph, sees_right.view(), Reading_1977::literal);
  literal.update_1977(next.view());
  EXPECT_FALSE(agrees(literal, stage.graph, on_view(stage.graph, body, next)));
  Cut_set_tracker tracker(stage.traits, stage.graph);
  tracker.move_to(sees_right.view());
  tracker.move_to(next.view());
  EXPECT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, body, next)));
  EXPECT_EQ(tracker.last().searches, 0u);
}

TEST(Tracker, plain_update_loses_a_dent_that_comes_into_view_and_the_tracker_does_not) {
  // A pyramid-shaped dent in the upper face of a box: its faces come into view one by one, away from the cut-set.
  Body body = box({-8, -8, -8}, {8, 8, 8});
  body.faces.pop_back();
  body.points.push_back({0, 0, -4});
  for (const auto& [p, q] : {std::pair(4u, 5u), std::pair(5u, 7u), std::pair(7u, 6u), std::pair(6u, 4u)})
    body.faces.push_back({p, q, 8});
  const Stage stage(body.soup());
  EXPECT_FALSE(stage.graph.is_convex(0));
  const Lattice_eye low{{90, 0, 0}, 1}, high{{30, 1, 30}, 1};
  Cut_set_tracker tracker(stage.traits, stage.graph);
  Cut_set_1977 plain(stage.traits, stage.graph, sees_nothing.view(), Reading_1977::mended);
  bool lost = false;
  for (const Lattice_eye& eye :
       {Lattice_eye{{0, 0, -90}, 1}, low, high, Lattice_eye{{-30, 1, 30}, 1}, Lattice_eye{{0, 0, 90}, 1}}) {
    tracker.move_to(eye.view());
    plain.update_1977(eye.view());
    EXPECT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, body, eye)));
    lost |= !agrees(plain, stage.graph, on_view(stage.graph, body, eye));
  }
  EXPECT_TRUE(lost);
  EXPECT_GT(tracker.counters().births, 1u);
}

/// Where the plain update goes wrong, exactly: no on-view face stays, and no new one touches an old one. Then the way
/// between the viewpoints meets the body.
TEST(Tracker, plain_update_is_right_where_the_proof_says_so) {
  Random random(5);
  int wrong = 0, right = 0, drastic = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Body body = random_hull(random);
    const Stage stage(body.soup());
    for (int jump = 0; jump < 20; ++jump) {
      const auto eye = [&] {
        return Lattice_eye{{between(random, -30, 30), between(random, -30, 30), between(random, -30, 30)}, 1};
      };
      const Lattice_eye from = eye(), to = eye();
      const std::vector<bool> before = on_view(stage.graph, body, from), after = on_view(stage.graph, body, to);
      const bool sees = std::count(after.begin(), after.end(), true) > 0;
      bool touches = false, stays = false;
      for (std::size_t i = 0; i < before.size(); ++i) stays = stays || (before[i] && after[i]);
      for (const Face_graph::Edge& edge : stage.graph.edges())
        touches = touches || (before[edge.first] && after[edge.second]) || (before[edge.second] && after[edge.first]);
      Cut_set_1977 plain(stage.traits, stage.graph, from.view(), Reading_1977::mended);
      plain.update_1977(to.view());
      const bool agreed = agrees(plain, stage.graph, after);
      ASSERT_EQ(agreed, stays || touches || !sees) << "trial " << trial;
      ASSERT_EQ(agreed, !(plain.cut_edges().empty() && sees)) << "an empty cut-set tells";
      ++(agreed ? right : wrong);
      drastic += agreed && !stays;
      // The way meets the body iff the parts of it behind each plane have a point in common: heights are linear.
      double first = 0, last = 1;
      for (std::size_t f = 0; f < body.faces.size(); ++f) {
        const Whole n = body.normal(f), p = body.points[body.faces[f][0]];
        const double a = static_cast<double>(dot(n, minus(from.at, p))),
                     b = static_cast<double>(dot(n, minus(to.at, p)));
        if (a > 0 && b > 0) last = -1;
        else if (a > 0) first = std::max(first, a / (a - b));
        else if (b > 0) last = std::min(last, a / (a - b));
      }
      if (first > last + 1e-9) {
        ASSERT_TRUE(agreed) << "trial " << trial << ": a way past the body";
      }
    }
  }
  EXPECT_GT(wrong, 50);
  EXPECT_GT(right, 1000);
  EXPECT_GT(drastic, 50);
}

// ---- Where the arithmetic is hard

TEST(Tracker, holds_far_away_scaled_and_one_step_of_the_last_bit_off) {
  for (const auto& [scale, offset] :
       std::vector<std::pair<double, double>>{{1, 0}, {1, 1e8}, {1e-50, 0}, {1e-310, 0}, {1e300, 0}, {1e-30, 1}}) {
    const Body body = box({-1, -2, -3}, {1, 2, 3});
    Polygon_soup soup;
    for (const Whole& p : body.points)
      soup.add_point(static_cast<double>(p[0]) * scale + offset, static_cast<double>(p[1]) * scale + offset,
                     static_cast<double>(p[2]) * scale + offset);
    for (const auto& face : body.faces) soup.add_face(face);
    const Stage stage(soup);
    Cut_set_tracker tracker(stage.traits, stage.graph);
    const double side = static_cast<double>(body.points[7][0]) * scale + offset;
    for (const double x :
         {side, std::nextafter(side, 1e308), side, std::nextafter(side, -1e308), side + 4 * scale, -side, 1e308, side})
      for (const double y : {0.0, offset, side}) {
        const Viewpoint view{{exact(x), exact(y), exact(offset)}, false};
        tracker.move_to(view);
        ASSERT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, view)))
            << scale << ' ' << offset << ' ' << x << ' ' << y;
      }
  }
}

TEST(Tracker, holds_for_viewpoints_beyond_the_range_of_doubles) {
  const Body body = box({-1, -2, -3}, {1, 2, 3});
  const Stage stage(body.soup());
  Cut_set_tracker tracker(stage.traits, stage.graph);
  const Rational huge = exact_decimal(1, 400), tiny = exact_decimal(1, -400);
  for (const Exact_point& at :
       {Exact_point{huge, 0, 0}, Exact_point{-huge, huge, 1}, Exact_point{1 + tiny, 0, 0}, Exact_point{1 - tiny, 0, 0},
        Exact_point{1 + tiny, 2 + tiny, -huge}, Exact_point{0, 0, 0}})
    for (const bool at_infinity : {false, true}) {
      if (at_infinity && at[0] == 0) continue;
      const Viewpoint view{at, at_infinity};
      tracker.move_to(view);
      ASSERT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, view)));
    }
}

TEST(Tracker, tests_nothing_where_nothing_moves) {
  const Stage stage(generate::make("city", 5, 1));
  Cut_set_tracker tracker(stage.traits, stage.graph);
  const Viewpoint view{stage.scene.position(0), false};
  tracker.move_to(view);
  EXPECT_GT(tracker.last().tests, 0u);
  tracker.move_to(view);
  EXPECT_EQ(tracker.last().tests, 0u);
  EXPECT_TRUE(tracker.changed().empty());
}

TEST(Tracker, keeps_its_place_where_a_direction_is_zero) {
  const Stage stage(box({-1, -1, -1}, {1, 1, 1}).soup());
  Cut_set_tracker tracker(stage.traits, stage.graph);
  tracker.move_to(sees_right.view());
  EXPECT_THROW(tracker.move_to({{0, 0, 0}, true}), std::invalid_argument);
  EXPECT_EQ(tracker.on_view_count(), 1u);
  EXPECT_EQ(tracker.cut_edges().size(), 4u);
}

template <class Traits>
void expect_agreement(const char* name) {
  const Scene scene(generate::make("convex_sphere", 100, 1));
  const Face_graph graph(scene);
  const Traits traits(scene);
  Cut_set_tracker<Traits> tracker(traits, graph);
  for (int k = 0; k < 30; ++k) {
    Viewpoint view{{Rational(k - 15, 4), Rational(3 - k, 5), Rational(1, 2)}, false};
    for (Rational& x : view.at) x.canonicalize();
    if (k % 3 == 0) view.at = scene.position(static_cast<std::uint32_t>(k));
    tracker.move_to(view);
    ASSERT_TRUE(agrees(tracker, graph, on_view(graph, view))) << name << ", frame " << k;
  }
  EXPECT_GT(tracker.counters().exact, 0u) << name;
}
TEST(Tracker, works_under_every_exact_kernel) {
  expect_agreement<Exact_traits>("exact");
  expect_agreement<Point_traits<CGAL::Exact_predicates_exact_constructions_kernel>>("epeck");
  expect_agreement<Point_traits<CGAL::Cartesian<CGAL::Gmpq>>>("gmpq");
}

// ---- What it costs

/// A circle of `frames` rational points round the origin.
Viewpoint on_circle(std::int64_t k, std::int64_t frames, std::int64_t radius) {
  const auto [x, y] =
      generate::circle_point(static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(frames), radius << 20);
  return {{Rational(x, 1 << 20), Rational(y, 1 << 20), Rational(radius, 3)}, false};
}

TEST(Tracker, tests_at_most_twice_the_cut_set_on_a_convex_body_in_small_steps) {
  const Stage stage(generate::convex_sphere(1256));
  Cut_set_tracker tracker(stage.traits, stage.graph);
  Cut_set_1977 plain(stage.traits, stage.graph, on_circle(0, 720, 4), Reading_1977::mended);
  std::uint64_t cut = 0, plain_tests = 0;
  tracker.move_to(on_circle(0, 720, 4));
  const std::uint64_t first = tracker.counters().tests;
  for (int k = 1; k < 720; ++k) {
    Viewpoint view = on_circle(k, 720, 4);
    for (Rational& x : view.at) x.canonicalize();
    tracker.move_to(view);
    plain_tests += plain.update_1977(view);
    cut += tracker.cut_edges().size();
    if (k % 30 == 0) {
      ASSERT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, view)));
    }
  }
  EXPECT_LE(static_cast<double>(plain_tests), 2.2 * static_cast<double>(cut));
  EXPECT_LE(static_cast<double>(tracker.counters().tests - first), 1.0 * static_cast<double>(cut));
  EXPECT_LE(static_cast<double>(tracker.counters().tests - first), 0.1 * 719 * static_cast<double>(stage.graph.size()))
      << "more than the paper's 90% are saved";
}

// ---- A moving object

TEST(Rigid_motion, moves_the_viewpoint_the_other_way) {
  const Body body = box({-1, -2, -3}, {2, 3, 4});
  const Polygon_soup soup = body.soup();
  const Stage still(soup);
  Cut_set_tracker tracker(still.traits, still.graph);
  Random random(9);
  for (int k = 0; k < 40; ++k) {
    const auto number = [&] { return Rational(between(random, -5, 5)); };
    const Rigid_motion motion{{number() + 6, number(), number(), number()}, {number(), number(), number()}};
    // The object itself, moved by the matrix of the quaternion.
    const auto& [w, x, y, z] = motion.quaternion;
    Polygon_soup moved;
    for (Point_id p = 0; p < soup.point_count(); ++p) {
      const Exact_point v = soup.point(p);
      // v + 2 w (q x v) + 2 q x (q x v), over |q|^2 where q is no unit
      const Rational size = w * w + x * x + y * y + z * z;
      const auto times = [](const Exact_point& a, const Exact_point& b) {
        return Exact_point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
      };
      const Exact_point q{x, y, z}, qv = times(q, v), qqv = times(q, qv);
      std::array<Rational, 3> at;
      for (std::size_t a = 0; a < 3; ++a) at[a] = v[a] + (2 * w * qv[a] + 2 * qqv[a]) / size + motion.translation[a];
      moved.add_point(at[0], at[1], at[2]);
    }
    for (const auto& face : body.faces) moved.add_face(face);
    const Stage stage(moved);
    const Viewpoint view{{number(), 2 * number(), number()}, k % 5 == 0 && k > 0};
    if (view.at_infinity && view.at[0] == 0 && view.at[1] == 0 && view.at[2] == 0) continue;
    tracker.move_to(motion.seen_from(view));
    const std::vector<bool> moved_on = on_view(stage.graph, view);
    std::vector<bool> on(moved_on.size());
    for (std::uint32_t f = 0; f < on.size(); ++f)
      on[still.graph.node(f)] = moved_on[stage.graph.node(f)];  // nodes are numbered by place
    EXPECT_TRUE(agrees(tracker, still.graph, on)) << "motion " << k;
  }
  const Rigid_motion none{{0, 0, 0, 0}, {0, 0, 0}};
  EXPECT_THROW(none.seen_from(sees_left.view()), std::invalid_argument);
}

}  // namespace
}  // namespace cutset_test
