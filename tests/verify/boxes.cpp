// What a segment comes near, where doubles hold it badly: no box that it meets is left out.

#include "scenes.h"

#include "../sample.h"

#include <sightline/algorithms/verify/boxes.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace verify_boxes_test {
namespace {

using namespace verify_test;
using namespace certificate_check;

/// Coordinates of one kind: small numbers, thirds, far away, tiny, huge, and those that no double holds.
class Places {
 public:
  explicit Places(std::uint64_t seed) : random_(seed) {
    unit_ = 1;
    const int kind = number(0, 5);
    if (kind == 1) unit_ = ratio(1, 3);
    if (kind == 2) offset_ = Rational(Integer(1) << 60) / 3;
    if (kind == 3) unit_ = tiny(1070);
    if (kind == 4) unit_ = Rational(Integer(1) << 1010) / 7;
    if (kind == 5) unit_ = Rational(Integer(1) << 1030);
  }
  int number(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  Rational coordinate(int range) { return offset_ + unit_ * number(-range, range); }
  Exact_point point(int range) { return {coordinate(range), coordinate(range), coordinate(range)}; }
  const Rational& unit() const { return unit_; }

 private:
  std::mt19937_64 random_;
  Rational unit_, offset_ = 0;
};

TEST(Boxes, of_polygons_that_a_segment_meets_are_all_near_it) {
  std::size_t near = 0, all = 0;
  for (std::uint64_t seed = 0; seed < test_scenes::sample(600U); ++seed) {
    Places places(seed);
    const int count = places.number(1, 200);
    // 1. Small triangles, and for each a segment through one of its points.
    std::vector<Polygon> polygons;
    std::vector<Outward_box> boxes;
    for (int i = 0; i < count; ++i) {
      const Exact_point corner = places.point(50);
      Polygon polygon(3, corner);
      for (std::size_t k = 0; k < 3; ++k) polygon[1 + k % 2][k] += places.unit() * places.number(0, 2);
      boxes.emplace_back(polygon);
      polygons.push_back(std::move(polygon));
    }
    const Boxes tree(boxes);
    for (int i = 0; i < count; ++i) {
      const Polygon& polygon = polygons[static_cast<std::size_t>(i)];
      Exact_point middle = polygon[static_cast<std::size_t>(places.number(0, 2))], from = places.point(60), to;
      const Rational beyond = ratio(places.number(0, 9), places.number(1, 9));
      for (std::size_t k = 0; k < 3; ++k) to[k] = middle[k] + beyond * (middle[k] - from[k]);
      // 2. It is near, once, as is each other box that it may meet.
      const std::vector<std::size_t> found = tree.near_segment(from, to);
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), static_cast<std::size_t>(i))) << seed << ", " << i;
      EXPECT_TRUE(std::adjacent_find(found.begin(), found.end(), std::greater_equal<>()) == found.end());
      near += found.size();
      all += polygons.size();
    }
  }
  EXPECT_LT(4 * near, 3 * all);  // and others are passed over
}

TEST(Boxes, that_meet_each_other_or_one_are_all_found_once) {
  std::size_t pairs = 0, all = 0;
  for (std::uint64_t seed = 0; seed < test_scenes::sample(300U); ++seed) {
    Places places(seed);
    std::vector<Outward_box> boxes;
    for (int i = places.number(0, 120); i > 0; --i) {
      const Exact_point corner = places.point(20);
      Exact_point other = corner;
      for (Rational& x : other) x += places.unit() * places.number(0, 6);
      boxes.emplace_back(Polygon{corner, other});
    }
    const Boxes tree(boxes);
    // 1. Pairs, leaf by leaf.
    std::vector<std::pair<std::size_t, std::size_t>> found, expected;
    for (std::size_t leaf = 0; leaf < tree.leaves(); ++leaf)
      tree.for_each_pair(leaf,
                         [&](std::size_t i, std::size_t j) { found.emplace_back(std::min(i, j), std::max(i, j)); });
    for (std::size_t j = 0; j < boxes.size(); ++j)
      for (std::size_t i = 0; i < j; ++i)
        if (boxes[i].meets(boxes[j])) expected.emplace_back(i, j);
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(found, expected) << seed;
    pairs += found.size();
    all += boxes.size() * boxes.size() / 2;
    // 2. Those that meet one, which may be without end.
    for (const Outward_box& box : boxes) {
      Outward_box part = box;
      if (places.number(0, 1) == 0) part.high[1] = Outward_box::infinity;
      std::vector<std::size_t> near, right;
      tree.find(part, near);
      for (std::size_t i = 0; i < boxes.size(); ++i)
        if (boxes[i].meets(part)) right.push_back(i);
      std::sort(near.begin(), near.end());
      EXPECT_EQ(near, right) << seed;
    }
    // 3. Each has a place in the order.
    std::vector<std::uint32_t> order = tree.order();
    std::sort(order.begin(), order.end());
    for (std::uint32_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
    EXPECT_EQ(order.size(), boxes.size());
  }
  EXPECT_GT(10 * pairs, all / 10);
  EXPECT_LT(2 * pairs, all);
}

TEST(Boxes, hold_what_they_are_of) {
  for (std::uint64_t seed = 0; seed < test_scenes::sample(2000U); ++seed) {
    Places places(seed);
    const Polygon points{places.point(50), places.point(50)};
    const Outward_box box(points);
    for (const Exact_point& p : points)
      for (std::size_t k = 0; k < 3; ++k) {
        if (std::isfinite(box.low[k])) EXPECT_LE(exact(box.low[k]), p[k]);
        else EXPECT_LT(box.low[k], 0);
        if (std::isfinite(box.high[k])) EXPECT_GE(exact(box.high[k]), p[k]);
        else EXPECT_GT(box.high[k], 0);
      }
  }
  EXPECT_TRUE(Boxes({}).near_segment({0, 0, 0}, {1, 1, 1}).empty());
}

}  // namespace
}  // namespace verify_boxes_test
