#pragma once
// What is at the limits of numbers, and what is told of progress: wide faces, rays from where doubles end, images and
// certificates for which somebody waits.

#include "any_case.h"
#include "refusals.h"
#include "support.h"

#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/rays/ray.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/harness/generate/pixel_views.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/harness/laws/trace.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace fuzz {

/// Parallelograms whose normals are as wide as words, planar or not by one unit.
inline void try_wide_faces(generate::Random& random) {
  const int bits = static_cast<int>(random.between(20, 45));
  const auto drawn = [&]() -> Exact_point {
    Exact_point p;
    for (Rational& x : p) x = Rational(random.between(-(std::int64_t{1} << bits), std::int64_t{1} << bits));
    return p;
  };
  const Exact_point at = drawn(), u = drawn(), v = drawn(), n = cross(u, v);
  const bool is_planar = random.chance(1, 2);
  Polygon_soup soup;
  for (const auto& [a, b] : {std::array{0, 0}, std::array{1, 0}, std::array{1, 1}, std::array{0, 1}}) {
    Exact_point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = at[k] + a * u[k] + b * v[k];
    if (a == 1 && b == 1 && !is_planar) p[random.below(3)] += 1;
    soup.add_point(p[0], p[1], p[2]);
  }
  soup.add_face({0, 1, 2, 3});
  const Scene scene(soup);
  const Exact_point from = soup.point(0);
  const bool is_flat = dot(n, minus(soup.point(2), from)) == 0;
  require(!is_planar || is_flat, "a parallelogram is planar");
  if (n == Exact_point{0, 0, 0}) return;
  require((scene.counters().non_planar == 1) == !is_flat, "a face is planar iff its corners are");
  if (!is_flat) return;
  require(scene.pieces().size() == 1, "a parallelogram is one piece");
  const Plane plane = scene.pieces()[0].support;
  Exact_point known;
  for (int k = 0; k < 3; ++k) known[static_cast<std::size_t>(k)] = scene.planes().integer(plane.id(), k);
  require(cross(known, n) == Exact_point{0, 0, 0}, "a piece's plane has its normal");
  require((dot(known, n) < 0) == plane.flipped(), "a piece's plane has its sense");
}

/// Asks a tracer for what a ray meets, exactly and in doubles.
inline void require_met(const Polygon_soup& soup, const Scene& scene, const Ray_tracer& tracer, const Exact_ray& ray,
                        Ray_start start) {
  Ray_counters counters;
  const std::vector<Face_hit> all = harness::hits_by_definition(soup, scene, ray, start);
  require(tracer.all(ray, start, counters) == all, "a ray meets what it does by the definition");
  require(tracer.first(ray, start, counters) == harness::first_by_definition(soup, scene, ray, start),
          "a ray meets first what it does by the definition");
  const Double_ray doubles = in_doubles(ray);
  if (!is_ray(doubles)) return;
  const std::vector<Face_hit> hits = harness::first_by_definition(soup, scene, doubles.exact(), start);
  const Ray_tracer::Nearest near = tracer.nearest(doubles, start, counters);
  require((near.face == Ray_tracer::Nearest::nothing) == hits.empty(), "doubles meet something iff it is there");
  if (hits.empty()) return;
  require(near.face == hits[0].face && near.side == hits[0].side && near.tied == (hits.size() > 1),
          "doubles meet what is there");
  require((!std::isfinite(near.low) || exact(near.low) <= hits[0].t) &&
              (!std::isfinite(near.high) || hits[0].t <= exact(near.high)),
          "doubles know where it is");
}

/// Triangles of whole numbers, short ones or wider than words, of which an edge passes an axis as closely as these can,
/// and rays along it that begin at a fraction of any length: what of them fits into words, and what does not.
inline void try_fine_rays(generate::Random& random) {
  const std::size_t axis = random.below(3), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const std::int64_t far = std::int64_t{1} << random.between(4, 50);
  const Rational wide = random.chance(1, 3) ? generate::power_of_two(static_cast<int>(random.between(45, 60))) : 0;
  const auto any = [&] {  // at times beyond words
    const Rational x = static_cast<long>(random.between(-far, far));
    return wide == 0 ? x : Rational(x * wide + static_cast<long>(random.between(-far, far)));
  };
  const auto little = [&] { return Rational(static_cast<long>(random.between(-1, 1))); };
  Polygon_soup soup;
  for (Point_id k = 0; k < 9; k += 3) {
    std::array<Exact_point, 3> corners;
    for (Exact_point& p : corners)
      for (Rational& x : p) x = any();
    corners[1][u] = little() - corners[0][u];
    corners[1][v] = little() - corners[0][v];
    for (const Exact_point& p : corners) soup.add_point(p[0], p[1], p[2]);
    soup.add_face({k, k + 1, k + 2});
  }
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  for (std::size_t turn = 0; turn < 4; ++turn) {
    Exact_ray ray{{0, 0, 0}, {0, 0, 0}};
    const auto bits = static_cast<int>(random.between(0, 62));
    for (Rational& x : ray.origin)
      if (random.chance(1, 2)) x = static_cast<long>(random.between(-64, 64)) * generate::power_of_two(-bits);
    ray.direction[axis] = random.chance(1, 2) ? 1 : -1;
    require_met(soup, scene, tracer, ray, random.chance(1, 2) ? Ray_start::open : Ray_start::closed);
  }
}

