#pragma once
// What set operations and rounding stand on, in the cases that pairs of solids hardly ever bring about: bodies that are
// tiny in their scene, holes level with corners of their outline, the greatest float, planes of operands, bounds of
// coordinates of a thousand bits.

#include "support.h"

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/rounding.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/scene/planar_sites.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace fuzz {

/// A convex body counts as one, with a point inside, also where it is tiny in its scene: something is far away.
inline void try_small_bodies(generate::Random& random) {
  const Exact_point low = generate::lattice(random, 4);
  Exact_point high = low, far{0, 0, 0};
  for (Rational& x : high) x += generate::integer(random, 1, 4);
  far[random.below(3)] = generate::integer(random, 1, 9) * (1 << 20) * (random.chance(1, 2) ? 1 : -1);
  generate::Faces faces = generate::box(low, high);
  random.shuffle(faces);
  for (generate::Points& face : faces)
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random.below(face.size())), face.end());
  Exact_point beside = far, above = far;
  beside[0] += 1;
  beside[1] += 1;
  above[2] += 1;
  above[1] += 2;
  faces.push_back({far, beside, above});
  const Scene scene(generate::soup_of(faces));
  const Face_graph graph(scene);
  std::size_t convex = 0;
  for (const Face_graph::Component& component : graph.components()) {
    if (!component.inside) continue;
    ++convex;
    for (std::size_t k = 0; k < 3; ++k)
      require(low[k] < (*component.inside)[k] && (*component.inside)[k] < high[k], "the point is inside the box");
  }
  require(convex == 1, "a box is a convex body, however small it is in its scene");
}

/// A prism less a box that goes through it has a hole in both ends, also where corners of the outline are exactly as
/// high as the hole's: its volume is what the cross sections leave.
inline void try_holes_level_with_corners(generate::Random& random) {
  const long a = random.between(1, 3), b = a + random.between(1, 3), c = b + random.between(1, 3);
  const long tall = random.between(1, 5);
  const std::size_t up = random.below(3);
  const auto at = [&](long x, long y, long z) {
    Exact_point p;
    p[(up + 1) % 3] = x;
    p[(up + 2) % 3] = y;
    p[up] = z;
    return p;
  };
  // An octagon whose corners are on the lines through the hole's sides; counterclockwise seen from above.
  const generate::Points base{at(a, 0, tall), at(b, 0, tall), at(c, a, tall), at(c, b, tall),
                              at(b, c, tall), at(a, c, tall), at(0, b, tall), at(0, a, tall)};
  Polygon_soup prism;
  generate::add_prism(prism, base, at(0, 0, -tall));
  const std::array<Polygon_soup, 2> solids{prism, generate::soup_of(generate::box(at(a, a, -1), at(b, b, tall + 1)))};
  Set_options options;
  options.operation = Set_operation::subtract;
  const Set_result result = set_operation(Operands(solids), options);
  std::size_t holes = 0;
  for (Face_id f = 0; f < result.soup.face_count(); ++f) holes += result.soup.loop_count(f) - 1;
  require(holes == 2, "a way through a prism is a hole in both its ends");
  Rational twice;  // the octagon's area
  const std::size_t x = (up + 1) % 3, y = (up + 2) % 3;
  for (std::size_t k = 0; k < base.size(); ++k) {
    const Exact_point &p = base[k], &q = base[(k + 1) % base.size()];
    twice += p[x] * q[y] - p[y] * q[x];
  }
  require(volume(result.soup) == tall * (twice / 2 - Rational((b - a) * (b - a))),
          "a prism with a hole has the volume that its cross section has");
}

