#pragma once
// Cutting polygons by planes, for every model of Partition_traits: what an exact one must obey and what can be counted
// of the others.

#include "soup.h"

#include <sightline/kernel/traits/partition_traits.h>

namespace kernel_test {

template <class Traits>
std::vector<Exact_point> positions(const Traits& traits, const Convex_polygon<Traits>& polygon) {
  std::vector<Exact_point> result;
  for (const Corner<Traits>& corner : polygon) result.push_back(traits.position(*corner.vertex));
  return result;
}

/// Whether the polygon is strictly convex and counterclockwise about `normal`.
inline bool is_strictly_convex(const std::vector<Exact_point>& polygon, const Vector& normal) {
  const std::size_t n = polygon.size();
  if (n < 3 || dot(normal, area_vector(polygon)) <= 0) return false;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)  // all of a small one, the neighbours of a large one
      if ((n <= 8 || j == (i + 2) % n) && j != i && j != (i + 1) % n &&
          dot(normal, cross(minus(polygon[(i + 1) % n], polygon[i]), minus(polygon[j], polygon[i]))) <= 0)
        return false;
  return true;
}

/// Splits a polygon across a plane and checks the laws of split(): the parts tile it, share the crossings, and touch
/// the plane where they should. `plane` is the cutter's plane in the file's coordinates. Only for exact models.
template <class Traits>
std::array<Convex_polygon<Traits>, 2> checked_split(const Traits& traits, const Convex_polygon<Traits>& polygon,
                                                    const typename Traits::Cutter& cutter,
                                                    const std::array<Rational, 4>& plane, Polygon_store<Traits>& store,
                                                    Predicate_counts& counts) {
  Split_scratch<Traits> scratch;
  EXPECT_EQ(classify(traits, polygon, cutter, scratch, counts), Position::across);
  EXPECT_EQ(position(traits, polygon, cutter, counts), Position::across);
  const auto parts = split(traits, polygon, cutter, scratch, store);
  const std::vector<Exact_point> whole = positions(traits, polygon);
  const Vector area = area_vector(whole);
  Vector sum{0, 0, 0};
  Chain chain;
  chain.add(whole, -1);
  std::array<std::vector<const typename Traits::Vertex*>, 2> on;
  for (std::size_t side = 0; side < 2; ++side) {
    EXPECT_EQ(parts[side].piece, polygon.piece);
    const std::vector<Exact_point> part = positions(traits, parts[side]);
    EXPECT_TRUE(is_strictly_convex(part, area)) << "part " << side << " of " << part.size() << " corners";
    const Vector a = area_vector(part);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += a[k];
    chain.add(part);
    bool inside = false;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const int s = sgn(value(plane, part[i]));
      EXPECT_EQ(static_cast<int>(traits.side(*parts[side].corners[i].vertex, cutter, counts)), s);
      EXPECT_NE(s, side == 0 ? 1 : -1) << "a part reaches over";
      inside |= s != 0;
      if (s == 0) on[side].push_back(parts[side].corners[i].vertex);
    }
    EXPECT_TRUE(inside);
    EXPECT_EQ(position(traits, parts[side], cutter, counts), side == 0 ? Position::behind : Position::in_front);
  }
  EXPECT_EQ(sum, area);
  EXPECT_TRUE(chain.empty()) << "the parts do not have the boundary of the whole";
  // Both parts hold the very same two vertices on the plane.
  for (auto& list : on) std::sort(list.begin(), list.end());
  EXPECT_EQ(on[0].size(), 2u);
  EXPECT_EQ(on[0], on[1]);
  return parts;
}

/// Cuts one polygon by many planes, each time keeping the larger part. Returns how often it was across.
template <class Traits, class Plane_of>
int cut_deep(const Traits& traits, Convex_polygon<Traits> polygon, const std::vector<Plane>& planes, Plane_of plane_of,
             Polygon_store<Traits>& store, Predicate_counts& counts) {
  int cuts = 0;
  for (const Plane plane : planes) {
    const auto cutter = traits.prepare(plane);
    if (position(traits, polygon, cutter, counts) != Position::across) continue;
    const auto parts = checked_split(traits, polygon, cutter, plane_of(plane), store, counts);
    if (testing::Test::HasFailure()) return cuts;
    const auto size = [&](std::size_t side) {  // in doubles: any choice will do
      std::array<double, 3> sum{};
      const auto all = positions(traits, parts[side]);
      for (std::size_t k = 0; k < all.size(); ++k)
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
          const auto &p = all[k], &q = all[(k + 1) % all.size()];
          sum[i] += p[j].get_d() * q[l].get_d() - p[l].get_d() * q[j].get_d();
        }
      return sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
    };
    polygon = size(0) < size(1) ? parts[1] : parts[0];
    ++cuts;
  }
  return cuts;
}

/// Splits each piece of the scene by the planes of all others, down to convex cells: what a tree does. All sides asked
/// are in `counts`.
template <class Traits>
std::size_t split_all(const Traits& traits, Polygon_store<Traits>& store, Predicate_counts& counts,
                      std::size_t most = 400) {
  Split_scratch<Traits> scratch;
  std::size_t total = 0;
  for (std::uint32_t i = 0; i < traits.piece_count(); ++i) {
    std::vector<Convex_polygon<Traits>> parts{store.piece(traits, i)};
    for (std::uint32_t j = 0; j < traits.piece_count() && parts.size() < most; ++j) {
      const auto cutter = traits.prepare(traits.supporting_plane(j));
      std::vector<Convex_polygon<Traits>> next;
      for (const Convex_polygon<Traits>& part : parts) {
        if (classify(traits, part, cutter, scratch, counts) != Position::across) {
          next.push_back(part);
          continue;
        }
        for (const Convex_polygon<Traits>& half : split(traits, part, cutter, scratch, store))
          if (half.size >= 3) next.push_back(half);
      }
      parts = std::move(next);
    }
    total += parts.size();
  }
  return total;
}

}  // namespace kernel_test
