#include <sightline/algorithms/rays/ray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace sightline {

Exact_ray Double_ray::exact() const {
  Exact_ray ray;
  for (std::size_t k = 0; k < 3; ++k) {
    ray.origin[k] = sightline::exact(origin[k]);
    ray.direction[k] = sightline::exact(direction[k]);
  }
  return ray;
}

Double_ray in_doubles(const Exact_ray& ray) {
  Double_ray doubles;
  for (std::size_t k = 0; k < 3; ++k) {
    doubles.origin[k] = nearest_double(ray.origin[k]);
    doubles.direction[k] = nearest_double(ray.direction[k]);
  }
  return doubles;
}

bool is_ray(const Double_ray& ray) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  return std::all_of(ray.origin.begin(), ray.origin.end(), is_finite) &&
         std::all_of(ray.direction.begin(), ray.direction.end(), is_finite) && ray.direction != std::array<double, 3>{};
}

std::vector<Face_hit> hits_of(std::vector<Face_hit> parts, Ray_start start) {
  // Of each face those that begin first, and of these the side that comes first.
  std::sort(parts.begin(), parts.end(), [](const Face_hit& a, const Face_hit& b) {
    return std::tie(a.face, a.t, a.side) < std::tie(b.face, b.t, b.side);
  });
  std::vector<Face_hit> hits;
  for (Face_hit& part : parts) {
    const bool goes_on = !hits.empty() && hits.back().face == part.face && part.t <= hits.back().until;
    if (!goes_on) hits.push_back(std::move(part));
    else if (hits.back().until < part.until) hits.back().until = std::move(part.until);
  }
  if (start == Ray_start::open) std::erase_if(hits, [](const Face_hit& hit) { return hit.t == 0; });
  std::stable_sort(hits.begin(), hits.end(), [](const Face_hit& a, const Face_hit& b) { return a.t < b.t; });
  return hits;
}

std::vector<Face_hit> only_first(std::vector<Face_hit> hits) {
  while (!hits.empty() && hits.back().t != hits.front().t) hits.pop_back();
  return hits;
}

Exact_point point_at(const Exact_ray& ray, const Rational& t) {
  Exact_point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = ray.origin[k] + t * ray.direction[k];
  return p;
}

void check_direction(const Exact_ray& ray) {
  if (ray.direction[0] == 0 && ray.direction[1] == 0 && ray.direction[2] == 0)
    throw std::domain_error("a ray needs a direction");
}

}  // namespace sightline