/// Few triangles, as large or as small as doubles are or beyond that, and rays to them of any length from anywhere.
inline void try_far_rays(generate::Random& random) {
  const auto power = [&]() -> Rational {
    const auto e = static_cast<int>(random.chance(1, 3) ? 0 : random.between(-1300, 1300));
    Rational x = 1;
    if (e > 0) mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(e));
    else mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-e));
    return x;
  };
  Rational size = power(), wide = 1;
  if (random.chance(1, 6)) {  // to where doubles end, and a triangle beyond that
    size = static_cast<long>(random.between(1, 7));
    mpq_mul_2exp(size.get_mpq_t(), size.get_mpq_t(), static_cast<mp_bitcnt_t>(random.between(1010, 1019)));
    mpq_mul_2exp(wide.get_mpq_t(), wide.get_mpq_t(), static_cast<mp_bitcnt_t>(random.between(30, 54)));
  }
  Polygon_soup soup;
  for (std::size_t k = 0; k < 9; ++k) {
    Exact_point p;
    for (Rational& x : p) x = size * Rational(random.between(-8, 8));
    if (k > 5)
      for (Rational& x : p) x *= wide;
    soup.add_point(p[0], p[1], p[2]);
  }
  soup.add_face({0, 1, 2});
  soup.add_face({3, 4, 5});
  soup.add_face({6, 7, 8});
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  Ray_counters counters;
  for (std::size_t turn = 0; turn < 4; ++turn) {
    // To a point of a triangle, or near it.
    Exact_ray ray{{0, 0, 0}, {0, 0, 0}};
    const auto first = static_cast<Point_id>(3 * random.below(3));
    const Rational step = power(), away = random.chance(1, 2) ? Rational(1) : power();
    const bool misses = random.chance(1, 4);
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational to = (soup.point(first)[k] + soup.point(first + 1)[k] + 2 * soup.point(first + 2)[k]) / 4 +
                          (misses ? Rational(size * random.between(-20, 20)) : Rational(0));
      const Rational way = Rational(random.between(-3, 3));
      ray.origin[k] = to - way * away * size;
      ray.direction[k] = way * step;
    }
    const Ray_start start = random.chance(1, 2) ? Ray_start::open : Ray_start::closed;
    if (ray.direction == Exact_point{0, 0, 0}) {
      require(is_refused<std::domain_error>([&] { tracer.first(ray, start, counters); }),
              "a ray without a direction is refused");
      require(is_refused<std::domain_error>([&] {
                tracer.nearest({{1, 2, 3}, {0, 0, 0}}, start, counters);
              }),
              "a ray in doubles without a direction is refused");
      continue;
    }
    require_met(soup, scene, tracer, ray, start);
  }
}

/// The same to whoever waits.
inline void try_told(generate::Random& random) {
  constexpr std::size_t most_faces = 24;
  const harness::Posed_scene posed = harness::make(any_case(random));
  if (posed.soup.face_count() > most_faces) return;
  const Scene scene(posed.soup);
  if (scene.pieces().empty()) return;
  std::atomic<std::size_t> told{0};
  std::atomic<bool> is_beyond{false};
  const auto progress = [&](std::size_t done, std::size_t all) {
    ++told;
    if (done > all) is_beyond = true;
  };
  if (random.chance(1, 2)) {
    const Exact_view view(scene, posed.eye);
    Visible_options options;
    options.threads = 1;
    const auto surface = visible_surface(view, Piece_boxes(scene), options);
    std::ostringstream alone, listened;
    write_visible_certificate(alone, view, surface, posed.eye);
    write_visible_certificate(listened, view, surface, posed.eye, {}, progress);
    require(alone.str() == listened.str() && told > 0, "a certificate is the same to whoever waits for it");
  } else {
    const Pixel_view pixels = generate::any_pixel_view(posed.soup, posed.eye, random);
    if (pixels.width * pixels.height > 4096) return;
    constexpr std::array kernels{Image_kernel::float_numbers, Image_kernel::double_numbers, Image_kernel::exact};
    constexpr std::array keys{Painter_key::nearest, Painter_key::farthest, Painter_key::mean};
    const Image_kernel kernel = kernels[random.below(3)];
    const Painter_key key = keys[random.below(3)];
    Image_options options;
    options.threads = 1;
    options.progress = progress;
    const auto alone = heedless_order(scene, pixels, key, kernel),
               listened = heedless_order(scene, pixels, key, kernel, options);
    require(alone.size() == listened.size() && alone.size() == scene.pieces().size(), "each piece is painted");
    for (std::size_t k = 0; k < alone.size(); ++k)
      require(alone[k].piece == listened[k].piece, "an order is the same to whoever waits for it");
    require(paint(alone, pixels, kernel).pieces == paint(listened, pixels, kernel, options).pieces,
            "an image is the same to whoever waits for it");
  }
  require(!is_beyond, "nobody is told of more than all");
}

inline void limits(std::string_view bytes) {
  Bytes from(bytes);
  const std::size_t kind = from.below(4);
  generate::Random random(from.word());
  if (kind == 0) try_wide_faces(random);
  else if (kind == 3) try_fine_rays(random);
  else if (kind == 1) try_far_rays(random);
  else try_told(random);
}

}  // namespace fuzz
