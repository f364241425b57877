// Orders written down by hand.

#include "support.h"

#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/shapes.h>

using namespace bsp_test;

namespace {

using Faces = std::vector<Face_id>;

/// Where fragments of a face come in the order: each one's place and its points.
struct Place {
  std::size_t at;
  Points points;
};
std::vector<Place> places(const Built& built, const std::vector<const Drawn*>& order, Face_id face) {
  std::vector<Place> found;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (built.traits.face(order[i]->polygon.piece) == face) found.push_back({i, built.corners(order[i]->polygon)});
  return found;
}

/// Options that put the planes of these faces on top, so that the tree is known.
Bsp_options rooted_at(const Polygon_soup& soup, const Faces& faces) {
  Bsp_options options = serial();
  const Scene scene(soup);  // the same soup gives the same planes
  for (const Face_id face : faces)
    for (const Piece& piece : scene.pieces())
      if (piece.face == face && piece.number == 0) options.first.push_back(piece.support);
  return options;
}

TEST(Order, an_empty_scene_has_an_empty_tree_and_order) {
  const Built built{Polygon_soup()};
  EXPECT_TRUE(built.tree.nodes.empty());
  EXPECT_EQ(built.tree.counters.depth, 0u);
  EXPECT_TRUE(built.order(at(0, 0, 0)).empty());
}

TEST(Order, stacked_squares_come_from_below_for_an_eye_above_and_the_other_way_round_from_below) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Bsp_options options = serial();
    options.seed = seed;
    options.candidates = 1 + static_cast<unsigned>(seed % 3);
    const Built built(soup_of({rectangle(0, 1, 0, 1, 0), reversed(rectangle(0, 1, 0, 1, 1)), rectangle(0, 1, 0, 1, 2),
                               rectangle(0, 1, 0, 1, 3)}),
                      options);
    EXPECT_EQ(built.face_order(at(ratio(1, 2), ratio(1, 2), 9)), (Faces{0, 1, 2, 3}));
    EXPECT_EQ(built.face_order(at(ratio(1, 2), ratio(1, 2), -9)), (Faces{3, 2, 1, 0}));
    // Between 1 and 2 there are two sequences, each from the far end.
    const Faces order = built.face_order(at(ratio(1, 2), ratio(1, 2), ratio(3, 2)));
    const auto place = [&](Face_id f) { return std::find(order.begin(), order.end(), f) - order.begin(); };
    EXPECT_LT(place(0), place(1));
    EXPECT_LT(place(3), place(2));
  }
}

TEST(Order, three_bars_in_a_cycle_are_cut_so_that_at_each_overlap_the_upper_bar_comes_later) {
  // Bars along the sides of a triangle, each rising from height 0 at its first corner to 1 at its second: bar k is over
  // bar k + 1 there.
  const std::array<Exact_point, 3> triangle{at(0, 0, 0), at(6, 0, 0), at(3, 6, 0)};
  std::vector<Points> bars;
  for (std::size_t k = 0; k < 3; ++k) {
    Exact_point d = minus(triangle[(k + 1) % 3], triangle[k]);
    const Exact_point side = at(-d[1] / 12, d[0] / 12, 0);
    d[2] = 1;
    const Exact_point from = along(triangle[k], ratio(-1, 6), d), to = along(triangle[k], ratio(7, 6), d);
    bars.push_back({along(from, -1, side), along(to, -1, side), along(to, 1, side), along(from, 1, side)});
  }
  const auto covers = [](const Points& polygon, const Exact_point& p) {  // seen from straight above
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Exact_point e = minus(polygon[(i + 1) % polygon.size()], polygon[i]), q = minus(p, polygon[i]);
      if (sgn(Rational(e[0] * q[1] - e[1] * q[0])) <= 0) return false;
    }
    return true;
  };
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Bsp_options options = serial();
    options.seed = seed;
    options.candidates = 1 + static_cast<unsigned>(seed % 4);
    const Built built(soup_of(bars), options);
    const Exact_point eye = at(3, 2, 1000000);
    ASSERT_TRUE(verified(built, eye));
    EXPECT_GE(built.tree.counters.splits, 1u) << "no order of whole bars is right";
    const auto order = built.order(eye);
    for (std::size_t k = 0; k < 3; ++k) {
      const Exact_point overlap = along(triangle[(k + 1) % 3], ratio(1, 97), at(1, ratio(1, 3), 0));
      std::array<std::ptrdiff_t, 2> place{-1, -1};
      for (const std::size_t upper : {0u, 1u})
        for (const Place& part : places(built, order, static_cast<Face_id>(upper == 1 ? k : (k + 1) % 3)))
          if (covers(part.points, overlap)) place.at(upper) = static_cast<std::ptrdiff_t>(part.at);
      ASSERT_GE(place[0], 0);
      EXPECT_LT(place[0], place[1]) << "bar " << k << " lies over the next";
    }
  }
}

