// Which boxes meet, and which a line along an axis meets, against looking at all of them: leaves of every size.

#include "shapes.h"

#include <sightline/algorithms/solids/box_tree.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/harness/generate/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <set>

namespace {

using namespace sightline;

/// Triangles on a small lattice: many boxes touch, and some have no width.
Operands lattice_triangles(generate::Random& random, std::size_t count) {
  Polygon_soup soup;
  for (std::size_t i = 0; i < count; ++i) {
    const long x = random.between(0, 6), y = random.between(0, 6), z = random.between(0, 6);
    std::vector<Point_id> loop{soup.add_point(Rational(x), Rational(y), Rational(z)),
                               soup.add_point(Rational(x + 1), Rational(y), Rational(z + random.between(0, 1))),
                               soup.add_point(Rational(x), Rational(y + 1), Rational(z))};
    soup.add_face(loop);
  }
  return Operands(std::span(&soup, 1));
}

Box_tree::Box box_of(const Operands& operands, std::size_t piece) {
  Box_tree::Box box{{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
  for (const Piece_corner& corner : operands.corners(piece))
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = operands.points().approximate(corner.point, static_cast<int>(k));
      box.low[k] = std::min(box.low[k], x);
      box.high[k] = std::max(box.high[k], x);
    }
  return box;
}

TEST(Box_tree, pairs_of_boxes_that_meet_come_once_and_no_others) {
  generate::Random random(3);
  for (std::size_t count = 0; count < 70; ++count) {
    const Operands operands = lattice_triangles(random, count);
    const Box_tree tree(operands);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> told;
    for (std::size_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
      tree.for_each_pair(leaf, [&](std::uint32_t i, std::uint32_t first, unsigned met) {
        for (; met != 0; met &= met - 1) {
          const std::uint32_t j = first + static_cast<std::uint32_t>(std::countr_zero(met));
          ASSERT_LT(j, tree.order().size());
          ASSERT_NE(i, j);
          const auto [least, most] = std::minmax(tree.order()[i], tree.order()[j]);
          ++told[{least, most}];
        }
      });
    for (std::uint32_t i = 0; i < operands.pieces().size(); ++i)
      for (std::uint32_t j = i + 1; j < operands.pieces().size(); ++j)
        ASSERT_EQ((told.contains({i, j}) ? told[{i, j}] : 0), box_of(operands, i).meets(box_of(operands, j)))
            << count << ": " << i << ", " << j;
  }
}

TEST(Box_tree, a_ray_along_an_axis_meets_the_boxes_on_its_way) {
  generate::Random random(5);
  for (int turn = 0; turn < 300; ++turn) {
    const Operands operands = lattice_triangles(random, 1 + static_cast<std::size_t>(turn) % 60);
    const Box_tree tree(operands);
    const auto axis = static_cast<std::size_t>(turn % 3);
    const bool upwards = turn % 2 == 0;
    std::array<double, 3> from;
    for (double& x : from) x = static_cast<double>(random.between(-8, 8)) / 2;
    std::multiset<std::uint32_t> told, met;
    tree.for_each_along(from, axis, upwards, [&](std::uint32_t piece) { told.insert(piece); });
    for (std::uint32_t i = 0; i < operands.pieces().size(); ++i) {
      const Box_tree::Box box = box_of(operands, i);
      bool is_met = upwards ? from[axis] <= box.high[axis] : box.low[axis] <= from[axis];
      for (std::size_t k = 0; k < 3; ++k)
        if (k != axis) is_met = is_met && box.low[k] <= from[k] && from[k] <= box.high[k];
      if (is_met) met.insert(i);
    }
    ASSERT_EQ(told, met);
  }
}

}  // namespace
