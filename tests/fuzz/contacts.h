#pragma once
// What two convex faces have in common, as the checker of solids sees it, against clipping in rationals: faces through
// common points, edges, parts of edges and diagonals, in one plane or in two.

#include "support.h"

#include <sightline/algorithms/verify/solid_faces.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace fuzz {

using Flat_points = std::vector<Exact_point>;

/// The strict corners of a convex hull in the plane of p, u and v; none where it has no area.
inline Flat_points any_convex(generate::Random& random, const Exact_point& p, const Exact_point& u,
                              const Exact_point& v) {
  using Hull_place = std::pair<std::int64_t, std::int64_t>;
  std::set<Hull_place> places;
  while (places.size() < 3 + random.below(4)) places.insert({random.between(-2, 2), random.between(-2, 2)});
  if (random.chance(1, 2)) places.insert({{0, 0}, {1, 0}});  // so that the segment from p along u is part of it
  std::vector<Hull_place> hull;
  for (const int turn : {1, -1}) {
    std::vector<Hull_place> in_order(places.begin(), places.end());
    if (turn < 0) std::reverse(in_order.begin(), in_order.end());
    const std::size_t begin = hull.size();
    for (const Hull_place& q : in_order) {
      const auto is_needless = [&] {
        if (hull.size() < begin + 2) return false;
        const Hull_place &a = hull[hull.size() - 2], &b = hull.back();
        return (b.first - a.first) * (q.second - b.second) - (b.second - a.second) * (q.first - b.first) <= 0;
      };
      while (is_needless()) hull.pop_back();
      hull.push_back(q);
    }
    hull.pop_back();
  }
  Flat_points corners;
  if (hull.size() < 3) return corners;
  for (const auto& [i, j] : hull)
    corners.push_back(
        generate::along(generate::along(p, Rational(static_cast<long>(i)), u), Rational(static_cast<long>(j)), v));
  if (random.chance(1, 2)) std::reverse(corners.begin(), corners.end());
  return corners;
}

inline Exact_point normal_of(const Flat_points& face) {
  return cross(minus(face[1], face[0]), minus(face[2], face[0]));
}

/// The part of a polygon where a form is not below 0; nothing but what is there, perhaps without area.
template <class Value>
Flat_points part_of(const Flat_points& polygon, Value value) {
  Flat_points part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact_point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Rational at_a = value(a), at_b = value(b);
    if (at_a >= 0) part.push_back(a);
    if (sgn(at_a) * sgn(at_b) < 0) part.push_back(generate::along(a, at_a / (at_a - at_b), minus(b, a)));
  }
  return part;
}
/// Of a polygon what is in another one of its plane.
inline Flat_points common_of(Flat_points part, const Flat_points& other) {
  const Exact_point n = normal_of(other);
  for (std::size_t i = 0; i < other.size() && !part.empty(); ++i) {
    const Exact_point inwards = cross(n, minus(other[(i + 1) % other.size()], other[i]));
    part = part_of(part, [&](const Exact_point& p) { return dot(inwards, minus(p, other[i])); });
  }
  return part;
}

inline bool is_edge(const Flat_points& face, const Exact_point& p, const Exact_point& q) {
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Exact_point &a = face[i], &b = face[(i + 1) % face.size()];
    if ((a == p && b == q) || (a == q && b == p)) return true;
  }
  return false;
}

