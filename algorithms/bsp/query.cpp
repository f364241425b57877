#include <sightline/algorithms/bsp/query.h>

#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace sightline {
namespace bsp_detail {

Grid_ray::Grid_ray(const Exact_traits& traits, const Exact_ray& ray) : traits_(traits) {
  const Scene& scene = traits.scene();
  const Located_point from = scene.locate(ray.origin);
  const Exact_point tip{Rational(ray.origin[0] + ray.direction[0]), Rational(ray.origin[1] + ray.direction[1]),
                        Rational(ray.origin[2] + ray.direction[2])};
  const Located_point to = scene.locate(tip);
  origin_ = {Rational(from.x, from.w), Rational(from.y, from.w), Rational(from.z, from.w)};
  const std::array<Rational, 3> end{Rational(to.x, to.w), Rational(to.y, to.w), Rational(to.z, to.w)};
  for (std::size_t k = 0; k < 3; ++k) {
    origin_[k].canonicalize();
    Rational e = end[k];
    e.canonicalize();
    direction_[k] = e - origin_[k];
  }
}

Grid_ray::Line_value Grid_ray::value(Plane plane) const {
  const std::array<Integer, 4> h = traits_.predicates().coefficients(plane);
  Line_value v{Rational(h[3]), 0};
  for (std::size_t k = 0; k < 3; ++k) {
    v.at += h[k] * origin_[k];
    v.slope += h[k] * direction_[k];
  }
  return v;
}

std::optional<std::array<Rational, 2>> Grid_ray::range_within(const Convex_polygon<Exact_traits>& polygon, Rational low,
                                                              std::optional<Rational> high) const {
  for (const Corner<Exact_traits>& corner : polygon) {
    const Line_value v = value(corner.edge.bound);
    if (v.slope == 0) {
      if (v.at < 0) return std::nullopt;
      continue;
    }
    const Rational t = -v.at / v.slope;
    if (v.slope > 0) low = std::max(low, t);
    else if (!high || t < *high) high = t;
    if (high && *high < low) return std::nullopt;
  }
  return std::array<Rational, 2>{low, *high};  // a polygon is bounded
}

Sign Grid_ray::side_within(const Convex_polygon<Exact_traits>& polygon, const Rational& t) const {
  Sign all = CGAL::POSITIVE;
  for (const Corner<Exact_traits>& corner : polygon) {
    const int s = sgn(value(corner.edge.bound)(t));
    if (s < 0) return CGAL::NEGATIVE;
    if (s == 0) all = CGAL::ZERO;
  }
  return all;
}

std::optional<int> winding_along(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray,
                                 const std::vector<int>& times) {
  const Grid_ray grid(traits, ray);
  int winding = 0;
  for (const Exact_tree::Node& node : tree.nodes) {
    const Grid_ray::Line_value v = grid.value(node.plane);
    if (v.slope == 0 && v.at != 0) continue;
    for (const Fragment<Exact_traits>& fragment : tree.on(node)) {
      if (v.slope == 0) {
        if (grid.range_within(fragment.polygon, 0, std::nullopt)) return std::nullopt;
        continue;
      }
      const Rational t = -v.at / v.slope;
      if (t < 0) break;
      const Sign inside = grid.side_within(fragment.polygon, t);
      if (inside == CGAL::ZERO) return std::nullopt;
      if (inside == CGAL::POSITIVE)  // leaving through a front counts
        winding += ((v.slope > 0) == fragment.same_sense ? 1 : -1) * times[fragment.polygon.piece];
    }
  }
  return winding;
}

}  // namespace bsp_detail

Bsp_leaf find_leaf(const Exact_traits& traits, const Exact_tree& tree, const Exact_point& point,
                   Predicate_counts& counts) {
  Bsp_leaf leaf;
  const Located_point q = traits.eye(point);
  for (std::int32_t next = tree.nodes.empty() ? Exact_tree::leaf : 0; next != Exact_tree::leaf;) {
    const Exact_tree::Node& node = tree.nodes[static_cast<std::size_t>(next)];
    const Sign side = traits.side(q, node.plane, counts);
    leaf.node = next;
    leaf.in_front = side != CGAL::NEGATIVE;
    leaf.on_boundary |= side == CGAL::ZERO;
    next = leaf.in_front ? node.front : node.behind;
  }
  return leaf;
}

