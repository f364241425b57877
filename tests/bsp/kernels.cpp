// The same algorithm on points of CGAL's kernels: exact ones give the same tree, inexact ones end.

#include "support.h"
#include "../sample.h"

#include <sightline/algorithms/bsp/kernels.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/soups.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

using namespace bsp_test;

namespace {

using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
using Gmpq_kernel = CGAL::Cartesian<CGAL::Gmpq>;

template <class K>
Bsp_tree<Point_traits<K>> tree_on(const Scene& scene, const Bsp_options& options) {
  return build_bsp(Point_traits<K>(scene), options);
}

template <class K>
void expect_as_exact(const Built& built, const Bsp_options& options) {
  const auto tree = tree_on<K>(built.scene, options);
  const Bsp_counters &a = built.tree.counters, &b = tree.counters;
  EXPECT_EQ(a.pieces, b.pieces);
  EXPECT_EQ(a.splits, b.splits);
  EXPECT_EQ(a.fragments, b.fragments);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.free_planes, b.free_planes);
  EXPECT_EQ(b.degenerate, 0u);
}

template <class K>
void expect_same_positions(const Built& built, const Bsp_options& options, const Exact_point& eye) {
  const Point_traits<K> traits(built.scene);
  const auto tree = build_bsp(traits, options);
  ASSERT_EQ(tree.fragments.size(), built.tree.fragments.size());
  for (std::size_t i = 0; i < tree.fragments.size(); ++i) {
    const auto& fragment = tree.fragments[i];
    ASSERT_EQ(fragment.polygon.piece, built.tree.fragments[i].polygon.piece);
    ASSERT_EQ(fragment.number, built.tree.fragments[i].number);
    Points corners;
    for (const auto& corner : fragment.polygon) corners.push_back(traits.position(*corner.vertex));
    ASSERT_EQ(corners, built.corners(built.tree.fragments[i].polygon));
  }
  std::vector<std::size_t> order, truth;
  traverse(traits, tree, traits.eye(eye), Direction::back_to_front, [&](const auto& fragment, Sign) {
    order.push_back(static_cast<std::size_t>(&fragment - tree.fragments.data()));
  });
  for (const Drawn* fragment : built.order(eye))
    truth.push_back(static_cast<std::size_t>(fragment - built.tree.fragments.data()));
  // Node planes may be named in the other sense, which turns children of an eye in their plane; elsewhere the orders
  // agree.
  EXPECT_EQ(std::multiset<std::size_t>(order.begin(), order.end()),
            std::multiset<std::size_t>(truth.begin(), truth.end()));
}

