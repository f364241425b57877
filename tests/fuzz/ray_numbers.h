#pragma once
// Rays by themselves, in numbers at the bounds of what they may be: from far away, in large scenes, past corners and
// through edges in wide numbers, along faces that go through themselves. Against the definition, or the exact numbers
// of the same ray.

#include "soups.h"
#include "support.h"

#include <sightline/algorithms/rays/tracer.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/trace.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace fuzz {

// ---- From far away

/// A ray at the end of what doubles hold, in the unit of its scene, meets what it meets.
inline void try_rays_where_doubles_end(generate::Random& random) {
  Polygon_soup soup;
  const int about = static_cast<int>(random.between(-560, 0));
  const double wide = std::ldexp(1.0, about), high = std::ldexp(1.0, about - static_cast<int>(random.between(1, 9)));
  const Point_id a = soup.add_point(-wide, wide, -high), b = soup.add_point(wide, -wide, -high),
                 c = soup.add_point(high, std::ldexp(1.0, about - static_cast<int>(random.between(40, 70))), high);
  soup.add_face({a, b, c});
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  const Rational far = (1 + generate::integer(random, 0, 15) / 16) *
                       generate::power_of_two(static_cast<int>(random.between(1016, 1025)));
  const long way = random.chance(1, 8) ? 1 : -1;
  Exact_ray ray;
  for (std::size_t k = 0; k < 3; ++k) {
    ray.origin[k] = far * exact(wide);
    ray.direction[k] = way;
  }
  Ray_counters counters;
  require(tracer.all(ray, Ray_start::open, counters) == harness::hits_by_definition(soup, scene, ray, Ray_start::open),
          "a ray from far away meets what it meets by definition");
}

/// A ray in doubles past the edge of a square, or on it, in a scene that is up to 2^160 times as large, and beyond
/// doubles: what is said of it is what is said of its exact numbers.
inline void try_rays_in_large_scenes(generate::Random& random) {
  const int power = static_cast<int>(random.between(-30, 1018));
  const double half = std::ldexp(static_cast<double>(random.between(1, 7)), power);
  const Rational large =
      generate::integer(random, 1, 7) * generate::power_of_two(power + static_cast<int>(random.between(0, 160)));
  Polygon_soup soup;
  const auto corner = [&](const Rational& x, const Rational& y, const Rational& z) { return soup.add_point(x, y, z); };
  const Rational s = exact(half);
  soup.add_face(std::vector<Point_id>{corner(-s, -s, 0), corner(s, -s, 0), corner(s, s, 0), corner(-s, s, 0)});
  for (const Rational& x : {Rational(-large), large})
    soup.add_face(std::vector<Point_id>{corner(x, -large, -large), corner(x, large, -large), corner(x, -large, large)});
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  const double step = std::ldexp(static_cast<double>(random.between(-1, 1)), -static_cast<int>(random.between(8, 52)));
  Double_ray ray;
  ray.origin = {half * (1 + step), half * std::ldexp(static_cast<double>(random.between(-4, 4)), -2), -half};
  ray.direction = {0, 0, std::ldexp(1.0, static_cast<int>(random.between(-600, 600)))};
  Ray_counters counters;
  const Ray_start start = random.chance(1, 2) ? Ray_start::open : Ray_start::closed;
  const std::vector<Face_hit> first = tracer.first(ray.exact(), start, counters);
  const Ray_tracer::Nearest nearest = tracer.nearest(ray, start, counters);
  require(harness::is_first(nearest, first), "a ray in doubles meets what it meets first, between its bounds");
}

