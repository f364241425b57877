// What the builder makes: a tree that holds every piece, the same on any number of threads, of a depth that can be
// used.

#include "check_tree.h"
#include "../sample.h"

#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/shapes.h>

#include <rapidcheck/gtest.h>

#include <chrono>
#include <iostream>
#include <mutex>

using namespace bsp_test;

namespace {

void expect_same(const Built& a, const Built& b) {
  ASSERT_EQ(a.tree.nodes.size(), b.tree.nodes.size());
  for (std::size_t i = 0; i < a.tree.nodes.size(); ++i) {
    const Tree::Node &m = a.tree.nodes[i], &n = b.tree.nodes[i];
    ASSERT_TRUE(m.plane == n.plane && m.front == n.front && m.behind == n.behind && m.first == n.first &&
                m.count == n.count)
        << "node " << i;
  }
  ASSERT_EQ(a.tree.fragments.size(), b.tree.fragments.size());
  for (std::size_t i = 0; i < a.tree.fragments.size(); ++i) {
    const Drawn &f = a.tree.fragments[i], &g = b.tree.fragments[i];
    ASSERT_TRUE(f.polygon.piece == g.polygon.piece && f.same_sense == g.same_sense && f.number == g.number)
        << "fragment " << i;
    ASSERT_EQ(a.corners(f.polygon), b.corners(g.polygon)) << "fragment " << i;
  }
  const Bsp_counters &c = a.tree.counters, &d = b.tree.counters;
  EXPECT_EQ(c.pieces, d.pieces);
  EXPECT_EQ(c.splits, d.splits);
  EXPECT_EQ(c.free_planes, d.free_planes);
  EXPECT_EQ(c.depth, d.depth);
  EXPECT_EQ(c.polygon_tests, d.polygon_tests);
  EXPECT_EQ(c.predicates.total(), d.predicates.total());
}

TEST(Tree, is_sound_for_small_degenerate_scenes) {
  for (std::uint64_t seed = 0; seed < test_scenes::sample(500u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed + 10000);
    Bsp_options options = serial();
    options.seed = seed;
    options.candidates = static_cast<unsigned>(random.below(6));
    const Built built(moved_somewhere(random_soup(random, 10), random), options);
    check_tree(built);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Tree, is_sound_for_generated_scenes) {
  const std::map<std::string_view, std::size_t> sizes{
      {"bars", 60},           {"city", 20},         {"city_rotated", 10},
      {"convex_sphere", 300}, {"crossing", 30},     {"grid", 3},
      {"lattice", 3},         {"menger_sponge", 1}, {"menger_sponge_merged", 1},
      {"rooms", 1},           {"soup", 200},        {"soup_constant_density", 200},
      {"stacked", 60},        {"terrain", 200}};
  std::size_t free_planes = 0;
  for (const auto& [kind, size] : sizes) {
    SCOPED_TRACE(kind);
    const Built built(generate::make(kind, size, 1));
    check_tree(built);
    if (testing::Test::HasFatalFailure()) return;
    free_planes += built.tree.counters.free_planes;
  }
  EXPECT_GT(free_planes, 0u);
}

RC_GTEST_PROP(Tree, holds_every_piece_on_the_plane_of_a_node, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const Built built(moved_somewhere(random_soup(random, *rc::gen::inRange<std::size_t>(1, 30)), random));
  check_tree(built);
  RC_ASSERT(!testing::Test::HasFailure());
}

TEST(Tree, is_the_same_for_any_number_of_threads_and_every_time) {
  // Large cells become tasks of their own from 1024 polygons on.
  const bool sanitized = test_scenes::is_sanitized();
  const std::size_t faces = sanitized ? 1500 : 3000;
  for (const Polygon_soup& soup :
       {generate::soup(faces, 0.05, 4), generate::convex_sphere(faces, 2), generate::rooms(3, 3, 1)}) {
    const Built one(soup);
    for (const int threads : sanitized ? std::vector{4, 2} : std::vector{2, 4, 0, 2}) {
      Bsp_options options;
      options.threads = threads;
      const Built other(soup, options);
      expect_same(one, other);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Tree, differs_for_another_seed) {
  Bsp_options options = serial();
  const Polygon_soup soup = generate::soup(300, 0.2, 4);
  const Built one(soup, options);
  options.seed = 2;
  EXPECT_NE(one.tree.counters.polygon_tests, Built(soup, options).tree.counters.polygon_tests);
}

TEST(Tree, of_a_convex_body_is_not_a_chain) {
  const auto begin = std::chrono::steady_clock::now();
  Bsp_options options;
  options.threads = 2;
  const Built built(generate::convex_sphere(test_scenes::sample(100000u)), options);
  std::cout << built.scene.pieces().size() << " faces of a convex body: "
            << std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() << " s, depth "
            << built.tree.counters.depth << ", " << built.tree.counters.fragments << " fragments, "
            << built.tree.counters.free_planes << " free planes\n";
  EXPECT_LT(built.tree.counters.depth, 200u);
  EXPECT_GT(built.tree.counters.free_planes, 0u);
  EXPECT_LT(built.tree.counters.fragments, 300000u);
  EXPECT_EQ(built.tree.counters.fragments, built.tree.counters.pieces + built.tree.counters.splits);
}

TEST(Tree, of_well_separated_faces_splits_nothing_and_is_shallow) {
  const Built built(generate::stacked(1000));
  EXPECT_EQ(built.tree.counters.splits, 0u);
  EXPECT_EQ(built.tree.nodes.size(), 1000u);
  EXPECT_LT(built.tree.counters.depth, 40u);
}

TEST(Tree, prefers_planes_that_split_nothing) {
  // A long thin quad through the planes of many small ones: choosing any of those cuts it.
  std::vector<Points> faces{rectangle(-1, 21, -1, 1, 0)};
  for (int i = 0; i < 20; ++i) faces.push_back({at(i, 0, 1), at(i, ratio(1, 2), 1), at(i, 0, 2)});
  Bsp_options options = serial();
  options.candidates = 100;
  options.split_weight = 100;
  EXPECT_EQ(Built(soup_of(faces), options).tree.counters.splits, 0u);
  options.split_weight = 0;
  const Built balanced(soup_of(faces), options);
  EXPECT_GT(balanced.tree.counters.splits, 0u) << "nothing but balance counts: the middle one is taken";
  EXPECT_LE(balanced.tree.counters.depth, 6u);
}

TEST(Tree, planes_given_first_are_the_topmost_on_every_way) {
  const Polygon_soup soup = generate::soup(60, 0.3, 8);
  const Scene scene(soup);
  Bsp_options options = serial();
  for (const std::size_t piece : {5u, 27u, 50u}) options.first.push_back(scene.pieces()[piece].support);
  options.first.push_back(options.first[0]);  // once more: everything is on one side of it
  const Built built(soup, options);
  std::vector<std::pair<std::int32_t, std::size_t>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [number, depth] = stack.back();
    stack.pop_back();
    if (number == Tree::leaf || depth >= options.first.size()) continue;
    const Tree::Node& node = built.tree.nodes[static_cast<std::size_t>(number)];
    ASSERT_EQ(node.plane, options.first[depth]);
    stack.emplace_back(node.front, depth + 1);
    stack.emplace_back(node.behind, depth + 1);
  }
  check_tree(built, 1 + 2 + 4 + 8);
  EXPECT_TRUE(verified(built, at(ratio(1, 2), ratio(1, 3), 5)));
}

TEST(Tree, a_near_plane_leaves_everything_behind_it_in_the_back_subtree) {
  const Polygon_soup soup = generate::terrain(200, 3);
  Scene scene(soup);
  const auto [low, high] = scene.box();
  const Exact_point middle = along(low, ratio(3, 7), minus(high, low));
  const Located_point p = scene.locate(middle);
  const Plane near = scene.add_plane({p.w, 0, 0, Integer(-p.x)});
  const Exact_traits traits(scene);
  Bsp_options options = serial();
  options.first = {near};
  const Tree tree = build_bsp(traits, options);
  ASSERT_EQ(tree.nodes[0].plane, near);
  ASSERT_NE(tree.nodes[0].front, Tree::leaf);
  ASSERT_NE(tree.nodes[0].behind, Tree::leaf);
  const std::uint32_t front_begin = tree.nodes[static_cast<std::size_t>(tree.nodes[0].front)].first,
                      behind_begin = tree.nodes[static_cast<std::size_t>(tree.nodes[0].behind)].first;
  ASSERT_LT(front_begin, behind_begin);
  for (std::uint32_t i = tree.nodes[0].count; i < tree.fragments.size(); ++i)
    for (const auto& corner : tree.fragments[i].polygon) {
      const Rational x = traits.position(*corner.vertex)[0];
      ASSERT_TRUE(i < behind_begin ? x >= middle[0] : x <= middle[0]);
    }
}

TEST(Tree, of_fifty_thousand_levels_needs_no_call_stack) {
  // One square and a chain of planes below it, each with the square in front.
  constexpr std::uint32_t levels = 50000;
  Polygon_soup soup = soup_of({rectangle(0, 1, 0, 1, 0)});
  Bsp_options options = serial();
  for (std::uint32_t k = 1; k <= levels; ++k) soup.add_point(0, 0, -static_cast<int>(k));
  {
    const Scene scene(soup);
    for (std::uint32_t k = 1; k <= levels; ++k) options.first.push_back(Plane::across(2, 3 + k));
  }
  for (const int threads : {1, 2}) {
    options.threads = threads;
    const Built built(soup, options);
    ASSERT_EQ(built.tree.nodes.size(), levels + 1u);
    EXPECT_EQ(built.tree.counters.depth, levels + 1u);
    EXPECT_EQ(built.tree.nodes.front().plane, options.first.front());
    EXPECT_EQ(built.face_order(at(0, 0, ratio(-1001, 2))), std::vector<Face_id>{0});
  }
}

TEST(Tree, of_a_long_chain_of_faces_without_free_planes_needs_no_call_stack) {
  // All candidates of stacked squares in one order: the lowest first. Each is tested against those left, so fewer of
  // them.
  constexpr std::size_t levels = 3000;
  const Polygon_soup soup = generate::stacked(levels);
  Bsp_options options = serial();
  const Scene scene(soup);
  for (const Piece& piece : scene.pieces()) options.first.push_back(piece.support);
  const Built built(soup, options);
  EXPECT_EQ(built.tree.counters.depth, levels);
  EXPECT_EQ(built.tree.counters.splits, 0u);
  EXPECT_EQ(built.order(at(0, 0, 5)).size(), levels);
}

TEST(Tree, progress_counts_every_fragment_once) {
  for (const Polygon_soup& soup :
       {generate::soup(3000, 0.1, 1), generate::rooms(3, 3, 1)})  // the latter with many on one node
    for (const int threads : {1, 2}) {
      Bsp_options options;
      options.threads = threads;
      std::mutex mutex;
      std::size_t calls = 0, most = 0, all = 0, beyond = 0;
      options.progress = [&](std::size_t done, std::size_t of) {
        const std::lock_guard lock(mutex);
        ++calls;
        most = std::max(most, done);
        all = std::max(all, of);
        beyond += done > of;
      };
      const Built built(soup, options);
      EXPECT_EQ(all, built.scene.pieces().size() + built.tree.counters.splits);
      EXPECT_EQ(beyond, 0u);
      EXPECT_EQ(most, built.tree.fragments.size());
      EXPECT_EQ(calls, static_cast<std::size_t>(std::count_if(built.tree.nodes.begin(), built.tree.nodes.end(),
                                                              [](const Tree::Node& n) { return n.count > 0; })));
    }
}

TEST(Tree, a_free_plane_that_leaves_everything_on_one_side_is_not_taken) {
  // An oblique cone over a base in x = 0: no face's plane balances, most corners are on x = 0 with all in front of it,
  // and across y or z lies nearly all. What cuts all faces makes x = 0 look cheaper than any of them; taken once, it
  // would be taken for ever.
  std::vector<Points> faces;
  const auto base = [](std::uint64_t k) {
    const auto p = generate::circle_point(k % 40, 40, 1000);
    return at(0, Rational(Integer(static_cast<long>(p[0]))), Rational(Integer(static_cast<long>(p[1]))));
  };
  for (std::uint64_t k = 0; k < 40; ++k) faces.push_back({base(k), base(k + 1), at(3, 100000, 100000)});
  for (const long x : {1, 2})
    faces.push_back({at(x, -200000, -200000), at(x, 200000, -200000), at(x, 200000, 200000), at(x, -200000, 200000)});
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Bsp_options options = serial();
    options.seed = seed;
    options.candidates = 1;
    const Built built(soup_of(faces), options);
    EXPECT_LE(built.tree.counters.depth, 42u);
    EXPECT_EQ(built.tree.counters.fragments, 42u + built.tree.counters.splits);
  }
}

TEST(Tree, an_exception_of_the_progress_callback_arrives_at_the_caller) {
  struct Enough : std::exception {};
  const Polygon_soup soup = generate::soup(5000, 0.05, 1);
  const Scene scene(soup);
  const Exact_traits traits(scene);
  for (const int threads : {1, 2, 4})
    for (const std::size_t after : {1u, 100u, 3000u}) {
      Bsp_options options;
      options.threads = threads;
      options.progress = [&](std::size_t done, std::size_t) {
        if (done >= after) throw Enough();
      };
      EXPECT_THROW(build_bsp(traits, options), Enough) << threads << " threads, after " << after;
    }
  EXPECT_NO_THROW(build_bsp(traits)) << "and nothing is left behind";
}

}  // namespace
