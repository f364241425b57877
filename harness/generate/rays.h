#pragma once
// Rays that go where tracers err: through corners and edges, along faces, from faces, from afar.

#include <sightline/algorithms/rays/ray.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <span>
#include <string_view>

namespace sightline::generate {

/// A kind of rays, and how one of them is made. The same random numbers give the same ray on every machine.
struct Ray_kind {
  std::string_view name, what;
  /// Pre: a soup with a face of three corners or more, or the ray is (0, 0, 0) along x.
  Exact_ray (*make)(const Polygon_soup& soup, Random& random);
};

/// anywhere, corners, edges, grazing, surfaces, far.
std::span<const Ray_kind> ray_kinds();

}  // namespace sightline::generate
