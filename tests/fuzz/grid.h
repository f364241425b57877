#pragma once
// The grid of a scene against the file's coordinates: it is the coarsest one, centred, and as wide as its numbers;
// points come back; planes and located points are where rationals have them, and doubles decide what they are certain
// of.

#include "support.h"

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

namespace fuzz {

/// Coordinates of one scene: near a place, in steps that all are, or most, or some.
struct Drawn_coordinates {
  explicit Drawn_coordinates(generate::Random& random) : random_(random) {
    static constexpr std::array widths{1, 2, 3, 13, 20, 26, 40, 52, 53, 62, 90, 200};
    bits_ = widths[random.below(widths.size())];
    static constexpr std::array divisors{1, 2, 3, 7, 64, 1000};
    step_ = Rational(1, divisors[random.below(divisors.size())]);
    if (random.chance(1, 4)) step_ *= static_cast<long>(random.between(2, 9));
    step_.canonicalize();
    for (Rational& x : place_) x = random.chance(1, 2) ? Rational(0) : whole(bits_ + 4) * step_;
    is_mixed_ = random.chance(1, 4);
  }
  Exact_point point() {
    Exact_point p;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = place_[k] + whole(bits_) * step_;
      if (is_mixed_ && random_.chance(1, 9)) p[k] += Rational(1, 3);
    }
    return p;
  }

 private:
  /// Of at most so many bits; often a power of two, or one beside it.
  Rational whole(int bits) {
    Integer n;
    const auto shift = static_cast<mp_bitcnt_t>(random_.below(static_cast<std::uint64_t>(bits)));
    if (random_.chance(1, 3)) {
      mpz_setbit(n.get_mpz_t(), shift);
      n += static_cast<long>(random_.between(-1, 1));
    } else {
      for (int k = 0; k < bits; k += 30) n = n * (1 << 30) + static_cast<long>(random_.below(1u << 30));
      mpz_fdiv_r_2exp(n.get_mpz_t(), n.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
    }
    return random_.chance(1, 2) ? Rational(n) : Rational(-n);
  }

  generate::Random& random_;
  int bits_;
  Rational step_;
  Exact_point place_;
  bool is_mixed_;
};

inline void check_points(const Scene& scene, const std::vector<Exact_point>& points) {
  const std::set<Exact_point> apart(points.begin(), points.end());
  require(scene.box() == exact_box(points), "a scene's box is that of its points");
  require(scene.points().size() == apart.size(), "equal points are one");
  std::set<Exact_point> there;
  std::array<Integer, 3> low, high;
  Integer most = 1, unit = 0, largest = 0;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) {
    there.insert(scene.position(p));
    for (std::size_t k = 0; k < 3; ++k) {
      const Integer x = scene.points().integer(p, static_cast<int>(k));
      if (p == 0) low[k] = high[k] = x;
      low[k] = std::min(low[k], x);
      high[k] = std::max(high[k], x);
      most = std::max(most, Integer(abs(x)));
      unit = gcd(unit, Integer(x - scene.points().integer(0, static_cast<int>(k))));
    }
  }
  require(there == apart, "points of a grid are those of the file");
  require(unit <= 1, "a grid is as coarse as can be");
  require(scene.points().bits() == static_cast<int>(bit_length(most)), "a grid is as wide as its largest number");
  for (std::size_t k = 0; k < 3; ++k)
    require(abs(Integer(low[k] + high[k])) <= 2 * scene.points().divisor() + 1, "a grid is centred");
  Integer scale = 1;
  for (const Exact_point& p : points)
    for (const Rational& x : p) scale = lcm(scale, x.get_den());
  for (const Exact_point& p : points)
    for (const Rational& x : p) largest = std::max(largest, Integer(abs(Integer(x * scale))));
  require(scene.bits() == static_cast<int>(bit_length(largest)), "a scene has the bits of its largest coordinate");
  require(scene.scale_bits() == static_cast<int>(bit_length(scale)) - 1, "a scene has its scale's bits");
}