TEST(Order, three_mutually_overlapping_bars_of_generate_are_ordered) {
  for (const std::size_t n : {3, 5}) {
    const Built built(generate::bars(n));
    const auto [low, high] = built.scene.box();
    const Exact_point eye = along(centroid({low, high}), 1, at(0, 0, 100));
    EXPECT_TRUE(verified(built, eye));
    EXPECT_GE(built.tree.counters.splits, 1u);
  }
}

TEST(Order, of_two_crossing_quads_the_root_stands_between_the_halves_of_the_other) {
  // Face 0 in the plane x = 0, face 1 in y = 0, crossing in the z axis. The eye is in front of neither edge-on: at (3,
  // 5, 0).
  const Polygon_soup soup = soup_of({{at(0, -2, -1), at(0, 2, -1), at(0, 2, 1), at(0, -2, 1)},
                                     {at(-2, 0, -1), at(-2, 0, 1), at(2, 0, 1), at(2, 0, -1)}});
  const Exact_point eye = at(3, 5, 0);
  {
    const Built built(soup, rooted_at(soup, {0}));
    const auto order = built.order(eye);
    ASSERT_EQ(built.faces(order), (Faces{1, 0, 1}));
    EXPECT_EQ(centroid(built.corners(order[0]->polygon)), at(-1, 0, 0));  // the far half has x < 0
    EXPECT_EQ(centroid(built.corners(order[2]->polygon)), at(1, 0, 0));
    EXPECT_EQ(built.face_order(eye, Direction::front_to_back), (Faces{1, 0, 1}));
  }
  {
    const Built built(soup, rooted_at(soup, {1}));
    const auto order = built.order(eye);
    ASSERT_EQ(built.faces(order), (Faces{0, 1, 0}));
    EXPECT_EQ(centroid(built.corners(order[0]->polygon)), at(0, -1, 0));
    EXPECT_EQ(centroid(built.corners(order[2]->polygon)), at(0, 1, 0));
  }
  for (std::uint64_t seed = 0; seed < 10; ++seed) {  // free choice: one of the two
    Bsp_options options = serial();
    options.seed = seed;
    const Faces order = Built(soup, options).face_order(eye);
    EXPECT_TRUE(order == (Faces{1, 0, 1}) || order == (Faces{0, 1, 0}));
  }
}

