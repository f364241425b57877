#pragma once
// Arcs of the priority relation from an eye that has faces on all sides, or from a region about it, against rays; and
// components of the whole relation where faces are so small that doubles do not hold their planes, against all arcs;
// and arcs of polygons of hundreds of corners, of which bisection looks at a few.

#include "soups.h"

#include <sightline/algorithms/priority/components.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/algorithms/priority/scope.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>

#include <algorithm>
#include <array>
#include <vector>

namespace fuzz {

using harness::Flat_face;

inline void try_region(Random& random) {
  const Scene scene(generate::soup_of(random.chance(5, 6) ? about_the_eye(random) : groups(random)));
  const Exact_traits traits(scene);
  const Priority_relation<Exact_traits> whole(traits);
  const std::vector<Flat_face> faces = harness::flat_faces_of(scene);
  View_region region = View_region::eye({0, 0, 0});
  if (random.chance(1, 2)) {  // further eyes, near the first
    for (std::uint64_t k = 1 + random.below(3); k > 0; --k) {
      region.points.push_back(generate::lattice(random, 1));
      for (Rational& x : region.points.back()) x /= 8;
    }
    if (random.chance(1, 2)) std::reverse(region.points.begin(), region.points.end());
  }
  const Region_relation<Exact_traits> relation(whole, region);
  Relation_counters counters;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    require(relation.on_view(i) == std::any_of(region.points.begin(), region.points.end(),
                                               [&](const Exact_point& p) { return faces[i].height(p) > 0; }),
            "what is on-view is seen from the front by an eye of the region");
    for (std::uint32_t j = 0; j < faces.size(); ++j) {
      if (i == j) continue;
      const Arcs arcs = relation.arcs(i, j, counters);
      const auto truly = [&](const Flat_face& a, const Flat_face& b) {
        return region.points.size() == 1 ? harness::sees_over(region.points[0], a, b)
                                         : harness::some_eye_sees_over(region.points, a, b);
      };
      require(arcs.forth == truly(faces[i], faces[j]) && arcs.back == truly(faces[j], faces[i]),
              "there is an arc iff an eye of the region sees one face over the other");
    }
  }
}

/// r1 may obscure r2 iff it has a corner before r2's plane, and r2 one behind r1's.
inline bool may_obscure(const Flat_face& a, const Flat_face& b) {
  return std::any_of(a.corners.begin(), a.corners.end(), [&](const Exact_point& p) { return b.height(p) > 0; }) &&
         std::any_of(b.corners.begin(), b.corners.end(), [&](const Exact_point& p) { return a.height(p) < 0; });
}

template <class Traits>
Priority_components components_of(const Scene& scene) {
  const Traits traits(scene);
  const Priority_relation<Traits> relation(traits);
  Implicit_priority_graph<Priority_relation<Traits>> graph(relation);
  return graph.find_components();
}

inline void try_components(Random& random) {
  generate::Faces drawn = random.chance(1, 2) ? groups(random) : about_the_eye(random);
  generate::add_any(drawn, random.below(8), random);
  const bool scaled = random.chance(1, 2);  // all of them; planes of a kernel's numbers are then beyond doubles
  static constexpr std::array powers{-700, -520, -510, -447, -400, -300, 300, 400, 510, 520};
  const Rational scale = generate::power_of_two(scaled ? powers[random.below(powers.size())] : 0);
  for (generate::Points& face : drawn)
    for (Exact_point& p : face)
      for (Rational& x : p) x *= scale;
  const Scene scene(generate::soup_of(scaled ? drawn : of_many_scales(drawn, random)));
  const std::vector<Flat_face> faces = harness::flat_faces_of(scene);
  const Priority_components found = random.chance(1, 2)
                                        ? components_of<Exact_traits>(scene)
                                        : components_of<Point_traits<CGAL::Cartesian<CGAL::Gmpq>>>(scene);
  const std::uint32_t n = static_cast<std::uint32_t>(faces.size());
  std::vector<std::vector<char>> reaches(n, std::vector<char>(n));
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      reaches[i][j] = i == j || may_obscure(faces[i], faces[j]);
      require(!reaches[i][j] || found.h(i) <= found.h(j), "nothing obscures what has higher priority");
    }
  for (std::uint32_t k = 0; k < n; ++k)
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; j < n; ++j) reaches[i][j] = reaches[i][j] || (reaches[i][k] && reaches[k][j]);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j)
      require((found.h(i) == found.h(j)) == (reaches[i][j] && reaches[j][i]),
              "a component is what obscures one another, over others or not");
}