/// A point of the file's coordinates against a piece's plane, in front of it, behind it and on it.
inline void check_located(const Scene& scene, const Exact_point& p, Plane plane) {
  const Predicates predicates = scene.predicates();
  const std::array<Rational, 4> h = scene.file_coefficients(plane);
  const int expected = sgn(Rational(h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3]));
  const Located_point q = scene.locate(p);
  require(q.w > 0 && scene.position({q.x, q.y, q.z, q.w}) == p, "a point is where it is located");
  Predicate_counts counts;
  const CGAL::Uncertain<Sign> filtered = predicates.side_filtered(q, plane);
  require(static_cast<int>(predicates.side(q, plane, counts)) == expected, "a located point's side is right");
  require(!CGAL::is_certain(filtered) || static_cast<int>(filtered.inf()) == expected,
          "doubles are right of a located point where they are certain");
  require(counts.total() == 1 && (counts.filtered == 1) == CGAL::is_certain(filtered),
          "doubles decide what they are certain of");
}

/// A point by numerators and a denominator is that of their ratios; its denominator is that of lowest terms.
inline void check_ratios(generate::Random& random) {
  static constexpr std::array denominators{1, 2, 8, 64, 5, 10, 40, 125, 3, 6, 7, 96, 1000};
  const std::int64_t denominator = denominators[random.below(denominators.size())];
  std::array<std::int64_t, 3> numerators;
  for (std::int64_t& n : numerators) n = random.between(-12, 12) * (random.chance(1, 2) ? 1 : 1 << random.below(8));
  Polygon_soup soup;
  soup.add_point(numerators, denominator);
  Integer common = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational expected = generate::ratio(numerators[k], denominator);
    require(soup.point(0)[k] == expected, "a ratio is what it says");
    common = lcm(common, expected.get_den());
  }
  require(soup.coordinates.common_denominator() == common, "a ratio is in lowest terms");
}

inline void grid(std::string_view bytes) {
  Bytes from(bytes);
  generate::Random random(from.word());
  check_ratios(random);
  Drawn_coordinates drawn(random);
  std::vector<Exact_point> points;
  for (std::size_t k = 3 * (1 + random.below(3)); k > 0; --k)
    points.push_back(!points.empty() && random.chance(1, 8) ? points[random.below(points.size())] : drawn.point());
  Polygon_soup soup;
  for (const Exact_point& p : points) soup.add_point(p[0], p[1], p[2]);
  for (Point_id k = 0; k < points.size(); k += 3) soup.add_face({k, k + 1, k + 2});
  const Scene scene(soup);
  check_points(scene, points);
  for (const Piece& piece : scene.pieces()) {
    const std::array<Rational, 4> h = scene.file_coefficients(piece.support);
    const Exact_point& corner = points[3 * piece.face];
    require(h[0] * corner[0] + h[1] * corner[1] + h[2] * corner[2] + h[3] == 0, "a face's plane holds its corners");
    const Exact_point& a = points[random.below(points.size())];
    Exact_point middle, beside = a, on = corner;  // the last one in the face's plane
    for (std::size_t k = 0; k < 3; ++k) {
      middle[k] = (a[k] + 2 * corner[k]) / 3;
      on[k] += (points[3 * piece.face + 1][k] - corner[k]) / 7 + (points[3 * piece.face + 2][k] - corner[k]) * 5 / 3;
    }
    beside[random.below(3)] += generate::ratio(1, 1 + static_cast<std::int64_t>(random.below(1000)));
    Exact_point beyond = a;  // of doubles, along some axis or all
    const std::uint64_t axes = 1 + random.below(7);
    for (std::size_t k = 0; k < 3; ++k)
      if ((axes >> k) % 2 != 0)
        beyond[k] +=
            generate::integer(random, -3, 3) * generate::power_of_two(static_cast<int>(random.between(990, 1100)));
    for (const Exact_point& p : {a, middle, beside, on, beyond, drawn.point()}) check_located(scene, p, piece.support);
  }
}

}  // namespace fuzz