TEST(Order, a_u_shaped_face_is_cut_where_a_quad_passes_through_its_notch) {
  // In the plane z = x; seen from above its left arm is below the quad, its right arm above it.
  const Points u{at(-2, -2, -2), at(2, -2, 2),   at(2, 2, 2),   at(1, 2, 1),
                 at(1, -1, 1),   at(-1, -1, -1), at(-1, 2, -1), at(-2, 2, -2)};
  const Polygon_soup soup = soup_of({u, rectangle(-2, 2, 0, 1, 0)});
  const Exact_point eye = at(0, 0, 10);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Bsp_options options = serial();
    options.seed = seed;
    const Built built(soup, options);
    ASSERT_TRUE(verified(built, eye));
    const auto order = built.order(eye);
    const auto quads = places(built, order, 1);
    ASSERT_FALSE(quads.empty());
    std::size_t left = 0, right = 0;
    for (const Place& part : places(built, order, 0)) {
      // Parts of the arms that overlap the quad as seen: their points are all in |x| >= 1, and y goes over (0, 1).
      const auto y = std::minmax_element(part.points.begin(), part.points.end(),
                                         [](const Exact_point& p, const Exact_point& q) { return p[1] < q[1]; });
      if (!((*y.first)[1] <= 0 && (*y.second)[1] >= 1)) continue;
      if (std::all_of(part.points.begin(), part.points.end(), [](const Exact_point& p) { return p[0] <= -1; })) {
        ++left;
        for (const Place& quad : quads)
          if (std::any_of(quad.points.begin(), quad.points.end(), [](const Exact_point& p) { return p[0] < -1; })) {
            EXPECT_LT(part.at, quad.at);
          }
      }
      if (std::all_of(part.points.begin(), part.points.end(), [](const Exact_point& p) { return p[0] >= 1; })) {
        ++right;
        for (const Place& quad : quads)
          if (std::any_of(quad.points.begin(), quad.points.end(), [](const Exact_point& p) { return p[0] > 1; })) {
            EXPECT_GT(part.at, quad.at);
          }
      }
    }
    EXPECT_EQ(left, 1u);
    EXPECT_EQ(right, 1u);
  }
  // With the quad's plane on top nothing but the U's base is cut: left, quad, right.
  const Built built(soup, rooted_at(soup, {1}));
  const auto order = built.order(eye);
  const Faces faces = built.faces(order);
  const auto quad = std::find(faces.begin(), faces.end(), 1u);
  ASSERT_EQ(std::count(faces.begin(), faces.end(), 1u), 1);
  for (auto it = faces.begin(); it != faces.end(); ++it) {
    if (it == quad) continue;
    const Exact_point middle = centroid(built.corners(order[static_cast<std::size_t>(it - faces.begin())]->polygon));
    EXPECT_EQ(it < quad, middle[0] < 0) << "what is below the quad comes before it";
  }
}

TEST(Order, coplanar_faces_that_overlap_share_a_node_in_the_order_of_the_scene_with_their_senses) {
  const Polygon_soup soup = soup_of({rectangle(0, 2, 0, 2, 5), reversed(rectangle(1, 3, 1, 3, 5)),
                                     rectangle(-1, 4, 1, 2, 5), reversed(rectangle(0, 2, 0, 2, 5))});
  const Built built(soup);
  ASSERT_EQ(built.tree.nodes.size(), 1u);
  ASSERT_EQ(built.tree.fragments.size(), 4u);
  EXPECT_EQ(built.tree.counters.splits, 0u);
  const auto& f = built.tree.fragments;
  EXPECT_NE(f[0].same_sense, f[1].same_sense);
  EXPECT_EQ(f[0].same_sense, f[2].same_sense);
  EXPECT_EQ(f[1].same_sense, f[3].same_sense);
  // In whichever sense the node's plane is named, face 0 looks up.
  Predicate_counts counts;
  const Sign above = built.traits.side(built.traits.eye(at(0, 0, 9)), built.tree.nodes[0].plane, counts);
  EXPECT_EQ(f[0].same_sense, above == CGAL::POSITIVE);
  for (const Exact_point& eye : {at(1, 1, 9), at(1, 1, -9), at(1, 1, 5)})
    EXPECT_EQ(built.face_order(eye), (Faces{0, 1, 2, 3}));
  EXPECT_TRUE(verified(built, at(1, 1, 9)));
  EXPECT_EQ(traverse(built.traits, built.tree, built.traits.eye(at(1, 1, 9)), Direction::back_to_front,
                     [](const Drawn&, Sign) {})
                .fragments,
            4u);
}

