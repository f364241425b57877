#pragma once
// Convex pieces in the making: triangles that are merged while they stay convex.

#include <sightline/kernel/scene/planar_sites.h>

#include <CGAL/enum.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace sightline::planar {

inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Convex pieces as rings of half-edges, at first one ring for each triangle.
struct Pieces {
  std::vector<std::uint32_t> origin, next, previous, twin;  // twin is none on the polygon's boundary
  std::vector<bool> alive;
  const std::vector<Site>& sites;

  std::uint32_t destination(std::uint32_t h) const { return origin[next[h]]; }
  CGAL::Orientation turn_at(std::uint32_t before, std::uint32_t after) const {
    return Traits::Orientation_2{}(sites[origin[before]], sites[origin[after]], sites[destination(after)]);
  }

  /// Removes diagonals until no removal leaves a convex piece (Hertel and Mehlhorn).
  /// Two convex pieces that touch along a chain of collinear edges are merged across all of it or not at all.
  /// Post: at most four times as many pieces as an optimal partition of a simple polygon has. Exact: yes
  void merge();

  /// Removes diagonals between triangles whose corners lie on one circle: what a Delaunay triangulation could as well
  /// have otherwise. Pre: one ring for each triangle. Post: what is left does not depend on which one it was. Exact:
  /// yes. Proof: P-22
  void merge_circles();

  /// The rings as loops of places in `sites`; straight corners only where asked for.
  std::vector<std::vector<std::uint32_t>> loops(bool with_straight_corners) const;

  void link(std::uint32_t a, std::uint32_t b) {
    next[a] = b;
    previous[b] = a;
  }
  /// Takes the edges from `first` to `last` out of a ring and of its neighbour's, which become one.
  void unite(std::uint32_t first, std::uint32_t last);
};

}  // namespace sightline::planar
