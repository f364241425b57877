#pragma once
// What targets that measure share: scenes with an eye, polygons of the plane, solid angles. And polygons of the plane,
// as `compare` cuts them, against triangles.

#include "any_case.h"
#include "support.h"

#include <sightline/harness/compare/flat_polygon.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

namespace fuzz::measuring {

using generate::Points;
using generate::Random;
using harness::Flat_face;

/// A small scene of a family, and an eye.
inline std::optional<harness::Posed_scene> any_scene(Random& random, std::size_t most_pieces) {
  harness::Posed_scene posed = harness::make(any_case(random));
  const Scene scene(posed.soup);
  if (scene.pieces().empty() || scene.pieces().size() > most_pieces) return std::nullopt;
  return posed;
}

/// Below it doubles have fewer digits.
constexpr double least_size = 1e-300;

inline bool is_near(double a, double b, double allowed) { return std::fabs(a - b) <= allowed; }

// ---- Solid angles

inline std::array<double, 3> unit_of(const Exact_point& d) {
  const Rational size = std::max({Rational(abs(d[0])), Rational(abs(d[1])), Rational(abs(d[2]))});
  std::array<double, 3> v;
  for (std::size_t k = 0; k < 3; ++k) v[k] = nearest_double(Rational(d[k] / size));
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (double& x : v) x /= length;
  return v;
}

/// The solid angle of a convex cone of directions, by the angles between its sides. Ref: Girard
inline double angles_of(const Points& cone) {
  double sum = 2 * std::numbers::pi;
  for (std::size_t k = 0; k < cone.size(); ++k) {
    const Exact_point& ray = cone[k];
    const std::array<double, 3> before = unit_of(cross(cone[(k + cone.size() - 1) % cone.size()], ray)),
                                after = unit_of(cross(ray, cone[(k + 1) % cone.size()])), both = cross(before, after);
    sum -= std::atan2(std::sqrt(dot(both, both)), dot(before, after));
  }
  return sum;
}

// ---- Polygons of the plane

using Flat_point = Flat_polygon::Point;

inline Rational turn(const Flat_point& a, const Flat_point& b, const Flat_point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The area of a convex hull: of all triangles from one corner to edges of it, which have no point to the right.
inline Rational area_of_hull(const std::vector<Flat_point>& points) {
  Rational twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (points[i] == points[j]) continue;
      const bool is_edge = std::all_of(points.begin(), points.end(), [&](const Flat_point& p) {
        const Rational side = turn(points[i], points[j], p);
        if (side != 0) return side > 0;
        // On its line: the edge is the longest one.
        const auto along = [&](const Flat_point& q) {
          return Rational((q[0] - points[i][0]) * (points[j][0] - points[i][0]) +
                          (q[1] - points[i][1]) * (points[j][1] - points[i][1]));
        };
        return along(p) >= 0 && along(p) <= along(points[j]);
      });
      if (is_edge) twice += turn(points[0], points[i], points[j]);
    }
  return twice / 2;
}

inline void try_flat_polygons(Random& random) {
  const auto any_points = [&] {
    std::vector<Flat_point> points;
    const long denominator = static_cast<long>(random.between(1, 3));
    for (std::size_t k = 3 + random.below(5); k > 0; --k) {
      const Rational x = generate::ratio(static_cast<long>(random.between(-6, 6)), denominator),
                     y = generate::ratio(static_cast<long>(random.between(-6, 6)), denominator);
      if (std::find(points.begin(), points.end(), Flat_point{x, y}) == points.end()) points.push_back({x, y});
    }
    return points;
  };
  const std::vector<Flat_point> points = any_points();
  const Flat_polygon hull = Flat_polygon::hull(points), other = Flat_polygon::hull(any_points());
  const Rational whole = area_of_hull(points);
  require(hull.empty() == (whole == 0), "a hull is empty iff its points are on a line");
  if (hull.empty()) return;
  require(hull.area() == whole, "a hull has the area of its triangles");
  for (std::size_t k = 0; k < hull.lines().size(); ++k)
    require(std::find(points.begin(), points.end(), hull.vertex(k)) != points.end(), "a hull's corners are points");
  const Flat_polygon::Flat_line line{Integer(static_cast<long>(random.between(-3, 3))),
                                     Integer(static_cast<long>(random.between(-3, 3))),
                                     Integer(static_cast<long>(random.between(-9, 9)))};
  const auto value = [&](const Flat_point& p) { return Rational(line[0] * p[0] + line[1] * p[1] + line[2]); };
  if (line[0] != 0 || line[1] != 0) {
    const auto part_of = [&](int sign) {
      std::vector<Flat_point> kept;
      for (std::size_t k = 0; k < hull.lines().size(); ++k) {
        const Flat_point p = hull.vertex(k), q = hull.vertex((k + 1) % hull.lines().size());
        const Rational from = sign * value(p), to = sign * value(q);
        if (from >= 0) kept.push_back(p);
        if (sgn(from) * sgn(to) < 0) {
          const Rational t = from / (from - to);
          kept.push_back({Rational(p[0] + t * (q[0] - p[0])), Rational(p[1] + t * (q[1] - p[1]))});
        }
      }
      return kept;
    };
    require(hull.clipped(line).area() == area_of_hull(part_of(1)),
            "what is clipped has the area of one side of a line");
    require(hull.clipped(line).empty() == (area_of_hull(part_of(1)) == 0), "a part without area is empty");
  }
  // What is in one and not in the other, with what is in both.
  Flat_polygon both = hull;
  for (const Flat_polygon::Flat_line& side : other.lines()) both = both.clipped(side);
  Rational rest = 0;
  for (const Flat_polygon& part : hull.without(other)) {
    rest += part.area();
    Flat_polygon common = part;
    for (const Flat_polygon::Flat_line& side : other.lines()) common = common.clipped(side);
    require(other.empty() || common.empty(), "what is left of a polygon has nothing of the other one");
  }
  require(rest + (other.empty() || both.empty() ? Rational(0) : both.area()) == whole,
          "what is left of a polygon and what is in both are all of it");
}

}  // namespace fuzz::measuring