/// Faces with a corner in common, and a ray in doubles from far away through an edge of one of them from there and,
/// behind that or before it by less than doubles tell, an edge of another one.
inline void try_rays_past_a_corner(generate::Random& random) {
  Exact_point along = generate::lattice(random, 3), way = generate::lattice(random, 3);
  const bool is_far = random.chance(1, 2);  // so that doubles do not tell what is met first
  const int apart = static_cast<int>(random.between(is_far ? 20 : 1, 44)),
            away = static_cast<int>(random.between(is_far ? 30 : 8, 44));
  const bool is_skew = random.chance(1, 2);  // all edges begin at the corner
  if (const std::size_t axis = random.below(6); axis < 3 && !is_skew) along[axis] = way[axis] = 0;
  if (is_zero(cross(along, way))) return;
  const Rational step = generate::power_of_two(-apart), share = generate::integer(random, 0, 4);
  generate::Faces faces;
  for (std::uint64_t n = 2 + random.below(3); n > 0; --n) {
    Exact_point edge = along, beside = generate::lattice(random, 3);
    for (std::size_t k = 0; k < 3; ++k) edge[k] += generate::integer(random, -2, 2) * step * way[k];
    for (Rational& x : edge) x *= 4;
    faces.push_back({{0, 0, 0}, edge, beside});
    if (!spans_a_plane(faces.back())) return;
    std::rotate(faces.back().begin(), faces.back().begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                faces.back().end());
    if (!is_skew && random.chance(1, 2)) std::reverse(faces.back().begin(), faces.back().end());
  }
  const Scene scene(generate::soup_of(faces));
  const Ray_tracer tracer(scene);
  Double_ray ray;
  for (std::size_t k = 0; k < 3; ++k) {
    ray.origin[k] = nearest_double(Rational(share * along[k] - generate::power_of_two(away) * way[k]));
    ray.direction[k] = nearest_double(way[k]);
  }
  Ray_counters counters;
  const std::vector<Face_hit> first = tracer.first(ray.exact(), Ray_start::closed, counters);
  require(harness::is_first(tracer.nearest(ray, Ray_start::closed, counters), first),
          "a ray in doubles past a corner of many faces meets what it meets first, between its bounds");
}

/// A ray hardly beside an edge or through it, in numbers that are wide where the scene's are not: origins and
/// directions of 53 bits, and origins next to the scene's middle, of small numerators and large denominators.
inline void try_wide_rays(generate::Random& random) {
  generate::Faces faces;
  for (std::uint64_t n = 1 + random.below(3); n > 0; --n) {
    const Exact_point p = generate::lattice(random, 9);
    const bool through_middle = random.chance(1, 2);
    faces.push_back(
        {p, through_middle ? minus({0, 0, 0}, p) : generate::lattice(random, 9), generate::lattice(random, 9)});
    faces.push_back({generate::lattice(random, 9), {9, 9, 9}, {-9, -9, -9}});
    for (std::size_t k = 0; k < 2; ++k)
      if (!spans_a_plane(faces[faces.size() - 1 - k])) return;
  }
  const Polygon_soup soup = generate::soup_of(faces);
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  const generate::Points& face = faces[2 * random.below(faces.size() / 2)];
  const Exact_point along_edge = minus(face[1], face[0]),
                    on_edge = generate::along(face[0], generate::integer(random, 0, 64) / 64, along_edge);
  const Ray_start start = random.chance(1, 2) ? Ray_start::open : Ray_start::closed;
  Ray_counters counters;
  const auto is_right = [&](const Exact_ray& ray) {
    return tracer.all(ray, start, counters) == harness::hits_by_definition(soup, scene, ray, start);
  };
  if (random.chance(1, 2)) {
    // 1. Doubles: a direction, or an origin, of any bits.
    Double_ray ray;
    const bool from_somewhere = random.chance(1, 2);
    const int bits = static_cast<int>(random.between(10, 52));
    const Rational length = from_somewhere && random.chance(1, 2) ? Rational(1, 3) : Rational(1);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto wide = static_cast<double>(random.between(-(std::int64_t{1} << bits), std::int64_t{1} << bits));
      const double number = std::ldexp(wide, static_cast<int>(random.between(0, 4)) - bits);
      (from_somewhere ? ray.origin : ray.direction)[k] = number;
      (from_somewhere ? ray.direction : ray.origin)[k] =
          nearest_double(Rational(length * (on_edge[k] - exact(number))));
    }
    if (!is_ray(ray)) return;
    require(harness::is_first(tracer.nearest(ray, start, counters), tracer.first(ray.exact(), start, counters)),
            "a ray in wide doubles meets what it meets first, between its bounds");
    require(is_right(ray.exact()), "a ray of wide doubles meets what it meets by definition");
    return;
  }
  // 2. From next to the middle, to an edge, or to a place of one that is there.
  const Rational step =
      random.chance(1, 2)
          ? Rational(generate::power_of_two(
                -static_cast<int>(random.chance(1, 2) ? random.between(20, 70) : random.between(34, 48))))
          : Rational(1, 3 + static_cast<unsigned long>(random.below(std::uint64_t{1} << random.between(20, 60))));
  Exact_ray ray;
  if (random.chance(1, 2)) {
    ray.origin = generate::along({0, 0, 0}, step, generate::lattice(random, 3));
    ray.direction = minus(on_edge, ray.origin);
  } else {
    const std::int64_t reach = random.chance(1, 4) ? 5 : std::int64_t{1} << random.between(30, 40);
    ray.direction = generate::lattice(random, reach);
    ray.origin = generate::along({0, 0, 0}, step * generate::integer(random, -9, 9), along_edge);
    if (reach == 5) ray.origin = generate::along(ray.origin, step * generate::integer(random, -9, 0), ray.direction);
  }
  if (is_zero(ray.direction)) return;
  require(is_right(ray), "a ray from next to the middle meets what it meets by definition");
}

