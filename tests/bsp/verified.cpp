// Every order is one that the independent checker accepts, and it does reject wrong ones.

#include "../sample.h"
#include "support.h"

#include <sightline/algorithms/verify/pairs.h>
#include <sightline/harness/generate/shapes.h>

#include <rapidcheck/gtest.h>

using namespace bsp_test;

namespace {

Bsp_options random_options(Random& random) {
  Bsp_options options = serial();
  options.seed = random.below(1000);
  options.candidates = static_cast<unsigned>(random.below(6));
  options.split_weight = static_cast<unsigned>(random.below(8));
  options.sample = static_cast<unsigned>(random.below(50));
  return options;
}

TEST(Verified, orders_of_small_degenerate_scenes) {
  const std::uint64_t scenes = test_scenes::sample(std::uint64_t{2400});
  std::size_t splits = 0, on_planes = 0, shared = 0, set_aside = 0, concave = 0, non_planar = 0;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    Random random(seed);
    const Polygon_soup soup = moved_somewhere(random_soup(random), random);
    const Built built(soup, random_options(random));
    for (int eyes = 0; eyes < 2; ++eyes) {
      const Exact_point eye = random_eye(built, random);
      ASSERT_TRUE(verified(built, eye)) << "seed " << seed;
      on_planes +=
          traverse(built.traits, built.tree, built.traits.eye(eye), Direction::back_to_front, [](const Drawn&, Sign) {
          }).on_planes;
    }
    splits += built.tree.counters.splits;
    set_aside += built.scene.set_aside().size();
    concave += built.scene.concave().size();
    non_planar += built.scene.non_planar().size();
    for (const Tree::Node& node : built.tree.nodes) shared += node.count > 1;
  }
  // The generator makes what it is meant to make.
  EXPECT_GT(splits, scenes);
  EXPECT_GT(on_planes, scenes);
  EXPECT_GT(shared, scenes / 2);
  EXPECT_GT(set_aside, scenes / 4);
  EXPECT_GT(concave, scenes / 4);
  EXPECT_GT(non_planar, scenes / 8);
}

RC_GTEST_PROP(Verified, orders_from_any_eye_and_any_options, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const Polygon_soup soup = moved_somewhere(random_soup(random, *rc::gen::inRange<std::size_t>(1, 15)), random);
  const Built built(soup, random_options(random));
  const Exact_point eye = random_eye(built, random);
  const testing::AssertionResult result = verified(built, eye);
  RC_LOG() << result.message();
  RC_ASSERT(bool{result});
}

TEST(Verified, orders_of_generated_scenes) {
  const std::map<std::string_view, std::size_t> sizes{{"bars", 9},
                                                      {"city", 6},
                                                      {"city_rotated", 6},
                                                      {"convex_sphere", 100},
                                                      {"crossing", 8},
                                                      {"grid", 2},
                                                      {"lattice", 2},
                                                      {"menger_sponge", 1},
                                                      {"menger_sponge_merged", 1},
                                                      {"rooms", 1},
                                                      {"slivers", 30},
                                                      {"soup", 60},
                                                      {"soup_constant_density", 50},
                                                      {"stacked", 20},
                                                      {"terrain", 80},
                                                      {"triangles_between_squares", 30}};
  ASSERT_EQ(sizes.size(), generate::kinds().size()) << "a new kind of scene: give it a size here";
  for (const auto& [kind, size] : sizes) {
    Random random(size);
    const Polygon_soup soup = generate::make(kind, size, 3);
    const Built built(soup);
    const int eyes = test_scenes::is_sanitized() ? 1 : 3;
    for (int k = 0; k < eyes; ++k) ASSERT_TRUE(verified(built, random_eye(built, random))) << kind;
    if (size > 60) continue;
    const Built off(
        generate::one_ulp_perturbed(generate::translated(soup, at(ratio(1, 3), ratio(1, 3), ratio(1, 3))), 5));
    ASSERT_TRUE(verified(off, random_eye(off, random))) << kind << ", one ulp off";
    const Built away(generate::translated(soup, at(100000000, 100000000, -100000000)));
    ASSERT_TRUE(verified(away, random_eye(away, random))) << kind << ", far from the origin";
    const Built tiny(generate::scaled(soup, exact_decimal(1, -50)));
    ASSERT_TRUE(verified(tiny, random_eye(tiny, random))) << kind << ", tiny";
  }
}

TEST(Verified, not_an_order_in_which_two_neighbours_that_overlap_are_swapped) {
  std::size_t tried = 0;
  const std::size_t wanted = test_scenes::sample(std::size_t{1000});
  for (std::uint64_t seed = 0; tried < wanted; ++seed) {
    ASSERT_LT(seed, 5000u) << "too few pairs overlap";
    Random random(seed);
    const Built built(random_soup(random, 12));
    const Exact_point eye = random_eye(built, random);
    const auto order = built.order(eye);
    std::vector<order_check::Cone> cones;
    for (const Drawn* fragment : order) cones.emplace_back(built.corners(fragment->polygon), eye);
    order_check::Pair_check check;
    for (std::size_t i = 1; i < order.size() && tried < wanted; ++i) {
      if (cones[i - 1].edge_on || cones[i].edge_on || !check.nearer_somewhere(cones[i], cones[i - 1])) continue;
      auto swapped = order;
      std::swap(swapped[i - 1], swapped[i]);
      const Verdict verdict = verify_order(built.soup, certificate_of(built, eye, swapped));
      ASSERT_FALSE(verdict.accepted) << "seed " << seed << ", place " << i;
      ASSERT_EQ(verdict.fragments, (std::vector<std::size_t>{i - 1, i}));
      ++tried;
      break;  // at most one of each scene
    }
  }
}

TEST(Verified, not_the_order_of_another_eye) {
  const Built built(generate::stacked(3));
  EXPECT_TRUE(verify_order(built.soup, certificate_of(built, at(0, 0, 9), built.order(at(0, 0, 9)))).accepted);
  EXPECT_FALSE(verify_order(built.soup, certificate_of(built, at(0, 0, 9), built.order(at(0, 0, -9)))).accepted);
  EXPECT_FALSE(
      verify_order(built.soup, certificate_of(built, at(0, 0, 9), built.order(at(0, 0, 9), Direction::front_to_back)))
          .accepted);
}

}  // namespace
