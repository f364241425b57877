#pragma once
// What is refused, and what is not: sources, images, corners and coordinates at the bounds of what they may be.

#include "support.h"

#include <sightline/algorithms/image/blend.h>
#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fuzz {

// ---- Sources

using Loop_point = std::array<Rational, 2>;

/// Twice the signed area of a triangle.
inline Rational turn_of(const Loop_point& p, const Loop_point& q, const Loop_point& r) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/// The corners of the convex hull, counterclockwise from the least one; fewer than three of points on a line. By trying
/// all lines through two points.
inline std::vector<Loop_point> hull_of(std::vector<Loop_point> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Loop_point> hull{points.front()};
  for (;;) {
    // The next corner has nothing to its right, and is the farthest such.
    std::optional<Loop_point> next;
    for (const Loop_point& q : points) {
      if (q == hull.back()) continue;
      const bool is_edge = std::all_of(points.begin(), points.end(),
                                       [&](const Loop_point& r) { return turn_of(hull.back(), q, r) >= 0; });
      const auto beyond = [&](const Loop_point& p) -> Rational {
        return abs(Rational(p[0] - hull.back()[0])) + abs(Rational(p[1] - hull.back()[1]));
      };
      if (is_edge && (!next || beyond(q) > beyond(*next))) next = q;
    }
    if (!next || *next == hull.front() || hull.size() > points.size()) return hull;
    hull.push_back(*next);
  }
}

/// The corners that a loop has as a source: it goes once around its hull, counterclockwise or clockwise, never back;
/// nothing where it does not. Begins where the loop comes to a corner of the hull first.
inline std::vector<Loop_point> corners_of_source(std::vector<Loop_point> loop) {
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  std::vector<Loop_point> hull = hull_of(loop);
  if (hull.size() < 3) return {};
  for (const bool turned : {false, true}) {
    if (turned) std::reverse(hull.begin(), hull.end());
    // 1. How far along the hull each is: an edge's number, and the share of it.
    std::vector<Rational> places;
    for (const Loop_point& p : loop)
      for (std::size_t k = 0; k < hull.size(); ++k) {
        const Loop_point &a = hull[k], &b = hull[(k + 1) % hull.size()];
        if (turn_of(a, b, p) != 0) continue;
        const std::size_t axis = a[0] == b[0] ? 1 : 0;
        const Rational share = (p[axis] - a[axis]) / (b[axis] - a[axis]);
        if (share >= 0 && share < 1) places.push_back(Rational(static_cast<unsigned long>(k)) + share);
      }
    if (places.size() != loop.size()) continue;
    // 2. Each is farther than the one before, but where it comes around.
    std::size_t back = 0;
    for (std::size_t k = 0; k < places.size(); ++k) back += places[(k + 1) % places.size()] <= places[k];
    if (back != 1) continue;
    std::vector<Loop_point> corners;
    for (const Loop_point& p : loop)
      if (std::find(hull.begin(), hull.end(), p) != hull.end()) corners.push_back(p);
    return corners;
  }
  return {};
}

inline void try_source(Bytes& from) {
  // 1. A loop: anything, a hull with straight and repeated corners, every second corner of it; in the plane or a little
  // off it.
  std::vector<Loop_point> loop;
  for (std::size_t k = 0, count = 2 + from.below(7); k < count; ++k)
    loop.push_back({static_cast<long>(from.below(5)), static_cast<long>(from.below(5))});
  const std::size_t kind = from.below(4);
  if (kind != 0) {
    loop = hull_of(loop);
    if (kind == 2) {
      std::vector<Loop_point> star;
      for (std::size_t k = 0; k < loop.size(); ++k) star.push_back(loop[2 * k % loop.size()]);
      loop = star;
    }
    for (std::size_t more = from.below(3); more > 0; --more) {
      const std::size_t k = from.below(loop.size());
      const Loop_point a = loop[k], b = loop[(k + 1) % loop.size()];
      const Rational share = Rational(1, 2) * static_cast<long>(from.below(3));
      loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                  {Rational(a[0] + share * (b[0] - a[0])), Rational(a[1] + share * (b[1] - a[1]))});
    }
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(from.below(loop.size())), loop.end());
    if (from.below(2) == 0) std::reverse(loop.begin(), loop.end());
  }
  const auto small = [&] { return static_cast<long>(from.below(7)) - 3; };
  const Exact_point origin{small(), small(), small()}, u{1, small(), small()}, v{0, 1 + from.below(3), small()};
  const auto in_space = [&](const Loop_point& p) {
    Exact_point at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = origin[k] + p[0] * u[k] + p[1] * v[k];
    return at;
  };
  std::vector<Exact_point> points;
  for (const Loop_point& p : loop) points.push_back(in_space(p));
  std::vector<Loop_point> expected = corners_of_source(loop);
  if (expected.size() > 3 && from.below(4) == 0) {  // a corner of four or more is off the plane of the others
    const auto moved = in_space(expected[from.below(expected.size())]);
    for (Exact_point& p : points)
      if (p == moved) p[2] += Rational(1, Integer(1) << (1 + from.below(80)));
    expected.clear();
  }

  // 2. What is said of it.
  std::vector<Exact_point> found;
  const bool refused = is_refused<std::invalid_argument>([&] { found = strict_corners(points); });
  require(refused == expected.empty(), "a source is refused iff it does not go once around a convex polygon");
  std::vector<Exact_point> corners;
  for (const Loop_point& p : expected) corners.push_back(in_space(p));
  require(refused || found == corners, "a source keeps its strict corners, in order");
}