/// A face that no projection unfolds, fanned from a corner, with triangles that go through each other; a ray that
/// begins along one of them: what it meets first is the first of all that it meets.
inline void try_rays_along_a_fan(generate::Random& random) {
  const Exact_point u = generate::lattice(random, 3), v = generate::lattice(random, 3),
                    w = generate::lattice(random, 3), apex = generate::lattice(random, 3);
  if (dot(u, cross(v, w)) == 0) return;
  const auto corner = [&](long side, const Exact_point& way) {
    return generate::along(apex, generate::integer(random, 1, 3), generate::along(u, side, way));
  };
  const Exact_point p = corner(-1, v), q = corner(1, v), r = corner(1, w), s = corner(-1, w);
  generate::Faces faces{generate::either_way({apex, p, q, r, s}, random)};
  for (std::uint64_t others = random.below(3); others > 0; --others) {
    faces.push_back({generate::lattice(random, 12), generate::lattice(random, 12), generate::lattice(random, 12)});
    if (!spans_a_plane(faces.back())) return;
  }
  generate::shuffle(faces, random);
  const Scene scene(generate::soup_of(faces));
  const Ray_tracer tracer(scene);
  const Rational near = generate::integer(random, 1, 7) / 8, share = generate::integer(random, 1, 7) / 8;
  Exact_ray ray;
  ray.origin = generate::along(apex, near, minus(generate::along(p, share, minus(q, p)), apex));
  ray.direction = generate::along(minus(q, p), generate::integer(random, -4, 4) / 4, u);
  if (random.chance(1, 4)) ray.direction = minus({0, 0, 0}, ray.direction);
  if (is_zero(ray.direction)) return;
  const Ray_start start = random.chance(3, 4) ? Ray_start::open : Ray_start::closed;
  Ray_counters counters;
  std::vector<Face_hit> all = tracer.all(ray, start, counters);
  std::erase_if(all, [&, first = all.empty() ? Rational(0) : all[0].t](const Face_hit& hit) { return hit.t > first; });
  require(tracer.first(ray, start, counters) == all, "a ray along a fan meets first what it meets first of all");
  Double_ray doubles;
  for (std::size_t k = 0; k < 3; ++k) {
    doubles.origin[k] = nearest_double(ray.origin[k]);
    doubles.direction[k] = nearest_double(ray.direction[k]);
  }
  if (doubles.exact().origin == ray.origin && doubles.exact().direction == ray.direction)
    require(harness::is_first(tracer.nearest(doubles, start, counters), all), "and so does one in doubles");
}

inline void ray_numbers(std::string_view bytes) {
  static constexpr std::array<void (*)(generate::Random&), 6> laws{
      try_rays_where_doubles_end, try_rays_in_large_scenes, try_rays_past_a_corner, try_wide_rays, try_wide_rays,
      try_rays_along_a_fan};
  ask_one_of(laws, bytes);
}

}  // namespace fuzz