TEST(Kernels, exact_ones_give_the_same_counts_on_degenerate_scenes) {
  for (std::uint64_t seed = 0; seed < test_scenes::sample(200u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Bsp_options options = serial();
    options.seed = seed;
    const Built built(moved_somewhere(random_soup(random, 12), random), options);
    expect_as_exact<Epeck>(built, options);
    expect_as_exact<Gmpq_kernel>(built, options);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Kernels, exact_ones_give_the_same_counts_on_generated_scenes) {
  for (const Polygon_soup& soup :
       {generate::lattice(3), generate::soup(150, 0.3, 2), generate::crossing(12), generate::city(8, 1, true),
        generate::rooms(1, 1, 1), generate::convex_sphere(200)}) {
    SCOPED_TRACE(soup.file);
    const Built built(soup);
    expect_as_exact<Epeck>(built, serial());
    expect_as_exact<Gmpq_kernel>(built, serial());
  }
}

TEST(Kernels, exact_ones_give_the_same_fragments_where_face_planes_have_one_sense) {
  for (std::uint64_t seed = 0; seed < test_scenes::sample(100u); ++seed) {
    const Built built(generate::soup(12, 0.5, seed, 20));
    expect_same_positions<Gmpq_kernel>(built, serial(), at(ratio(1, 2), 3, ratio(1, 4)));
    expect_same_positions<Epeck>(built, serial(), at(ratio(1, 2), 3, ratio(1, 4)));
    if (testing::Test::HasFatalFailure()) return;
  }
}

template <class Number>
void expect_an_end(const Polygon_soup& soup, std::uint64_t seed) {
  using K = CGAL::Simple_cartesian<Number>;
  const Scene scene(soup);
  const Point_traits<K> traits(scene);
  Bsp_options options;
  options.seed = seed;
  options.threads = seed % 4 == 0 ? 2 : 1;
  const auto tree = build_bsp(traits, options);
  EXPECT_LE(tree.fragments.size() + tree.counters.degenerate, tree.counters.pieces + tree.counters.splits);
  EXPECT_EQ(tree.counters.pieces, scene.pieces().size());
  EXPECT_LE(tree.counters.depth, scene.pieces().size());
  for (const auto& fragment : tree.fragments) EXPECT_GE(fragment.polygon.size, 3u);
  std::size_t visited = 0;
  traverse(traits, tree, traits.eye(at(1, 2, 3)), Direction::back_to_front, [&](const auto&, Sign) { ++visited; });
  EXPECT_EQ(visited, tree.fragments.size());
}

TEST(Kernels, float_and_double_end_on_degenerate_scenes) {
  for (std::uint64_t seed = 0; seed < test_scenes::sample(300u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Polygon_soup soup = moved_somewhere(random_soup(random, 30), random);
    expect_an_end<float>(soup, seed);
    expect_an_end<double>(soup, seed);
    if (testing::Test::HasFailure()) return;
  }
  for (const Polygon_soup& soup :
       {generate::lattice(test_scenes::is_sanitized() ? 3 : 6), generate::crossing(test_scenes::sample(60u)),
        generate::soup(test_scenes::sample(1200u), 0.6, 1), generate::rooms(2, 2, 1),
        generate::convex_sphere(test_scenes::sample(2000u)), generate::menger_sponge(1)})
    for (const Polygon_soup& same :
         {soup, generate::rotated(soup, generate::rotation(3, 1, -2, 1)),
          generate::translated(soup, at(100000000, 100000000, 100000000)),
          generate::one_ulp_perturbed(generate::translated(soup, at(ratio(1, 3), ratio(1, 3), ratio(1, 3))), 1)}) {
      SCOPED_TRACE(soup.file);
      expect_an_end<float>(same, 1);
      expect_an_end<double>(same, 1);
    }
}

TEST(Kernels, float_and_double_end_where_everything_is_not_a_number) {
  for (const Polygon_soup& soup : {generate::soup(200, 0.5, 1), generate::lattice(3), generate::convex_sphere(300)})
    for (const long exponent : {30L, 160L, 300L, -30L, -160L, -300L}) {
      SCOPED_TRACE(exponent);
      expect_an_end<float>(generate::scaled(soup, exact_decimal(1, exponent)), 1);
      expect_an_end<double>(generate::scaled(soup, exact_decimal(1, exponent)), 1);
    }
}

TEST(Kernels, a_near_plane_of_a_point_model_leaves_everything_behind_it_in_the_back_subtree) {
  const Scene scene(generate::soup(100, 0.4, 3));
  Point_traits<Gmpq_kernel> traits(scene);
  Bsp_options options = serial();
  options.first = {traits.add_plane({Rational(1), Rational(0), Rational(0), ratio(-1, 2)})};
  const auto tree = build_bsp(traits, options);
  ASSERT_EQ(tree.nodes[0].plane, options.first[0]);
  ASSERT_NE(tree.nodes[0].front, Bsp_tree<Point_traits<Gmpq_kernel>>::leaf);
  ASSERT_NE(tree.nodes[0].behind, Bsp_tree<Point_traits<Gmpq_kernel>>::leaf);
  const std::uint32_t behind = tree.nodes[static_cast<std::size_t>(tree.nodes[0].behind)].first;
  for (std::uint32_t i = 0; i < tree.fragments.size(); ++i)
    for (const auto& corner : tree.fragments[i].polygon) {
      const Rational x = traits.position(*corner.vertex)[0];
      ASSERT_TRUE(i < behind ? x >= ratio(1, 2) : x <= ratio(1, 2));
    }
  EXPECT_EQ(tree.counters.fragments, tree.counters.pieces + tree.counters.splits);
}

}  // namespace