/// By clipping. In two planes a segment that both have is inside of what is on both sides of the other one's plane.
inline certificate_check::Contact contact_by_clipping(const Flat_points& a, const Flat_points& b) {
  using certificate_check::Contact;
  const Exact_point n = normal_of(a), m = normal_of(b);
  const auto sides = [](const Flat_points& face, const Exact_point& normal, const Exact_point& at) {
    std::array<bool, 3> there{};
    for (const Exact_point& p : face) there[static_cast<std::size_t>(1 + sgn(dot(normal, minus(p, at))))] = true;
    return there;
  };
  const bool is_one_plane = is_zero(cross(n, m)) && dot(n, minus(b[0], a[0])) == 0;
  Flat_points common;
  if (is_one_plane) {
    common = common_of(a, b);
    for (const Exact_point& p : common)
      for (const Exact_point& q : common)
        if (!is_zero(cross(minus(p, common[0]), minus(q, common[0])))) return Contact::crossed;
  } else {
    // Of each what is in the other one's plane, a segment at most; then of one what is in the other.
    Flat_points in_plane = part_of(a, [&](const Exact_point& p) { return dot(m, minus(p, b[0])); });
    in_plane = part_of(in_plane, [&](const Exact_point& p) { return dot(m, minus(b[0], p)); });
    common = common_of(in_plane, b);
  }
  std::set<Exact_point> ends(common.begin(), common.end());
  if (ends.size() < 2) return Contact::little;
  const Exact_point &p = *ends.begin(), &q = *ends.rbegin();
  if (!is_one_plane) {
    const auto of_a = sides(a, m, b[0]), of_b = sides(b, n, a[0]);
    if ((of_a[0] && of_a[2]) || (of_b[0] && of_b[2])) return Contact::crossed;
  }
  return is_edge(a, p, q) && is_edge(b, p, q) ? Contact::little : Contact::edges;
}

inline void contacts(std::string_view bytes) {
  using certificate_check::Contact, certificate_check::Solid_face, certificate_check::Solid_point;
  Bytes from(bytes);
  generate::Random random(from.word());
  // 1. Two faces: the second through points or edges of the first, or diagonals, or anywhere near; in its plane or not.
  const Rational step = random.chance(1, 4)   ? generate::ratio(1, 3)
                        : random.chance(1, 4) ? Rational(1 << 20)
                                              : Rational(1);
  const auto way = [&]() -> Exact_point {
    Exact_point w = generate::lattice(random, 2);
    for (Rational& x : w) x *= step;
    return w;
  };
  const Exact_point p = way(), u = way(), v = way();
  if (is_zero(cross(u, v))) return;
  const Flat_points a = any_convex(random, p, u, v);
  if (a.empty()) return;
  Exact_point at = a[random.below(a.size())], along = minus(a[random.below(a.size())], at), across = way();
  if (random.chance(1, 4)) at = generate::along(at, generate::ratio(random.between(-2, 2), 2), way());
  if (random.chance(1, 4)) along = way();
  else if (random.chance(1, 3)) along = generate::along({0, 0, 0}, generate::ratio(1, 2), along);
  if (random.chance(1, 4)) across = generate::along(u, Rational(static_cast<long>(random.between(-1, 1))), v);
  if (is_zero(cross(along, across))) return;
  const Flat_points b = any_convex(random, at, along, across);
  if (b.empty()) return;

  // 2. As the checker has them: points once, which know planes or not.
  std::map<Exact_point, std::uint32_t> numbers;
  for (const Flat_points* face : {&a, &b})
    for (const Exact_point& q : *face) numbers.try_emplace(q, static_cast<std::uint32_t>(numbers.size()));
  std::vector<std::optional<Solid_point>> made(numbers.size());
  for (const auto& [q, number] : numbers) made[number].emplace(q);
  std::vector<Solid_point> points;
  for (std::optional<Solid_point>& one : made) points.push_back(*std::move(one));
  const auto numbers_of = [&](const Flat_points& face) {
    std::vector<Solid_face::Number> own;
    for (const Exact_point& q : face) own.push_back(numbers.at(q));
    return own;
  };
  const Contact expected = contact_by_clipping(a, b);
  const auto check = [&](const Solid_face& one, const Solid_face& other, const char* what) {
    const Contact found = contact_of(one, other);
    require((found == Contact::crossed) == (expected == Contact::crossed), what);
    require(found != Contact::little || expected == Contact::little, "what faces share on their borders is told");
  };
  Solid_face one(numbers_of(a), points), other(numbers_of(b), points);
  check(one, other, "faces are told to cross iff they do");
  check(other, one, "faces are told to cross iff they do, whichever is named first");
  const bool is_one_plane = is_in_plane_of(one, other);
  one.plane_number = 3;
  other.plane_number = is_one_plane ? 3 : 5;
  for (const auto& [q, number] : numbers) {
    if (dot(normal_of(a), minus(q, a[0])) == 0) points[number].planes.push_back(3);
    if (!is_one_plane && dot(normal_of(b), minus(q, b[0])) == 0) points[number].planes.push_back(5);
  }
  check(one, other, "faces whose points know planes are told to cross iff they do");
}

}  // namespace fuzz
