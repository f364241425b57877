#include <sightline/harness/generate/scenes.h>

#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/soups.h>

#include <array>
#include <stdexcept>
#include <string>

namespace sightline::generate {

std::span<const Kind> kinds() {
  static constexpr std::array<Kind, 16> all{{
      {"bars", "bars", "flat bars in a cycle, each over the next", 12, 4,
       [](std::size_t n, std::uint64_t) { return bars(n); }},
      {"city", "boxes", "axis-parallel boxes on a plane", 100, 2,
       [](std::size_t n, std::uint64_t s) { return city(n, s); }},
      {"city_rotated", "boxes", "the same, each box turned by a rational rotation", 100, 2,
       [](std::size_t n, std::uint64_t s) { return city(n, s, true); }},
      {"convex_sphere", "faces (at least)", "a closed, exactly convex body near the unit sphere", 1000, 8,
       [](std::size_t n, std::uint64_t s) { return convex_sphere(n, s); }},
      {"crossing", "faces", "rectangles that cross in one segment", 10, 4,
       [](std::size_t n, std::uint64_t) { return crossing(n); }},
      {"grid", "cells along an axis", "all walls of n x n x n unit cells", 5, 1,
       [](std::size_t n, std::uint64_t) { return grid(n); }},
      {"lattice", "cells along an axis", "squares across n x n x n unit cells, all crossing", 6, 1,
       [](std::size_t n, std::uint64_t) { return lattice(n); }},
      {"menger_sponge", "level", "the boundary of the Menger sponge in unit quads", 2, 1,
       [](std::size_t n, std::uint64_t) { return menger_sponge(n); }},
      {"menger_sponge_merged", "level", "the same in larger rectangles", 2, 1,
       [](std::size_t n, std::uint64_t) { return menger_sponge(n, true); }},
      {"rooms", "rooms along a side", "a house of n x n rooms with doors, windows, furniture", 4, 1,
       [](std::size_t n, std::uint64_t s) { return rooms(n, n, s); }},
      {"soup", "triangles", "random triangles with edges about 1/10 in the unit cube", 1000, 8,
       [](std::size_t n, std::uint64_t s) { return soup(n, 0.1, s); }},
      {"soup_constant_density", "triangles", "random triangles with edges n^(-1/3) in the unit cube", 2000, 8,
       [](std::size_t n, std::uint64_t s) { return soup_constant_density(n, s); }},
      {"stacked", "faces", "unit squares above each other", 10, 5,
       [](std::size_t n, std::uint64_t) { return stacked(n); }},
      {"terrain", "triangles (at least)", "a fractal height field", 1000, 8,
       [](std::size_t n, std::uint64_t s) { return terrain(n, s); }},
      {"triangles_between_squares", "triangles", "random triangles between two squares that look at each other", 50, 6,
       [](std::size_t n, std::uint64_t s) { return triangles_between_squares(n, s); }},
      // Later than the others, and last: the random numbers of a kind's family depend on its place.
      {"slivers", "triangles", "a soup of triangles, a tenth of them slivers across it, of aspect beyond 2^24", 500, 20,
       [](std::size_t n, std::uint64_t s) { return slivers(n, s); }},
  }};
  return all;
}

Polygon_soup make(std::string_view kind, std::size_t size, std::uint64_t seed) {
  std::string names;
  for (const Kind& k : kinds()) {
    if (k.name == kind) return k.make(size, seed);
    names += (names.empty() ? "" : ", ") + std::string(k.name);
  }
  throw std::invalid_argument("no kind of scene '" + std::string(kind) + "': choose one of " + names);
}

}  // namespace sightline::generate