TEST(Order, a_face_seen_edge_on_is_visited_once_with_side_zero_and_hides_nothing) {
  // The eye is in the plane x = 0 of face 0; faces 1 and 2 are on its two sides.
  const Polygon_soup soup = soup_of({{at(0, -1, -1), at(0, 1, -1), at(0, 1, 1), at(0, -1, 1)},
                                     {at(1, 1, -1), at(3, 1, -1), at(3, 1, 1), at(1, 1, 1)},
                                     {at(-3, 2, -1), at(-1, 2, -1), at(-1, 2, 1), at(-3, 2, 1)}});
  const Exact_point eye = at(0, -10, 0);
  const Built built(soup, rooted_at(soup, {0}));
  std::vector<std::pair<Face_id, Sign>> visited;
  const Traversal_counters counters =
      traverse(built.traits, built.tree, built.traits.eye(eye), Direction::front_to_back,
               [&](const Drawn& f, Sign side) { visited.emplace_back(built.traits.face(f.polygon.piece), side); });
  ASSERT_EQ(visited.size(), 3u);
  EXPECT_EQ(visited[1], (std::pair<Face_id, Sign>{0, CGAL::ZERO}));
  EXPECT_EQ(visited[0].first, 1u) << "the front child is the nearer one by convention";
  EXPECT_NE(visited[0].second, CGAL::ZERO);
  EXPECT_EQ(counters.on_planes, 1u);
  EXPECT_EQ(counters.nodes, 3u);
  EXPECT_EQ(counters.fragments, 3u);
  EXPECT_EQ(built.face_order(eye), (Faces{2, 0, 1}));
  EXPECT_TRUE(verified(built, eye));
}

TEST(Order, a_subtree_that_is_not_entered_is_passed_over_and_the_rest_keeps_its_order) {
  const Built built(generate::lattice(2));
  const auto eye = built.traits.eye(at(ratio(1, 3), 1, ratio(7, 2)));
  std::vector<std::size_t> all;
  const auto enter_all = [](std::size_t) { return true; };
  traverse_nodes(built.traits, built.tree, eye, Direction::front_to_back, enter_all,
                 [&](std::size_t node, Sign) { all.push_back(node); });
  ASSERT_EQ(all.size(), built.tree.nodes.size());
  for (std::size_t left = 0; left < built.tree.nodes.size(); ++left) {
    // Preorder: what is below a node comes right after it.
    std::size_t end = left;
    for (std::vector<std::int32_t> below{static_cast<std::int32_t>(left)}; !below.empty();) {
      const auto node = static_cast<std::size_t>(below.back());
      below.pop_back();
      end = std::max(end, node + 1);
      for (const std::int32_t child : {built.tree.nodes[node].front, built.tree.nodes[node].behind})
        if (child != Bsp_tree<Exact_traits>::leaf) below.push_back(child);
    }
    std::vector<std::size_t> visited, expected;
    const Traversal_counters counters = traverse_nodes(
        built.traits, built.tree, eye, Direction::front_to_back, [&](std::size_t node) { return node != left; },
        [&](std::size_t node, Sign) { visited.push_back(node); });
    std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
                 [&](std::size_t node) { return node < left || node >= end; });
    ASSERT_EQ(visited, expected);
    ASSERT_EQ(counters.nodes, expected.size());
  }
}

TEST(Order, the_side_told_to_the_visitor_is_that_of_the_eye_to_the_nodes_plane) {
  const Built built(generate::lattice(2));
  const Exact_point eye = at(ratio(1, 3), 1, ratio(7, 2));
  std::vector<Sign> sides;
  traverse(built.traits, built.tree, built.traits.eye(eye), Direction::back_to_front, [&](const Drawn& f, Sign side) {
    const Points corners = built.corners(f.polygon);
    const int front = sgn(dot(normal_of(corners), minus(eye, corners[0])));  // of the fragment
    EXPECT_EQ(static_cast<int>(side), f.same_sense ? front : -front);
    sides.push_back(side);
  });
  for (const Sign s : {CGAL::NEGATIVE, CGAL::ZERO, CGAL::POSITIVE})
    EXPECT_NE(std::count(sides.begin(), sides.end(), s), 0);
}