// ---- Images

inline void try_image(Bytes& from) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::array<std::uint32_t, 6> sizes{1, 2, 3, 0, 1u << 20, (1u << 20) + 1};
  const std::array<double, 9> numbers{0, 1, -1, 0.5, 3, 0x1p-1074, 0x1p500, infinity, std::nan("")};
  Pixel_view pixels{{0, 0, 0}, {}, {}, {}, sizes[from.below(sizes.size())], sizes[from.below(3)]};
  if (from.below(2) == 0) std::swap(pixels.width, pixels.height);
  bool is_finite = true;
  for (auto* direction : {&pixels.look, &pixels.right, &pixels.up})
    for (double& x : *direction) {
      x = numbers[from.below(from.below(8) == 0 ? numbers.size() : 5)];
      is_finite = is_finite && std::isfinite(x);
    }
  bool spans = false;
  if (is_finite) {
    const auto at = [](const std::array<double, 3>& v, std::size_t k) { return exact(v[k]); };
    Rational volume = 0;  // by Leibniz
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      volume += at(pixels.look, k) * at(pixels.right, l) * at(pixels.up, m);
      volume -= at(pixels.look, m) * at(pixels.right, l) * at(pixels.up, k);
    }
    spans = volume != 0;
  }
  const auto is_size = [](std::uint32_t n) { return n >= 1 && n <= 1u << 20; };
  const bool right = spans && is_size(pixels.width) && is_size(pixels.height);
  Polygon_soup soup;
  soup.add_face({soup.add_point(1, 0, 5), soup.add_point(0, 1, 5), soup.add_point(-1, -1, 5)});
  const Scene scene(soup);
  const bool refused = is_refused<std::invalid_argument>([&] {
    const Piece_image image = centres(Exact_view(scene, pixels.eye), pixels, {1, {}});
    require(image.pieces.size() == std::size_t{pixels.width} * pixels.height, "an image has all its pixels");
  });
  require(refused != right, "an image is refused iff its size or its directions are wrong");
}

inline void try_tints(Bytes& from) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::array<double, 8> numbers{0, 1, 0.5, 1 + 0x1p-52, -0x1p-1074, infinity, -infinity, std::nan("")};
  const std::size_t pieces = from.below(4);
  std::vector<Tint> tints(from.below(4));
  bool right = tints.size() >= pieces;
  for (Tint& tint : tints) {
    const auto any = [&] { return numbers[from.below(from.below(4) == 0 ? numbers.size() : 3)]; };
    for (double& c : tint.colour) {
      c = any();
      right = right && std::isfinite(c);
    }
    tint.alpha = any();
    right = right && tint.alpha >= 0 && tint.alpha <= 1;
  }
  require(is_refused<std::invalid_argument>([&] { image_detail::check_tints(tints, pieces); }) != right,
          "tints are refused iff there are too few, or one is no colour, or no share");
}

// ---- Soups

inline void try_soup(Bytes& from) {
  Polygon_soup soup;
  const std::size_t points = from.below(5);
  bool is_whole = true;
  for (std::size_t loops = from.below(4); loops > 0; --loops) {
    std::vector<Point_id> loop;
    for (std::size_t k = from.below(5); k > 0; --k) {
      loop.push_back(static_cast<Point_id>(from.below(6)));
      is_whole = is_whole && loop.back() < points;
    }
    if (soup.face_count() > 0 && from.below(3) == 0) soup.add_hole(loop);
    else soup.add_face(loop);
  }
  for (std::size_t k = 0; k < points; ++k) soup.add_point(static_cast<double>(k), 0, 0);
  require(is_refused<std::out_of_range>([&] { soup.check_corners(); }) != is_whole,
          "corners are refused iff some point is not there");
  const auto coordinate = std::bit_cast<double>(from.below(2) == 0 ? from.word() : from.word() | 0x7ff0ull << 48);
  std::array<double, 3> p{1, 2, 3};
  p[from.below(3)] = coordinate;
  require(is_refused<std::domain_error>([&] { soup.add_point(p[0], p[1], p[2]); }) != std::isfinite(coordinate),
          "a point is refused iff it is not finite");
}

inline void refusals(std::string_view bytes) {
  Bytes from(bytes);
  switch (from.below(8)) {
    case 0: try_image(from); break;
    case 1: try_soup(from); break;
    case 2: try_tints(from); break;
    default: try_source(from);
  }
}

}  // namespace fuzz
