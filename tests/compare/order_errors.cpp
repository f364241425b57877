// How wrong an order is: zero for exact ones, and exact values for errors made on purpose.

#include "support.h"

#include "../soup.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/harness/compare/order_errors.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/soups.h>

using namespace compare_test;

namespace {

using Order = std::vector<Order_fragment>;

std::vector<Exact_point> square(const Rational& x, const Rational& y, const Rational& z, const Rational& side = 1) {
  return {at(x, y, z), at(x + side, y, z), at(x + side, y + side, z), at(x, y + side, z)};
}
using test_scenes::soup_of;
Order exact_order(const Scene& scene, const Exact_point& eye) {
  const Exact_traits traits(scene);
  Bsp_options options;
  options.threads = 1;
  const auto tree = build_bsp(traits, options);
  Order order;
  traverse(traits, tree, traits.eye(eye), Direction::back_to_front, [&](const auto& fragment, Sign) {
    const Piece& piece = scene.pieces()[fragment.polygon.piece];
    order.push_back({piece.face, piece.number, {}});
    for (const auto& corner : fragment.polygon) order.back().vertices.push_back(traits.position(*corner.vertex));
  });
  return order;
}
void expect_none(const Order_errors& errors) {
  EXPECT_EQ(errors.wrong, 0u);
  EXPECT_EQ(errors.wrong_beyond_rounding, 0u);
  EXPECT_EQ(errors.degenerate, 0u);
  EXPECT_EQ(errors.lost, 0);
  EXPECT_EQ(errors.overlapping, 0);
  EXPECT_EQ(errors.outside, 0);
}

TEST(Order_errors, of_exact_orders_are_zero) {
  for (const Polygon_soup& soup : {generate::soup(30, 0.5, 1), generate::lattice(2), generate::crossing(7),
                                   generate::bars(5), generate::menger_sponge(1), generate::city(5, 3, true),
                                   generate::translated(generate::soup(20, 0.5, 4), at(100000000, 1, -100000000)),
                                   generate::scaled(generate::bars(4), exact_decimal(1, -50))}) {
    SCOPED_TRACE(soup.file);
    const Scene scene(soup);
    const auto [low, high] = scene.box();
    for (const Exact_point& eye : {low, at(high[0], low[1], 7),
                                   at(Rational((low[0] + high[0]) / 2), Rational((low[1] + high[1]) / 2),
                                      Rational((low[2] + 2 * high[2]) / 3))}) {
      const Order order = exact_order(scene, eye);
      const Order_errors errors = order_errors(scene, eye, order, 100000);
      expect_none(errors);
      EXPECT_EQ(errors.fragments, order.size());
      EXPECT_EQ(errors.pairs, order.size() * (order.size() - 1) / 2);
    }
  }
}

struct Three {  // unit squares one above the other, seen from above
  Scene scene{soup_of({square(0, 0, 0), square(0, 0, 1), square(0, 0, 2)})};
  Exact_point eye = at(ratio(1, 2), ratio(1, 2), 5);
  Order order = exact_order(scene, eye);
  Order_errors errors() const { return order_errors(scene, eye, order, 100); }
};

TEST(Order_errors, count_each_wrong_pair) {
  Three three;
  expect_none(three.errors());
  std::swap(three.order[0], three.order[1]);
  EXPECT_EQ(three.errors().wrong, 1u);
  EXPECT_EQ(three.errors().wrong_beyond_rounding, 1u);
  EXPECT_EQ(three.errors().pairs, 3u);
  EXPECT_EQ(three.errors().lost, 0);
  std::sort(three.order.begin(), three.order.end(), [](const auto& a, const auto& b) { return a.face > b.face; });
  EXPECT_EQ(three.errors().wrong, 3u) << "the whole order is reversed";
}

TEST(Order_errors, tell_rounding_from_more) {
  // Two squares 2^-30 of their distance apart, drawn in the wrong order.
  const auto wrong = [](unsigned bits) {
    Integer denominator = 1;
    denominator <<= bits;
    const Scene scene(soup_of({square(0, 0, 0), square(0, 0, Rational(Integer(1), denominator))}));
    const Exact_point eye = at(ratio(1, 2), ratio(1, 2), 1);
    Order order = exact_order(scene, eye);
    std::swap(order[0], order[1]);
    const Order_errors errors = order_errors(scene, eye, order, 10);
    EXPECT_EQ(errors.wrong, 1u);
    return errors.wrong_beyond_rounding;
  };
  EXPECT_EQ(wrong(30), 0u);
  EXPECT_EQ(wrong(21), 0u);
  EXPECT_EQ(wrong(19), 1u);
  EXPECT_EQ(wrong(3), 1u);
}

TEST(Order_errors, count_what_is_lost_exactly) {
  Three three;
  three.order.pop_back();
  EXPECT_EQ(three.errors().lost, ratio(1, 3));
  EXPECT_EQ(three.errors().overlapping, 0);
  EXPECT_EQ(three.errors().pairs, 1u);
  three.order.clear();
  EXPECT_EQ(three.errors().lost, 1);
  Three cut;  // and in part: a triangle of a square
  cut.order[1].vertices.pop_back();
  EXPECT_EQ(cut.errors().lost, ratio(1, 6));
  EXPECT_EQ(cut.errors().degenerate, 0u);
}

TEST(Order_errors, count_what_is_drawn_twice_exactly) {
  Three three;
  three.order.push_back(three.order.back());
  EXPECT_EQ(three.errors().overlapping, ratio(1, 3));
  EXPECT_EQ(three.errors().lost, 0);
  EXPECT_EQ(three.errors().wrong, 0u) << "in one plane nothing is nearer";
  three.order.push_back(three.order.back());
  EXPECT_EQ(three.errors().overlapping, ratio(2, 3)) << "three times counts twice";
  three.order.back().vertices = {three.order[0].vertices[0], three.order[0].vertices[1], three.order[0].vertices[2]};
  EXPECT_EQ(three.errors().overlapping, ratio(1, 2)) << "half of it";
}

TEST(Order_errors, count_what_is_outside_exactly) {
  Three three;
  const Face_id face = three.order[2].face;
  ASSERT_EQ(face, 2u);
  three.order[2].vertices = square(ratio(1, 4), 0, 2);
  EXPECT_EQ(three.errors().outside, ratio(1, 12));
  EXPECT_EQ(three.errors().lost, ratio(1, 12));
  EXPECT_EQ(three.errors().overlapping, 0);
  three.order[2].vertices = square(5, 5, 2);
  EXPECT_EQ(three.errors().outside, ratio(1, 3));
  EXPECT_EQ(three.errors().lost, ratio(1, 3));
}

TEST(Order_errors, move_a_fragment_that_is_off_its_plane_back_along_the_dominant_axis) {
  Three three;
  for (Exact_point& p : three.order[2].vertices) p[2] += ratio(1, 1000000);
  three.order[2].vertices[0][2] += 1;
  expect_none(three.errors());
  // On a slanted face, z = x / 2 + y / 4: off by a little in z only.
  const Scene scene(soup_of({{at(0, 0, 0), at(4, 0, 2), at(4, 4, 3), at(0, 4, 1)}, square(1, 1, -3)}));
  const Exact_point eye = at(1, 2, 100);
  Order order = exact_order(scene, eye);
  ASSERT_EQ(order.size(), 2u);
  for (Exact_point& p : order[1].vertices) p[2] += ratio(1, 7);
  expect_none(order_errors(scene, eye, order, 10));
  std::swap(order[0], order[1]);
  EXPECT_EQ(order_errors(scene, eye, order, 10).wrong, 1u);
}

TEST(Order_errors, count_fragments_without_area_and_leave_them_out) {
  Three three;
  three.order.push_back({2, 0, {at(0, 0, 2), at(1, 1, 2), at(ratio(1, 2), ratio(1, 2), 2)}});
  three.order.push_back({0, 0, {at(0, 0, 0), at(1, 0, 0)}});
  three.order.push_back({0, 0, {}});
  const Order_errors errors = three.errors();
  EXPECT_EQ(errors.degenerate, 3u);
  EXPECT_EQ(errors.fragments, 6u);
  EXPECT_EQ(errors.wrong, 0u);
  EXPECT_EQ(errors.overlapping, 0);
  Three bent;  // a corner twice, or a turned polygon: its hull is what counts for areas, but no cone is made of it
  bent.order[0].vertices.push_back(bent.order[0].vertices.back());
  std::reverse(bent.order[1].vertices.begin(), bent.order[1].vertices.end());
  EXPECT_EQ(bent.errors().degenerate, 2u);
  EXPECT_EQ(bent.errors().lost, 0);
}

TEST(Order_errors, leave_pairs_out_where_there_are_too_many) {
  Three three;
  std::swap(three.order[0], three.order[2]);
  EXPECT_EQ(order_errors(three.scene, three.eye, three.order, 3).pairs, 3u);
  const Order_errors errors = order_errors(three.scene, three.eye, three.order, 2);
  EXPECT_EQ(errors.pairs, 0u);
  EXPECT_EQ(errors.wrong, 0u);
}

TEST(Order_errors, ignore_fragments_seen_edge_on) {
  const Scene scene(soup_of({square(0, 0, 0), square(0, 0, 1)}));
  const Exact_point eye = at(-5, ratio(1, 2), 1);  // in the upper one's plane
  Order order = exact_order(scene, eye);
  expect_none(order_errors(scene, eye, order, 10));
  std::swap(order[0], order[1]);
  expect_none(order_errors(scene, eye, order, 10));
}

TEST(Order_errors, judge_the_pieces_of_a_concave_face_each_by_itself) {
  const Scene scene(soup_of({{at(0, 0, 0), at(2, 0, 0), at(2, 1, 0), at(1, 1, 0), at(1, 2, 0), at(0, 2, 0)}}));
  ASSERT_EQ(scene.pieces().size(), 2u);
  const Exact_point eye = at(0, 0, 3);
  Order order = exact_order(scene, eye);
  expect_none(order_errors(scene, eye, order, 10));
  std::swap(order[0].piece, order[1].piece);
  const Order_errors errors = order_errors(scene, eye, order, 10);
  EXPECT_EQ(errors.lost, 1);
  EXPECT_EQ(errors.outside, 1);
  order[0].piece = 2;
  EXPECT_THROW(order_errors(scene, eye, order, 10), std::out_of_range);
}

TEST(Order_errors, of_an_empty_scene_are_zero) {
  expect_none(order_errors(Scene(Polygon_soup()), at(0, 0, 0), {}, 10));
}

}  // namespace