TEST(Order, holds_for_an_eye_at_a_vertex_on_a_face_on_an_edge_and_inside_a_solid) {
  const Built built(generate::menger_sponge(1));
  for (const Exact_point& eye :
       {at(0, 0, 0), at(1, 1, 1), at(1, 1, 0), at(ratio(1, 2), ratio(1, 2), 0), at(ratio(1, 2), 0, 0),
        at(ratio(1, 2), ratio(1, 2), ratio(1, 2)), at(ratio(3, 2), ratio(3, 2), ratio(3, 2)), at(3, 3, 3),
        at(ratio(1, 3), ratio(4, 3), 1)})
    EXPECT_TRUE(verified(built, eye));
}

TEST(Order, from_inside_a_box_each_wall_comes_before_what_stands_in_front_of_it) {
  // A room of six walls with a screen in it: the screen is nearer than the wall behind it.
  Polygon_soup soup = generate::grid(1);
  const Face_id screen =
      add_face(soup, {at(ratio(1, 4), ratio(1, 2), ratio(1, 4)), at(ratio(3, 4), ratio(1, 2), ratio(1, 4)),
                      at(ratio(3, 4), ratio(1, 2), ratio(3, 4)), at(ratio(1, 4), ratio(1, 2), ratio(3, 4))});
  const Built built(soup);
  const Exact_point eye = at(ratio(1, 2), ratio(1, 4), ratio(1, 2));
  const auto order = built.order(eye);
  ASSERT_TRUE(verified(built, eye));
  const auto mine = places(built, order, screen);
  ASSERT_EQ(mine.size(), 1u);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Points corners = built.corners(order[i]->polygon);
    if (std::all_of(corners.begin(), corners.end(), [](const Exact_point& p) { return p[1] == 1; })) {
      EXPECT_LT(i, mine[0].at);
    }
  }
}

TEST(Order, near_to_far_is_far_to_near_reversed_but_for_the_order_within_nodes) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Built built(random_soup(random));
    const Exact_point eye = random_eye(built, random);
    const auto node_of = [&](const Drawn* fragment) {
      const auto place = static_cast<std::uint32_t>(fragment - built.tree.fragments.data());
      const auto node = std::find_if(built.tree.nodes.begin(), built.tree.nodes.end(), [&](const Tree::Node& n) {
        return n.first <= place && place < n.first + n.count;
      });
      return node - built.tree.nodes.begin();
    };
    const auto nodes = [&](Direction direction) {
      std::vector<std::ptrdiff_t> sequence;
      for (const Drawn* fragment : built.order(eye, direction)) sequence.push_back(node_of(fragment));
      return sequence;
    };
    std::vector<std::ptrdiff_t> far_first = nodes(Direction::back_to_front);
    ASSERT_EQ(far_first.size(), built.tree.fragments.size()) << "every fragment once";
    std::reverse(far_first.begin(), far_first.end());
    // Where the eye is in a node's plane the front child is the nearer one in both directions.
    EXPECT_EQ(far_first, nodes(Direction::front_to_back)) << "seed " << seed;
    // Within a node: the order of the scene, both ways.
    for (const Direction direction : {Direction::back_to_front, Direction::front_to_back}) {
      const auto order = built.order(eye, direction);
      for (std::size_t i = 1; i < order.size(); ++i)
        if (node_of(order[i - 1]) == node_of(order[i])) {
          EXPECT_LT(order[i - 1]->polygon.piece, order[i]->polygon.piece);
        }
    }
  }
}

}  // namespace
