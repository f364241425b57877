#pragma once
// The statistics that the authors wanted: at each pixel of an image, how many faces a ray pierces from the front (S),
// and how many of them the priorities leave to choose from (S^ of the paper: those of highest priority).

#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/algorithms/priority/rounded_plane.h>
#include <sightline/algorithms/priority/scope.h>
#include <sightline/algorithms/priority/tree.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

/// For each pixel the polygons that its ray pierces from the front, by their numbers in the relation, ascending.
struct Pixel_sets {
  std::vector<std::uint32_t> begin{0}, members;
  std::uint64_t rays = 0, exact = 0;  ///< rays against polygons; signs that doubles did not decide

  std::size_t size() const { return begin.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t pixel) const {
    return std::span(members).subspan(begin[pixel], begin[pixel + 1] - begin[pixel]);
  }
};

namespace priority_detail {

/// The cone of a polygon from an eye in front of it: normals of the planes through the eye and its edges, inwards.
struct Pixel_cone {
  std::vector<Rounded_plane> sides;  // by edge
  std::vector<Exact_point> arms;     // from the eye to the corners

  Pixel_cone(const std::vector<Exact_point>& corners, const Exact_point& eye);
  std::size_t next(std::size_t k) const { return k + 1 == arms.size() ? 0 : k + 1; }

  /// Whether the direction is strictly inside. Proof: P-40
  bool holds(const std::array<double, 3>& d, Pixel_sets& counts) const;
};

}  // namespace priority_detail

/// The sets S of an image. Degenerate: a ray through an edge or a corner pierces no inside; faces that are edge-on or
/// off-view are never pierced. Cost: for each on-view polygon the pixels of its bounding rectangle, or all of them
/// where it reaches behind the eye. `ask` is called before each of their rows; what it throws ends it. Exact: yes. Pre:
/// finite directions. Proof: P-40
template <class Traits>
Pixel_sets pixel_sets(const Priority_relation<Traits>& faces, const Pixel_view& view,
                      const std::function<void()>& ask = {}) {
  const Traits& traits = faces.traits();
  const typename Traits::Eye viewpoint = traits.eye(view.eye);
  Predicate_counts counts;
  Pixel_sets sets;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  // pixel, polygon
  const std::array<double, 3> forth = cross(view.right, view.up), across = cross(view.up, view.look),
                              upwards = cross(view.look, view.right);
  const double volume = dot(view.look, forth);
  const bool by_projection = view.has_places_in_doubles();
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    if (traits.side(viewpoint, faces.plane(i), counts) != CGAL::POSITIVE) continue;
    const priority_detail::Pixel_cone cone(priority_detail::positions(traits, faces[i]), view.eye);

    // 1. The pixels that it may cover, and one more on each side.
    std::array<double, 4> box{1, -1, 1, -1};  // x from, to; y from, to, in the plane of the image
    bool in_front = by_projection;
    for (const Exact_point& arm : cone.arms) {
      const std::array<double, 3> a{nearest_double(arm[0]), nearest_double(arm[1]), nearest_double(arm[2])};
      const double z = dot(a, forth) / volume, x = dot(a, across) / volume / z,
                   y = dot(a, upwards) / volume / z;  // a = z (look + x right + y up)
      in_front = in_front && dot(a, a) > 0x1p-900 && z > 1e-6 * std::sqrt(dot(a, a) / dot(view.look, view.look)) &&
                 std::isfinite(x + y);
      box = {std::min(box[0], x), std::max(box[1], x), std::min(box[2], y), std::max(box[3], y)};
    }
    if (!in_front) box = {-1, 1, -1, 1};
    const auto pixel = [](double place, std::uint32_t count) {
      return static_cast<std::int64_t>(std::floor(std::clamp((place + 1) / 2 * count, -2.0, count + 2.0)));
    };
    const std::int64_t left = std::max<std::int64_t>(0, pixel(box[0], view.width) - 1),
                       right = std::min<std::int64_t>(view.width - std::int64_t{1}, pixel(box[1], view.width) + 1);
    const std::int64_t top = std::max<std::int64_t>(0, pixel(-box[3], view.height) - 1),
                       bottom = std::min<std::int64_t>(view.height - std::int64_t{1}, pixel(-box[2], view.height) + 1);

    // 2. Their rays.
    for (std::int64_t y = top; y <= bottom; ++y) {
      if (ask) ask();
      for (std::int64_t x = left; x <= right; ++x) {
        ++sets.rays;
        if (cone.holds(view.ray(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)), sets))
          found.emplace_back(static_cast<std::uint32_t>(y * view.width + x), i);
      }
    }
  }

  std::sort(found.begin(), found.end());
  sets.begin.assign(std::size_t{view.width} * view.height + 1, 0);
  for (const auto& [pixel, i] : found) {
    ++sets.begin[pixel + std::size_t{1}];
    sets.members.push_back(i);
  }
  for (std::size_t p = 1; p < sets.begin.size(); ++p) sets.begin[p] += sets.begin[p - 1];
  return sets;
}

/// Numbers for a tree's polygons as seen from an eye, the nearest lowest; those of one cycle share theirs, and what was
/// cut has the highest. What h is for all viewpoints, the tree is for this one. Cost: linear. Exact: yes. Proof: P-37
template <class Traits>
std::vector<std::uint32_t> priorities(const Traits& traits, const Priority_tree<Traits>& tree, const Exact_point& eye) {
  using Slot = typename Priority_tree<Traits>::Slot;
  std::vector<std::uint32_t> number(tree.polygons.size(), std::numeric_limits<std::uint32_t>::max());
  std::uint32_t next = static_cast<std::uint32_t>(tree.polygons.size());
  Predicate_counts counts;
  walk_back_to_front(
      traits, tree, eye, counts, [&](std::uint32_t i) { number[i] = --next; },
      [&](std::span<const Slot> cycle) {
        --next;
        for (const Slot slot : cycle) number[static_cast<std::size_t>(slot)] = next;
      });
  return number;
}

/// What the priorities leave at the pixels of an image.
struct Pixel_statistics {
  std::uint64_t covered = 0;                        ///< pixels whose ray pierces a face: |S| >= 1
  std::uint64_t several = 0;                        ///< |S| >= 2
  std::uint64_t single = 0;                         ///< |S^| = 1
  std::uint64_t faces = 0, left = 0;                ///< sums of |S| and |S^|
  std::vector<std::vector<std::uint64_t>> by_size;  ///< by_size[s][l]: pixels with |S| = s >= 1 and |S^| = l
  std::vector<std::uint32_t> image;                 ///< |S^| by pixel, row by row
};

/// Cost: linear in the sets. Pre: a number for each polygon of the sets.
Pixel_statistics pixel_statistics(const Pixel_sets& sets, std::span<const std::uint32_t> priority);

// Compiled once.
extern template Pixel_sets pixel_sets(const Priority_relation<Exact_traits>&, const Pixel_view&,
                                      const std::function<void()>&);
extern template std::vector<std::uint32_t> priorities(const Exact_traits&, const Priority_tree<Exact_traits>&,
                                                      const Exact_point&);

}  // namespace sightline