/// A convex polygon of so many corners or a few less, in any plane, begun anywhere. Most of its edges may look one way,
/// so that few of them rise, or few fall, over a plane; opposite ones may be parallel.
inline generate::Points of_many_corners(std::size_t n, Random& random) {
  // 1. Edges around a turn, and one that closes it.
  const bool is_even = random.chance(1, 3);
  const std::int64_t bias_x = random.between(-9, 9), bias_y = random.between(-9, 9);
  std::vector<std::array<std::int64_t, 2>> edges;
  std::array<std::int64_t, 2> end{0, 0};
  while (edges.size() + 1 < n) {
    const std::array<std::int64_t, 2> d{random.between(-400, 400), random.between(-400, 400)};
    if ((d[0] == 0 && d[1] == 0) || (!is_even && d[0] * bias_x + d[1] * bias_y < 0 && random.chance(7, 8))) continue;
    edges.push_back(d);
    if (is_even) edges.push_back({-d[0], -d[1]});
    else end = {end[0] - d[0], end[1] - d[1]};
  }
  if (end[0] != 0 || end[1] != 0) edges.push_back(end);
  const auto half = [](const std::array<std::int64_t, 2>& d) { return d[1] < 0 || (d[1] == 0 && d[0] < 0); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) {
    return half(a) != half(b) ? half(a) < half(b) : a[0] * b[1] > a[1] * b[0];
  });

  // 2. Corners, in space.
  const Exact_point u = generate::lattice(random, 2), v = generate::lattice(random, 2);
  const Exact_point origin = generate::lattice(random, 1000);
  generate::Points corners;
  std::array<std::int64_t, 2> at{0, 0};
  for (const auto& d : edges) {
    corners.push_back(origin);
    for (std::size_t k = 0; k < 3; ++k)
      corners.back()[k] += Rational(static_cast<long>(at[0])) * u[k] + Rational(static_cast<long>(at[1])) * v[k];
    at = {at[0] + d[0], at[1] + d[1]};
  }
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random.below(corners.size())),
              corners.end());
  return corners;
}

inline void try_many_corners(Random& random) {
  // 1. Two such polygons, one of them in the other's plane at times, and triangles that have corners with them in
  // common.
  generate::Faces drawn;
  for (int k = 0; k < 2; ++k) drawn.push_back(of_many_corners(8 + random.below(400), random));
  if (random.chance(1, 4))
    drawn[1].assign(drawn[0].begin(), drawn[0].begin() + static_cast<std::ptrdiff_t>(drawn[0].size() / 2));
  for (generate::Points& face : drawn)
    if (random.chance(1, 2)) std::reverse(face.begin(), face.end());
  for (std::uint64_t k = 2 + random.below(6); k > 0; --k) {
    generate::Points triangle;
    for (int corner = 0; corner < 3; ++corner) {
      const generate::Points& other = drawn[random.below(2)];
      const std::uint64_t kind = random.below(3);
      triangle.push_back(kind == 0 ? generate::lattice(random, 100000) : other[random.below(other.size())]);
      if (kind == 1) triangle.back()[random.below(3)] += random.chance(1, 2) ? 1 : -1;
    }
    drawn.push_back(triangle);
  }

  // 2. Each pair by brute force.
  const Scene scene(generate::soup_of(drawn));
  const Exact_traits traits(scene);
  const Priority_relation<Exact_traits> relation(traits);
  const std::vector<Flat_face> faces = harness::flat_faces_of(scene);
  Relation_counters counters;
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (std::uint32_t j = 0; j < faces.size(); ++j) {
      if (i == j) continue;
      const bool forth = may_obscure(faces[i], faces[j]);
      require(relation.may_obscure(i, j, counters) == forth,
              "a polygon may obscure another one by its extreme corners");
      const Arcs both = relation.arcs(i, j, counters);
      require(both.forth == forth && both.back == may_obscure(faces[j], faces[i]),
              "arcs of two polygons are each one's");
      for (const Sign side : {CGAL::POSITIVE, CGAL::NEGATIVE}) {
        const std::uint32_t found = relation.find_corner(i, side, j, counters.predicates);
        require(found == faces[i].corners.size() || sgn(faces[j].height(faces[i].corners[found])) == side,
                "a corner that is found is on the side asked for");
      }
    }
}

inline void arcs(std::string_view bytes) {
  Random random(Bytes(bytes).word());
  if (random.chance(1, 8)) try_many_corners(random);
  else if (random.chance(2, 3)) try_region(random);
  else try_components(random);
}

}  // namespace fuzz