/// At the end of the floats: what is nearer to the greatest one than to 2^128 is rounded to it, all else is refused.
inline void try_greatest_float(generate::Random& random) {
  const Rational greatest = exact(static_cast<double>(std::numeric_limits<float>::max())),
                 halfway = generate::power_of_two(128) - generate::power_of_two(103);
  Rational far =
      halfway + generate::integer(random, -1, 1) * generate::power_of_two(static_cast<int>(random.below(100)));
  const bool is_held = far < halfway;
  if (random.chance(1, 2)) far = -far;
  const std::size_t k = random.below(3);
  generate::Points p(4);
  for (std::size_t i = 0; i < 3; ++i) p[i + 1][i] = 1;
  p[k + 1][k] = far;
  std::optional<Rounded_surface> near;
  const bool refused = is_refused<std::domain_error>([&] {
    near = rounded(generate::soup_of({{p[0], p[2], p[1]}, {p[0], p[1], p[3]}, {p[0], p[3], p[2]}, {p[1], p[2], p[3]}}),
                   Rounding::to_float);
  });
  require(refused != is_held,
          "a coordinate is refused iff it is nearer to 2^128 than to the greatest float, or halfway");
  if (refused) return;
  bool is_there = false;
  for (Point_id q = 0; q < near->soup.point_count(); ++q)
    is_there = is_there || near->soup.point(q)[k] == (far > 0 ? greatest : Rational(-greatest));
  require(is_there, "what is near the greatest float is rounded to it");
}

/// Operands begin with the planes of their faces, each once, and no others.
inline void try_planes_of_operands(generate::Random& random) {
  generate::Faces faces;
  for (std::size_t k = 1 + random.below(6); k > 0; --k)
    faces.push_back({generate::lattice(random, 3), generate::lattice(random, 3), generate::lattice(random, 3)});
  const std::vector<Polygon_soup> soups{generate::soup_of(faces)};
  std::set<std::array<Rational, 4>> planes;  // by rationals, whichever way they look
  for (const generate::Points& f : faces) {
    const Exact_point normal = cross(minus(f[1], f[0]), minus(f[2], f[0]));
    std::size_t k = 0;
    while (k < 3 && normal[k] == 0) ++k;
    if (k == 3) continue;  // without area
    const Rational unit = normal[k];
    planes.insert({normal[0] / unit, normal[1] / unit, normal[2] / unit, dot(normal, f[0]) / unit});
  }
  require(Operands(soups).planes().size() == planes.size(), "operands have the planes of their faces, each once");
}

/// Bounds of n / 2^shift hold it, and are one number where 53 bits and normal numbers do.
inline void try_planar_intervals(generate::Random& random) {
  const std::int64_t shift = random.between(1, 1300), power = random.between(0, shift - 1);
  Integer n = random.chance(1, 6) ? 0 : 1;
  const std::uint64_t more = random.chance(1, 2) ? random.below(60) : random.below(1000);
  for (std::uint64_t k = 0; k < more && n != 0; ++k) n = 2 * n + static_cast<unsigned long>(random.below(2));
  mpz_mul_2exp(n.get_mpz_t(), n.get_mpz_t(), static_cast<mp_bitcnt_t>(power));
  mpz_fdiv_r_2exp(n.get_mpz_t(), n.get_mpz_t(), static_cast<mp_bitcnt_t>(shift));
  if (random.chance(1, 2)) n = -n;
  Rational value = n;
  mpq_div_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(shift));
  const auto bounds = planar::interval(n, static_cast<long>(shift));
  require(exact(bounds.inf()) <= value && value <= exact(bounds.sup()), "bounds of a coordinate hold it");
  const bool is_short = n == 0 || bit_length(n) - mpz_scan1(n.get_mpz_t(), 0) <= 53;
  if (is_short && (n == 0 || abs(value) >= generate::power_of_two(-900)))
    require(bounds.inf() == bounds.sup(), "of a number that doubles hold, the bounds are itself");
}

inline void small_solids(std::string_view bytes) {
  static constexpr std::array<void (*)(generate::Random&), 5> laws{
      try_small_bodies, try_holes_level_with_corners, try_greatest_float, try_planes_of_operands, try_planar_intervals};
  ask_one_of(laws, bytes);
}

}  // namespace fuzz
