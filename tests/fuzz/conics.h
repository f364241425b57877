#pragma once
// Curves of degree two in a plane: of which lines they consist, and where they are over a place.

#include "quadratic_roots.h"
#include "support.h"

#include <sightline/algorithms/weak_visibility/partition/curve_arrangement.h>
#include <sightline/algorithms/weak_visibility/partition/plane_chart.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace fuzz {

/// c[0] + c[1] x + c[2] y + c[3] x^2 + c[4] x y + c[5] y^2, or of a line the first three.
using Conic = std::array<Integer, 6>;
using Plane_line = std::array<Integer, 3>;

inline Conic product_of(const Plane_line& f, const Plane_line& g) {
  return {Integer(f[0] * g[0]), Integer(f[0] * g[1] + f[1] * g[0]), Integer(f[0] * g[2] + f[2] * g[0]),
          Integer(f[1] * g[1]), Integer(f[1] * g[2] + f[2] * g[1]), Integer(f[2] * g[2])};
}

/// Without a common factor, the last that is not zero positive.
inline Conic canonical_conic(Conic c) {
  Integer common = 0;
  for (const Integer& x : c) common = gcd(common, x);
  if (common == 0) return c;
  const auto last = std::find_if(c.rbegin(), c.rend(), [](const Integer& x) { return x != 0; });
  if (*last < 0) common = -common;
  for (Integer& x : c) x /= common;
  return c;
}
inline Conic canonical_line(const Plane_line& line) { return canonical_conic({line[0], line[1], line[2], 0, 0, 0}); }

/// Of the form of three variables that is twice the conic's, ((a b e) (b d f) (e f g)).
inline Integer determinant_of(const Conic& c) {
  const Integer a = 2 * c[3], b = c[4], d = 2 * c[5], e = c[1], f = c[2], g = 2 * c[0];
  return a * (d * g - f * f) - b * (b * g - f * e) + e * (b * f - d * e);
}
inline bool is_smooth(const Conic& c) { return determinant_of(c) != 0; }
/// Whether that form has one strict sign: then the conic has no real point.
inline bool is_definite(const Conic& c) {
  const Integer minor = 4 * c[3] * c[5] - c[4] * c[4];
  return sgn(minor) > 0 && sgn(c[3]) * sgn(determinant_of(c)) > 0;
}

/// What must be found of f g, of f^2 - n g^2, and of any conic that is smooth.
struct Known_conic {
  Conic conic;
  std::vector<Conic> parts;
};
inline std::optional<Known_conic> any_conic(Bytes& from) {
  const auto any = [&] { return Integer(static_cast<long>(from.below(11)) - 5); };
  Plane_line f, g;
  for (Integer& x : f) x = any();
  for (Integer& x : g) x = any();
  if (from.below(4) == 0) g = {any(), f[1], f[2]};  // parallel, or the same
  if (from.below(6) == 0) f[2] = g[2] = 0;          // upright
  const auto is_line = [](const Plane_line& line) { return line[1] != 0 || line[2] != 0; };
  const Integer cross_xy = f[1] * g[2] - f[2] * g[1], cross_x = f[0] * g[1] - f[1] * g[0],
                cross_y = f[0] * g[2] - f[2] * g[0];
  const bool is_one = cross_xy == 0 && cross_x == 0 && cross_y == 0;  // multiples of each other
  Known_conic known;
  switch (from.below(3)) {
    case 0: {
      known.conic = product_of(f, g);
      if (known.conic == Conic{}) return known;
      for (const Plane_line& line : {f, g})
        if (is_line(line)) known.parts.push_back(canonical_line(line));
      break;
    }
    case 1: {
      const std::array<long, 6> factors{2, 3, 6, -1, -2, -4};
      const long n = factors[from.below(factors.size())];
      known.conic = product_of(f, f);
      const Conic other = product_of(g, g);
      for (std::size_t k = 0; k < 6; ++k) known.conic[k] -= n * other[k];
      if (known.conic == Conic{}) return known;
      if (is_one) {  // a multiple of one line's square, or of 1
        for (const Plane_line& line : {f, g})
          if (is_line(line)) known.parts = {canonical_line(line)};
      } else if (n > 0 && (is_line(f) || is_line(g))) {
        known.parts = {canonical_conic(known.conic)};
      }
      break;
    }
    default: {
      for (Integer& x : known.conic) x = any();
      if (!is_smooth(known.conic)) return std::nullopt;
      if (!is_definite(known.conic)) known.parts = {canonical_conic(known.conic)};
    }
  }
  const long scale = static_cast<long>(from.below(5)) - 2;
  if (scale != 0)
    for (Integer& x : known.conic) x *= scale;
  return known;
}

/// A curve may meet a rectangle about a place of it, and does not where its value is far from 0.
inline void check_meeting(const Conic& c, Bytes& from) {
  const long x = static_cast<long>(from.below(17)) - 8, y = static_cast<long>(from.below(17)) - 8;
  const double half = std::ldexp(1.0, -static_cast<int>(from.below(30)));
  const Chart_box box{static_cast<double>(x) - half, static_cast<double>(x) + half, static_cast<double>(y) - half,
                      static_cast<double>(y) + half};
  Plane_curve through{c};
  through.c[0] -= c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y;
  require(may_meet(through, box), "a curve through the middle of a rectangle may meet it");
  Integer sum = 1;
  for (const Integer& n : c) sum += abs(n);
  Plane_curve beside = through;
  beside.c[0] += 1000 * sum;  // the rest changes by less than 40 times their sum
  require(!may_meet(beside, box), "a curve far from a rectangle does not meet it");
}

