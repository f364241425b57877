#pragma once
// Arcs of the priority relation from an eye that has faces on all sides, or from a region about it, against rays; and
// components of the whole relation where faces are so small that doubles do not hold their planes, against all arcs.

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
  static constexpr std::array powers{-700, -520, -510, -300, 300, 400, 510, 520};
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

inline void arcs(std::string_view bytes) {
  Random random(Bytes(bytes).word());
  if (random.chance(2, 3)) try_region(random);
  else try_components(random);
}

}  // namespace fuzz
