#include <sightline/algorithms/rays/by_tree.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace sightline {

namespace {

enum class Wanted_hits { first, all };

/// The parts of a ray that fragments hold, nearer cells first; where the first hit is wanted, no cells beyond one.
std::vector<Face_hit> parts_by_tree(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray,
                                    Ray_start start, Wanted_hits wanted) {
  const bsp_detail::Grid_ray grid(traits, ray);
  std::vector<Face_hit> parts;
  std::optional<Rational> first;  // the least t that counts
  const auto add = [&](const Fragment<Exact_traits>& fragment, Met_side side, const Rational& t,
                       const Rational& until) {
    if ((start == Ray_start::closed || t > 0) && (!first || t < *first)) first = t;
    parts.push_back({traits.face(fragment.polygon.piece), side, t, until});
  };
  struct Step {
    std::int32_t node;
    Rational from;  // the ray's part in the node's closed cell
    std::optional<Rational> to;
  };
  std::vector<Step> stack;
  const auto push = [&](std::int32_t node, const Rational& from, const std::optional<Rational>& to) {
    if (node != Exact_tree::leaf) stack.push_back({node, from, to});
  };
  if (!tree.nodes.empty()) push(0, 0, std::nullopt);
  while (!stack.empty()) {
    const Step step = std::move(stack.back());
    stack.pop_back();
    if (wanted == Wanted_hits::first && first && *first < step.from) continue;
    const Exact_tree::Node& node = tree.nodes[static_cast<std::size_t>(step.node)];
    const bsp_detail::Grid_ray::Line_value v = grid.value(node.plane);
    if (v.slope == 0) {
      if (v.at >= 0) push(node.front, step.from, step.to);
      if (v.at <= 0) push(node.behind, step.from, step.to);
      if (v.at != 0) continue;
      for (const Fragment<Exact_traits>& fragment : tree.on(node))
        if (const auto range = grid.range_within(fragment.polygon, 0, std::nullopt))
          add(fragment, Met_side::along, (*range)[0], (*range)[1]);
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
        if (grid.side_within(fragment.polygon, t) != CGAL::NEGATIVE)
          add(fragment, (v.slope < 0) == fragment.same_sense ? Met_side::front : Met_side::back, t, t);
    }
  }
  return parts;
}

}  // namespace

std::vector<Face_hit> all_hits(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray,
                               Ray_start start) {
  check_direction(ray);
  return hits_of(parts_by_tree(traits, tree, ray, start, Wanted_hits::all), start);
}

std::vector<Face_hit> first_hits(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray,
                                 Ray_start start) {
  check_direction(ray);
  std::vector<Face_hit> parts = parts_by_tree(traits, tree, ray, start, Wanted_hits::first);
  // What runs along a face may go on in other fragments, far behind.
  if (std::any_of(parts.begin(), parts.end(), [](const Face_hit& part) { return part.t < part.until; }))
    parts = parts_by_tree(traits, tree, ray, start, Wanted_hits::all);
  return only_first(hits_of(std::move(parts), start));
}

}  // namespace sightline