std::vector<Face_id> faces_at(const Exact_traits& traits, const Exact_tree& tree, const Exact_point& point,
                              Predicate_counts& counts) {
  std::vector<Face_id> faces;
  const Located_point q = traits.eye(point);
  std::vector<std::int32_t> stack;
  if (!tree.nodes.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const Exact_tree::Node& node = tree.nodes[static_cast<std::size_t>(stack.back())];
    stack.pop_back();
    const Sign side = traits.side(q, node.plane, counts);
    if (side != CGAL::NEGATIVE && node.front != Exact_tree::leaf) stack.push_back(node.front);
    if (side != CGAL::POSITIVE && node.behind != Exact_tree::leaf) stack.push_back(node.behind);
    if (side != CGAL::ZERO) continue;
    for (const Fragment<Exact_traits>& fragment : tree.on(node))
      if (std::all_of(fragment.polygon.begin(), fragment.polygon.end(),
                      [&](const auto& corner) { return traits.side(q, corner.edge.bound, counts) != CGAL::NEGATIVE; }))
        faces.push_back(traits.face(fragment.polygon.piece));
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

Point_location locate_point(const Exact_traits& traits, const Exact_tree& tree, const Exact_point& point, bool closed,
                            Predicate_counts& counts) {
  Point_location found{Location::undefined, find_leaf(traits, tree, point, counts),
                       faces_at(traits, tree, point, counts)};
  if (!found.faces.empty()) {
    found.location = Location::on;
  } else if (closed) {
    const std::vector<int> times = times_given(traits.scene());
    // A ray that meets an edge says nothing; only finitely many directions of this curve do.
    for (long k = 1;; ++k) {
      const Exact_ray ray{point, {Rational(1000003), Rational(7919 * k), Rational(104729 + k * k)}};
      if (const std::optional<int> winding = bsp_detail::winding_along(traits, tree, ray, times)) {
        found.location = *winding != 0 ? Location::inside : Location::outside;
        break;
      }
    }
  }
  return found;
}

void bsp_detail::walk_along(
    const Exact_tree& tree, const Grid_ray& grid, const std::function<bool(const Rational&)>& is_beyond,
    const std::function<void(const Fragment<Exact_traits>&, const std::array<Rational, 2>&)>& along,
    const std::function<void(const Fragment<Exact_traits>&, const Rational&, bool)>& at) {
  struct Step {
    std::int32_t node;
    Rational from;               // the ray's part in the node's closed cell
    std::optional<Rational> to;  // none: to infinity
  };
  std::vector<Step> stack;
  const auto push = [&](std::int32_t node, const Rational& from, const std::optional<Rational>& to) {
    if (node != Exact_tree::leaf) stack.push_back({node, from, to});
  };
  if (!tree.nodes.empty()) push(0, 0, std::nullopt);
  while (!stack.empty()) {
    const Step step = std::move(stack.back());
    stack.pop_back();
    if (is_beyond(step.from)) continue;
    const Exact_tree::Node& node = tree.nodes[static_cast<std::size_t>(step.node)];
    const Grid_ray::Line_value v = grid.value(node.plane);
    if (v.slope == 0) {
      if (v.at >= 0) push(node.front, step.from, step.to);
      if (v.at <= 0) push(node.behind, step.from, step.to);
      if (v.at != 0) continue;
      for (const Fragment<Exact_traits>& fragment : tree.on(node))
        if (const auto range = grid.range_within(fragment.polygon, 0, std::nullopt)) along(fragment, *range);
      continue;
    }
    const Rational t = -v.at / v.slope;
    const std::int32_t before = v.slope > 0 ? node.behind : node.front, after = v.slope > 0 ? node.front : node.behind;
    if (t < step.from) {
      push(after, step.from, step.to);
    } else if (step.to && *step.to < t) {
      push(before, step.from, step.to);
    } else {
      push(after, t, step.to);
      push(before, step.from, t);
      for (const Fragment<Exact_traits>& fragment : tree.on(node))
        if (grid.side_within(fragment.polygon, t) != CGAL::NEGATIVE) at(fragment, t, v.slope > 0);
    }
  }
}

std::optional<Ray_hit> first_hit(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray) {
  if (ray.direction[0] == 0 && ray.direction[1] == 0 && ray.direction[2] == 0)
    throw std::domain_error("a ray needs a direction");
  const bsp_detail::Grid_ray grid(traits, ray);
  std::optional<Ray_hit> best;
  const auto offer = [&](const Rational& t, const Fragment<Exact_traits>& fragment) {
    const Face_id face = traits.face(fragment.polygon.piece);
    if (!best || t < best->t ||
        (t == best->t && std::pair(face, fragment.number) < std::pair(best->face, best->number)))
      best = Ray_hit{t, face, fragment.number};
  };
  bsp_detail::walk_along(
      tree, grid, [&](const Rational& from) { return best && best->t < from; },
      [&](const Fragment<Exact_traits>& fragment, const std::array<Rational, 2>& range) { offer(range[0], fragment); },
      [&](const Fragment<Exact_traits>& fragment, const Rational& t, bool) { offer(t, fragment); });
  return best;
}

}  // namespace sightline
