#pragma once
// Which pairs of cones a checker compares, and which of two cones is nearer, against all pairs in integers.

#include "support.h"

#include <sightline/algorithms/verify/pairs.h>
#include <sightline/algorithms/verify/planes_between.h>
#include <sightline/algorithms/verify/rounded_cones.h>
#include <sightline/harness/laws/flat_faces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace fuzz {

using Whole = std::array<std::int64_t, 3>;  // below 2^15, so that what is made of three of them fits
using Whole_points = std::vector<Whole>;

inline Whole cross(const Whole& a, const Whole& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline std::int64_t dot(const Whole& a, const Whole& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Whether a plane through the origin has one on each side. If there is one, there is one through two of the corners.
inline bool is_apart(const Whole_points& a, const Whole_points& b) {
  Whole_points both = a;
  both.insert(both.end(), b.begin(), b.end());
  const auto on_side = [](const Whole_points& points, const Whole& normal, std::int64_t side) {
    return std::all_of(points.begin(), points.end(), [&](const Whole& p) { return side * dot(normal, p) >= 0; });
  };
  for (std::size_t i = 0; i < both.size(); ++i)
    for (std::size_t j = i + 1; j < both.size(); ++j) {
      const Whole normal = cross(both[i], both[j]);
      if (normal == Whole{}) continue;
      for (const int side : {1, -1})
        if (on_side(a, normal, side) && on_side(b, normal, -side)) return true;
    }
  return false;
}

/// Around what a polygon covers of a side of the cube [-1, 1]^3, in doubles; nothing where that is nothing, about.
struct Box {
  std::array<double, 2> low{2, 2}, high{-2, -2};
};
inline std::optional<Box> box_on(const Whole_points& polygon, std::size_t axis, double sense) {
  using Ray = std::array<double, 3>;
  std::vector<Ray> rays;
  for (const Whole& p : polygon)
    rays.push_back({static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
  for (const std::size_t other : {(axis + 1) % 3, (axis + 2) % 3})
    for (const double way : {1.0, -1.0}) {
      std::vector<Ray> kept;
      const auto height = [&](const Ray& ray) { return sense * ray[axis] + way * ray[other]; };
      for (std::size_t k = 0; k < rays.size(); ++k) {
        const Ray &ray = rays[k], &next = rays[(k + 1) % rays.size()];
        const double here = height(ray), there = height(next);
        if (here >= 0) kept.push_back(ray);
        if ((here < 0) == (there < 0)) continue;
        const double t = here / (here - there);
        kept.push_back(
            {ray[0] + t * (next[0] - ray[0]), ray[1] + t * (next[1] - ray[1]), ray[2] + t * (next[2] - ray[2])});
      }
      rays = std::move(kept);
    }
  Box box;
  for (const Ray& ray : rays) {
    if (!(sense * ray[axis] > 1e-9)) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      const double at = ray[(axis + 1 + k) % 3] / (sense * ray[axis]);
      box.low[k] = std::min(box.low[k], at);
      box.high[k] = std::max(box.high[k], at);
    }
  }
  if (box.low[0] > box.high[0]) return std::nullopt;
  return box;
}

/// The boxes of a polygon on all sides.
using Boxes = std::array<std::optional<Box>, 6>;
inline Boxes boxes_of(const Whole_points& polygon) {
  Boxes boxes;
  for (std::size_t side = 0; side < boxes.size(); ++side)
    boxes[side] = box_on(polygon, side / 2, side % 2 == 0 ? 1 : -1);
  return boxes;
}
/// Whether boxes meet on some side, or nearly.
inline bool may_meet(const Boxes& a, const Boxes& b) {
  for (std::size_t side = 0; side < a.size(); ++side) {
    if (!a[side] || !b[side]) continue;
    bool meet = true;
    for (std::size_t k = 0; k < 2; ++k)
      meet = meet && std::max(a[side]->low[k], b[side]->low[k]) <= std::min(a[side]->high[k], b[side]->high[k]) + 1e-9;
    if (meet) return true;
  }
  return false;
}

/// Polygons about the origin: small ones anywhere, needles side by side or across, large ones, some with an edge, a
/// corner or a plane in common.
class Cone_scene {
 public:
  explicit Cone_scene(std::uint64_t seed) : random_(seed) {
    const std::size_t count = below(4) == 0 ? 2 + below(20) : 60 + below(60), kind = below(4);
    needle_ = anywhere(1000);
    across_ = anywhere(40);
    side_ = {below(3), below(2) == 0 ? 1 : -1};
    while (polygons_.size() < count) {
      const bool as_needle = kind == 0 || (kind == 1 && below(8) != 0);
      Whole_points polygon = as_needle ? needle(kind == 1) : patch(kind == 2 ? 300 : 60);
      if (!polygons_.empty() && below(16) == 0)  // one more, with a corner of another one
        for (Whole& p : polygon)
          if (below(2) == 0) p = polygons_.back()[below(polygons_.back().size())];
      keep(std::move(polygon));
    }
  }
  const std::vector<Whole_points>& polygons() const { return polygons_; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

 private:
  std::int64_t number(std::int64_t most) {
    return static_cast<std::int64_t>(below(static_cast<std::size_t>(2 * most + 1))) - most;
  }
  Whole anywhere(std::int64_t most) { return {number(most), number(most), number(most)}; }

  /// From one end of a side of the cube to the other, moved a little each time, or anywhere across.
  Whole_points needle(bool side_by_side) {
    const auto on_side = [&](Whole p) {
      p[side_.first] = side_.second * 1000;
      return p;
    };
    const std::int64_t step = side_by_side ? static_cast<std::int64_t>(below(60)) - 30 : 0;
    Whole from = side_by_side ? needle_ : anywhere(1000), to, width = across_;
    for (std::size_t k = 0; k < 3; ++k) {
      to[k] = -from[k];
      from[k] += step * across_[k];
      to[k] += step * across_[k];
      if (!side_by_side) width[k] = number(20);
    }
    Whole beside = from;
    for (std::size_t k = 0; k < 3; ++k) beside[k] += width[k];
    return {on_side(from), on_side(beside), on_side(to)};
  }
  /// An affine image of one of some shapes, some with a straight corner.
  Whole_points patch(std::int64_t size) {
    using Shape = std::vector<std::array<std::int64_t, 2>>;
    static const std::array<Shape, 5> shapes{Shape{{0, 0}, {1, 0}, {0, 1}}, Shape{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                             Shape{{0, 0}, {2, 0}, {3, 1}, {2, 3}, {0, 2}},
                                             Shape{{0, 0}, {1, 0}, {2, 0}, {0, 2}},
                                             Shape{{1, 0}, {2, 0}, {3, 1}, {3, 2}, {2, 3}, {1, 3}, {0, 2}, {0, 1}}};
    const Whole at = anywhere(200), u = anywhere(size), v = anywhere(size);
    Whole_points polygon;
    for (const auto& [x, y] : shapes[below(shapes.size())])
      polygon.push_back({at[0] + x * u[0] + y * v[0], at[1] + x * u[1] + y * v[1], at[2] + x * u[2] + y * v[2]});
    return polygon;
  }
  /// Those that have area and not the origin in their plane, seen counterclockwise from it.
  void keep(Whole_points polygon) {
    const auto minus = [](const Whole& p, const Whole& q) { return Whole{p[0] - q[0], p[1] - q[1], p[2] - q[2]}; };
    const Whole normal = cross(minus(polygon[1], polygon[0]), minus(polygon.back(), polygon[0]));
    const std::int64_t height = -dot(normal, polygon[0]);
    if (height == 0) return;
    for (std::size_t k = 0; k < polygon.size(); ++k) {  // a corner moved elsewhere makes some that are none
      const Whole &p = polygon[k], &q = polygon[(k + 1) % polygon.size()], &r = polygon[(k + 2) % polygon.size()];
      if (dot(normal, minus(p, polygon[0])) != 0 || dot(normal, cross(minus(q, p), minus(r, q))) < 0 || p == q) return;
    }
    if (height < 0) std::reverse(polygon.begin(), polygon.end());
    polygons_.push_back(std::move(polygon));
  }

  std::mt19937_64 random_;
  Whole needle_{}, across_{};
  std::pair<std::size_t, std::int64_t> side_;
  std::vector<Whole_points> polygons_;
};

inline std::vector<Exact_point> exact_points(const Whole_points& polygon) {
  std::vector<Exact_point> points;
  for (const Whole& p : polygon) points.push_back({Rational(p[0]), Rational(p[1]), Rational(p[2])});
  return points;
}

inline void pairs(std::string_view bytes) {
  constexpr std::size_t compared = 24;
  Cone_scene scene(Bytes(bytes).word());
  const std::vector<Whole_points>& polygons = scene.polygons();
  std::vector<order_check::Cone> cones;
  std::vector<Boxes> boxes;
  const Exact_point eye{0, 0, 0};
  for (const Whole_points& polygon : polygons) {
    const std::vector<Exact_point> points = exact_points(polygon);
    if (!certificate_check::not_convex(points, {certificate_check::newell_normal(points), points[0]}).empty())
      return;  // twice one corner
    cones.emplace_back(points, eye);
    require(!cones.back().edge_on, "a cone has an inside");
    boxes.push_back(boxes_of(polygon));
  }

  // 1. Those that are handed on: all that overlap, and none whose boxes are apart on all sides.
  std::vector<std::size_t> all(cones.size()), some;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    all[i] = i;
    if (scene.below(3) != 0) some.push_back(i);
  }
  const bool with_itself = scene.below(2) == 0;
  const std::vector<std::size_t>& others = with_itself ? all : some;
  std::set<std::pair<std::size_t, std::size_t>> taken;
  double last = 0;
  const auto take = [&](std::size_t i, std::size_t j) { taken.insert({i, j}); };
  const std::vector<order_check::Rounded_cone> rounded = order_check::rounded(cones, 1);
  order_check::Pairs(cones, rounded, take).each(all, others, 1, [&](double share) {
    require(last <= share && share <= 1, "progress goes on, up to 1");
    last = share;
  });
  std::size_t found = 0;
  for (const std::size_t i : all)
    for (const std::size_t j : others) {
      const bool is_taken = taken.count({i, j}) > 0;
      found += is_taken;
      if (is_taken) require(may_meet(boxes[i], boxes[j]), "cones that are handed on are near each other");
      else require(is_apart(polygons[i], polygons[j]), "cones that overlap are handed on");
    }
  require(found == taken.size(), "what is handed on was asked for");

  // 2. Which one is nearer.
  order_check::Pair_check check;
  for (std::size_t k = 0; k < compared && !taken.empty(); ++k) {
    const auto [i, j] = *std::next(taken.begin(), static_cast<std::ptrdiff_t>(scene.below(taken.size())));
    const harness::Flat_face a(exact_points(polygons[i])), b(exact_points(polygons[j]));
    require(check.nearer_somewhere(cones[i], cones[j]) == harness::sees_over(eye, a, b),
            "a cone is nearer than another one where a ray says so");
    const order_check::Rounded_cone rounded_i(cones[i]), rounded_j(cones[j]);
    require(!nowhere_nearer(rounded_i, rounded_j) || !check.nearer_somewhere(cones[i], cones[j]),
            "what doubles tell to be nowhere nearer is so");
    require(
        check.nearer_somewhere(cones[i], rounded_i, cones[j], rounded_j) == check.nearer_somewhere(cones[i], cones[j]),
        "doubles that help to compare do not change the answer");
    require((separates(cones[i], cones[j]) || separates(cones[j], cones[i])) <= is_apart(polygons[i], polygons[j]),
            "what an edge's plane separates is apart");
  }

  // 3. Which pairs need no comparison, as a plane of the sequence is between them; of numbers that doubles do not hold,
  // which change nothing, too.
  if (scene.below(2) == 0) {
    const auto entry = [&] { return static_cast<std::int64_t>(scene.below(std::size_t{1} << 40)) + 1; };
    const Whole scale{entry(), entry(), entry()};
    cones.clear();
    for (const Whole_points& polygon : polygons) {
      std::vector<Exact_point> points = exact_points(polygon);
      for (Exact_point& p : points) {
        for (std::size_t k = 0; k < 3; ++k) p[k] *= Rational(static_cast<long>(scale[k]));
        p[0] += 3 * p[1] - p[2];
      }
      cones.emplace_back(points, eye);
    }
  }
  const auto farther = [](const order_check::Cone& a, const order_check::Cone& b) {  // about
    return a.distance * abs(b.nearness[0] + b.nearness[1] + b.nearness[2]) >
           b.distance * abs(a.nearness[0] + a.nearness[1] + a.nearness[2]);
  };
  if (scene.below(4) != 0) std::sort(cones.begin(), cones.end(), farther);
  const std::vector<order_check::Rounded_cone> of_sequence(cones.begin(), cones.end());
  // Cut where its polygons seem to let it be cut, or anywhere.
  std::vector<std::uint32_t> depths(scene.below(2) == 0 ? cones.size() : 0);
  for (std::uint32_t& depth : depths) depth = static_cast<std::uint32_t>(scene.below(1 + scene.below(cones.size())));
  if (scene.below(4) == 0) {  // one at a time: below more cuts than paths tell of
    const bool from_behind = scene.below(2) == 0;
    for (std::size_t k = 0; k < depths.size(); ++k)
      depths[k] = static_cast<std::uint32_t>(from_behind ? depths.size() - k : k);
  }
  order_check::Cut_places places{depths};
  for (std::size_t place = 0; place < cones.size() && !depths.empty(); place += 1 + scene.below(9)) {
    const std::size_t of = scene.below(cones.size());
    order_check::Cone plane;
    plane.nearness = cones[of].nearness;
    plane.distance = scene.below(4) == 0 ? Integer(0) : cones[of].distance;
    plane.edge_on = cones[of].edge_on;
    places.others.push_back({place, depths[of], plane, order_check::Rounded_cone(plane)});
  }
  const order_check::Planes_between planes(cones, of_sequence, 1, std::move(places));
  for (std::size_t later = 0; later < cones.size(); ++later)
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      require(!planes.in_order(earlier, later) || !check.nearer_somewhere(cones[earlier], cones[later]),
              "what a plane is between is in order");
      require(!planes.is_settled(earlier) || !planes.is_settled(later) ||
                  !check.nearer_somewhere(cones[earlier], cones[later]),
              "what planes settle is in order");
      const order_check::Cone &a = cones[earlier], &b = cones[later];
      for (std::size_t ray = 0; ray < a.rays.size(); ++ray) {
        const std::optional<int> side = side_to_plane(of_sequence[earlier], ray, of_sequence[later]);
        const Integer height = a.distance * order_check::dot(b.nearness, a.rays[ray]) -
                               b.distance * order_check::dot(a.nearness, a.rays[ray]);
        require(!side || *side == sgn(height), "doubles that tell a side are right");
      }
    }
}

}  // namespace fuzz