/// Areas below its arcs are known closely, and more closely than in two parts.
inline void check_areas(const Conic& c) {
  constexpr double close = 0x1p-14, far = 4;  // of a square of 64; at upright tangents 2^-21 of it is left
  const std::array<Plane_curve, 1> curves{Plane_curve{c}};
  const Curve_arrangement found(curves, {-far, far, -far, far});
  for (std::size_t s = 0; s < found.slabs().size(); ++s)
    for (const Curve_arrangement::Arc& arc : found.slabs()[s].arcs) {
      const Bounded area = found.area_below(arc, s), coarse = found.area_below(arc, s, 1);
      require(area.low <= coarse.high && coarse.low <= area.high, "bounds of an area have a number in common");
      require(area.high - area.low < close, "an area below an arc is known closely");
    }
}

/// y^2 + 2^k y + n x = 2^(k - 1), or turned over: hardly bent in the square, where its bounds are as near as for a
/// line.
inline void try_flat_conic(Bytes& from) {
  const auto k = static_cast<mp_bitcnt_t>(20 + from.below(41));
  const long slope = 1 + static_cast<long>(from.below(256));
  const bool is_turned = from.below(2) == 1;
  const Integer one = Integer(1) << k, half = Integer(1) << (k - 1);
  const std::array<Plane_curve, 1> curves{
      Plane_curve{{is_turned ? half : Integer(-half), slope, is_turned ? Integer(-one) : one, 0, 0, 1}}};
  const Curve_arrangement found(curves, {0, 1, 0, 1});
  require(found.slabs().size() == 1 && found.slabs()[0].arcs.size() == 1, "a flat conic has one arc in a square");
  const Curve_arrangement::Arc arc = found.slabs()[0].arcs[0];
  for (const std::size_t limit : {0, 1}) {
    const Bounded y = found.value(arc, limit);
    const Rational x(static_cast<long>(limit));
    require(curves[0].sign(x, exact(y.low)) * curves[0].sign(x, exact(y.high)) <= 0, "a value is between its bounds");
    require(y.high - y.low < 0x1p-40, "bounds of a value are as near as doubles tell");
  }
}

inline void conics(std::string_view bytes) {
  Bytes from(bytes);
  if (from.below(8) == 0) return try_flat_conic(from);
  std::optional<Known_conic> known = any_conic(from);
  if (!known) return;

  // 1. Of what it consists.
  std::vector<Conic> found;
  for (const Plane_curve& part : components({known->conic})) found.push_back(part.c);
  std::sort(found.begin(), found.end());
  std::sort(known->parts.begin(), known->parts.end());
  known->parts.erase(std::unique(known->parts.begin(), known->parts.end()), known->parts.end());
  require(found == known->parts, "a curve consists of the lines that it is the product of, or is one");

  // 2. Where it is: by its value there, and by how many values of y there are.
  const auto number = [&]() -> Rational { return Rational(from.integer(3)) / (1 + static_cast<long>(from.below(4))); };
  for (const Conic& c : found) {
    check_meeting(c, from);
    if (from.below(32) == 0) check_areas(c);  // which takes as long as a hundred others
    const Plane_curve curve{c};
    const Rational x = number(), y = number();
    const auto value = [&](const Rational& at) {
      return Rational(c[0] + c[1] * x + c[2] * at + c[3] * x * x + c[4] * x * at + c[5] * at * at);
    };
    require(curve.sign(x, y) == sgn(value(y)), "a curve's sign is that of its value");
    const Rational linear = c[2] + c[4] * x, constant = value(0), square = linear * linear - 4 * c[5] * constant;
    const bool is_quadratic = c[5] != 0;
    const int count = is_quadratic ? 1 + sgn(square) : linear != 0 ? 1 : 0;
    const std::optional<Quadratic_root> low = curve.height(x, false), high = curve.height(x, true);
    require(low.has_value() == (count > 0) && high.has_value() == (is_quadratic && count > 0),
            "a curve has as many places over one as its equation has roots");
    require(!low || !high || (count == 1 ? *low == *high : *low < *high), "a curve's lower place is the lower one");
    // Multiplied by the denominators, the equation is one of integers, whose roots other arithmetic finds.
    Quadratic equation;
    const std::array<Rational, 3> factors{constant, linear, Rational(c[5])};
    Integer common = 1;
    for (const Rational& factor : factors) common = lcm(common, factor.get_den());
    int widest = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      equation.c[k] = Rational(factors[k] * common).get_num();
      widest = std::max(widest, static_cast<int>(bit_length(equation.c[k])));
    }
    const unsigned long places = places_for(widest);
    std::vector<Narrow> narrow = narrow_roots(equation, places);
    std::sort(narrow.begin(), narrow.end(), [](const Narrow& a, const Narrow& b) { return a.low < b.low; });
    const auto is_near = [&](const Quadratic_root& root, const Narrow& known) {
      const auto end = [&](const Integer& n) { return Quadratic_root(n, 0, Integer(0), Integer(1) << places); };
      return !(root < end(known.low - 1)) && !(end(known.low + 3) < root);
    };
    require(narrow.size() == static_cast<std::size_t>(count), "an equation has as many roots as its square says");
    require((!low || is_near(*low, narrow.front())) && (!high || is_near(*high, narrow.back())),
            "a curve is where its equation has roots");
    for (const auto& root : {low, high})
      if (root)
        if (const std::optional<Rational> at = root->rational())
          require(value(*at) == 0, "a curve is where it is said to be");
  }
}

}  // namespace fuzz
