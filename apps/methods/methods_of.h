#pragma once
// The work of methods.h for one kernel, as templates: two files compile them, side by side.

#include "methods.h"

#include <sightline/algorithms/bsp/kernels.h>
#include <sightline/algorithms/bsp/order_cuts.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/lockstep_traits.h>
#include <sightline/kernel/traits/point_traits.h>

#include <type_traits>

namespace sightline::app {

template <class Traits>
Outcome run_traits(const Scene& scene, const Traits& traits, const Task& task, Bsp_options options) {
  Outcome outcome;
  const Stopwatch build_watch;
  const Bsp_tree<Traits> tree = build_bsp(traits, options);
  outcome.build_seconds = build_watch.seconds();
  outcome.tree = tree.counters;
  if (!task.eye) return outcome;

  std::vector<std::pair<const Fragment<Traits>*, Sign>> order;
  order.reserve(tree.fragments.size());
  const Stopwatch order_watch;
  const Scene* const of_planes = std::is_same_v<Traits, Exact_traits> ? &scene : nullptr;
  outcome.walk = traverse_with_cuts(traits, tree, traits.eye(*task.eye), of_planes, outcome.cuts,
                                    [&](const Fragment<Traits>& fragment, Sign side) {
                                      order.emplace_back(&fragment, fragment.same_sense ? side : -side);
                                    });
  outcome.order_seconds = order_watch.seconds();
  if (!task.keep_fragments) return outcome;

  // With a near plane at the root, what is behind the plane was drawn after all else or before it; take the part in
  // front.
  const Fragment<Traits>* behind_begin = nullptr;
  const Fragment<Traits>* behind_end = nullptr;
  if (task.near && !tree.nodes.empty()) {
    const auto& root = tree.nodes[0];
    const auto first_of = [&](std::int32_t node) {
      return tree.fragments.data() + (node == Bsp_tree<Traits>::leaf
                                          ? tree.fragments.size()
                                          : tree.nodes[static_cast<std::size_t>(node)].first);
    };
    behind_begin = first_of(root.behind);
    behind_end = tree.fragments.data() + tree.fragments.size();  // preorder: the back child comes last
  }
  outcome.drawn.reserve(order.size());
  for (const auto& [fragment, side] : order) {
    if (options.progress && outcome.drawn.size() % 64 == 0) options.progress(outcome.drawn.size(), order.size());
    if (behind_begin != nullptr && fragment >= behind_begin && fragment < behind_end) continue;
    const Piece& piece = scene.pieces()[fragment->polygon.piece];
    Drawn drawn{{piece.face, piece.number, {}}, fragment->number, side};
    try {
      for (const Corner<Traits>& corner : fragment->polygon)
        drawn.fragment.vertices.push_back(traits.position(*corner.vertex));
    } catch (const std::domain_error&) {
      ++outcome.not_finite;
      continue;
    }
    outcome.drawn.push_back(std::move(drawn));
  }
  if (outcome.drawn.size() != order.size()) outcome.cuts = {};
  return outcome;
}

template <class K>
Outcome run_points(const Scene& scene, const Task& task, std::optional<Plane> near) {
  Point_traits<K> traits(scene);
  Bsp_options options = task.bsp;
  if (near) options.first.push_back(traits.add_plane(scene.file_coefficients(*near)));
  return run_traits(scene, traits, task, options);
}

template <class K>
Lockstep run_in_lockstep(const Scene& scene, const Task& task) {
  const Exact_traits truth(scene);
  const Point_traits<K> judged(scene);
  const Lockstep_traits<Exact_traits, Point_traits<K>> both(truth, judged);
  const auto tree = build_bsp(both, task.bsp);
  if (task.eye) traverse(both, tree, both.eye(*task.eye), Direction::back_to_front, [](const auto&, Sign) {});
  const auto mistakes = both.mistakes();
  return {mistakes.asked, mistakes.opposite, mistakes.false_zero, mistakes.missed_zero};
}

Outcome run_double(const Scene& scene, const Task& task, std::optional<Plane> near);
Outcome run_float(const Scene& scene, const Task& task, std::optional<Plane> near);
Outcome run_epick(const Scene& scene, const Task& task, std::optional<Plane> near);
Outcome run_epeck(const Scene& scene, const Task& task, std::optional<Plane> near);
Outcome run_gmpq(const Scene& scene, const Task& task, std::optional<Plane> near);

}  // namespace sightline::app
