#pragma once
// Trees as they are asked for: the planes that they begin with, any number of threads, planes that divide well.

#include "bsp_queries.h"

#include <sightline/algorithms/bsp/order_cuts.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/soups.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace fuzz {

/// Nodes that a tree is to begin with: a plane each of few numbers, the first one the root.
inline std::vector<Bsp_options::Given> any_given_nodes(Scene& scene, Random& random) {
  std::vector<Bsp_options::Given> given;
  for (std::uint64_t k = random.below(5); k > 0; --k) {
    std::array<Integer, 4> plane;
    for (Integer& x : plane) x = static_cast<long>(random.between(-2, 2));
    if (plane[0] == 0 && plane[1] == 0 && plane[2] == 0) plane[random.below(3)] = 1;
    if (!given.empty()) {
      Bsp_options::Given& above = given[random.below(given.size())];
      std::int32_t& child = random.chance(1, 2) ? above.front : above.behind;
      if (child >= 0) continue;
      child = static_cast<std::int32_t>(given.size());
    }
    given.push_back({scene.add_plane(plane)});
  }
  return given;
}

/// Planes that are given are where they were asked for, first ones on every way from the root, then a tree of them;
/// and nodes are in preorder. Small cells are no matter of threads.
inline void given_planes(Random& random) {
  Scene scene(generate::soup_of(any_asked_faces(random).faces));
  Bsp_options options;
  options.threads = random.chance(1, 2) ? 1 : 2;
  options.seed = random.below(1000);
  options.candidates = static_cast<unsigned>(random.below(6));
  options.given = any_given_nodes(scene, random);
  for (const Bsp_options::Given& node : any_given_nodes(scene, random))
    if (random.chance(1, 2)) options.first.push_back(node.plane);
  const Exact_tree tree = build_bsp(Exact_traits(scene), options);

  struct Asked {
    std::int32_t number, given;
    std::size_t depth;
  };
  std::vector<Asked> stack{{tree.nodes.empty() ? Exact_tree::leaf : 0, options.given.empty() ? -1 : 0, 0}};
  std::int32_t count = 0;
  while (!stack.empty()) {
    const Asked asked = stack.back();
    stack.pop_back();
    if (asked.number == Exact_tree::leaf) {
      require(asked.given < 0, "all of a tree that is given is there");
      continue;
    }
    require(asked.number == count++, "nodes are in preorder, front child first");
    const auto& node = tree.nodes[static_cast<std::size_t>(asked.number)];
    std::array<std::int32_t, 2> below{asked.given, asked.given};
    if (asked.depth < options.first.size()) {
      require(node.plane == options.first[asked.depth], "the first planes are the topmost on every way");
    } else if (asked.given >= 0) {
      const Bsp_options::Given& given = options.given[static_cast<std::size_t>(asked.given)];
      require(node.plane == given.plane, "a tree that is given begins behind the first planes");
      below = {given.front, given.behind};
    }
    stack.push_back({node.behind, below[1], asked.depth + 1});
    stack.push_back({node.front, below[0], asked.depth + 1});
  }
  require(count == static_cast<std::int32_t>(tree.nodes.size()), "each node has its place");
}

/// Cells of more than a thousand polygons are divided side by side, into the same tree.
inline void trees_of_threads(Random& random) {
  const std::size_t n = 1000 + random.below(500);
  Scene scene(random.chance(1, 3) ? generate::convex_sphere(n, random.below(100))
                                  : generate::soup(n, 0.05, random.below(1000)));
  Bsp_options options;
  options.seed = random.below(1000);
  options.candidates = 1 + static_cast<unsigned>(random.below(5));
  options.given = any_given_nodes(scene, random);
  options.threads = 1;
  const Exact_traits traits(scene);
  const Exact_tree one = build_bsp(traits, options);
  options.threads = 2 + static_cast<int>(random.below(2));
  const Exact_tree other = build_bsp(traits, options);

  const auto same_node = [](const Exact_tree::Node& a, const Exact_tree::Node& b) {
    return a.plane == b.plane && a.front == b.front && a.behind == b.behind && a.first == b.first && a.count == b.count;
  };
  require(std::equal(one.nodes.begin(), one.nodes.end(), other.nodes.begin(), other.nodes.end(), same_node),
          "threads change no node");
  const auto same_fragment = [&](const Fragment<Exact_traits>& a, const Fragment<Exact_traits>& b) {
    if (a.polygon.piece != b.polygon.piece || a.same_sense != b.same_sense || a.number != b.number ||
        a.polygon.size != b.polygon.size)
      return false;
    return std::equal(a.polygon.begin(), a.polygon.end(), b.polygon.begin(), [&](const auto& p, const auto& q) {
      return traits.position(*p.vertex) == traits.position(*q.vertex);
    });
  };
  require(std::equal(one.fragments.begin(), one.fragments.end(), other.fragments.begin(), other.fragments.end(),
                     same_fragment),
          "threads change no fragment");
  require(one.counters.polygon_tests == other.counters.polygon_tests && one.counters.splits == other.counters.splits &&
              one.counters.depth == other.counters.depth && one.counters.free_planes == other.counters.free_planes,
          "threads change no count");
}

/// Planes that divide well are chosen where there are some: across a convex body, between faces that stand apart, and
/// along many small faces rather than through a large one.
inline void good_planes(Random& random) {
  Bsp_options options;
  options.threads = 1;
  options.seed = random.below(1000);
  switch (random.below(3)) {
    case 0: {
      const Scene scene(generate::convex_sphere(100 + random.below(200), random.below(100)));
      const Exact_tree tree = build_bsp(Exact_traits(scene), options);
      require(tree.counters.free_planes > 0 && 2 * tree.counters.depth < scene.pieces().size(),
              "the tree of a convex body is no chain");
      require(tree.counters.fragments < 3 * tree.counters.pieces, "a convex body is not cut to pieces");
      return;
    }
    case 1: {
      const std::size_t n = 50 + random.below(150);
      const Scene scene(generate::stacked(n));
      const Exact_tree tree = build_bsp(Exact_traits(scene), options);
      require(tree.counters.splits == 0 && tree.nodes.size() == n, "faces that stand apart are not cut");
      require(2 * tree.counters.depth < n, "and divided evenly");
      return;
    }
    default: {
      const long n = 4 + static_cast<long>(random.below(40));
      const auto at = [](long x, const Rational& y, long z) { return Exact_point{Rational(x), y, Rational(z)}; };
      generate::Faces faces{{at(-1, -1, 0), at(n + 1, -1, 0), at(n + 1, 1, 0), at(-1, 1, 0)}};
      for (long i = 0; i < n; ++i) faces.push_back({at(i, 0, 1), at(i, generate::ratio(1, 2), 1), at(i, 0, 2)});
      options.candidates = options.sample = options.split_weight = 100;
      const Scene scene(generate::soup_of(faces));
      require(build_bsp(Exact_traits(scene), options).counters.splits == 0, "a plane that cuts nothing is taken");
    }
  }
}

/// Where planes cut an order from an eye: of the fragments about a cut, as far as they are as deep in the tree, what
/// comes before it is in front of its plane, what follows behind, and neither strictly beyond.
inline void cuts_of_orders(Random& random) {
  const Asked_faces asked = any_asked_faces(random);
  Scene scene(generate::soup_of(asked.faces));
  Bsp_options options;
  options.threads = 1;
  options.seed = random.below(1000);
  options.given = any_given_nodes(scene, random);
  const Exact_traits traits(scene);
  const Exact_tree tree = build_bsp(traits, options);
  std::vector<Plain_face> faces;
  for (const generate::Points& face : asked.faces)
    if (spans_a_plane(face)) faces.emplace_back(face);
  Order_cuts cuts;
  std::vector<generate::Points> drawn;
  traverse_with_cuts(traits, tree, traits.eye(asked_point(faces, random)), &scene, cuts,
                     [&](const Fragment<Exact_traits>& fragment, Sign) {
                       drawn.emplace_back();
                       for (const auto& corner : fragment.polygon)
                         drawn.back().push_back(traits.position(*corner.vertex));
                     });
  require(cuts.depths.size() == drawn.size(), "each fragment has its depth");
  for (const Order_cuts::Cut& cut : cuts.others) {
    const auto ends_at = [&](std::size_t place) {
      return std::any_of(cuts.others.begin(), cuts.others.end(),
                         [&](const Order_cuts::Cut& other) { return other.place == place && other.depth < cut.depth; });
    };
    const auto is_beyond = [&](const generate::Points& corners, int side) {
      return std::any_of(corners.begin(), corners.end(), [&](const Exact_point& p) {
        return sgn(cut.plane[0] * p[0] + cut.plane[1] * p[1] + cut.plane[2] * p[2] + cut.plane[3]) == side;
      });
    };
    for (std::size_t k = cut.place; k > 0 && cuts.depths[k - 1] >= cut.depth && !ends_at(k); --k)
      require(!is_beyond(drawn[k - 1], -1), "what comes before a cut is in front of its plane");
    for (std::size_t k = cut.place; k < drawn.size() && cuts.depths[k] >= cut.depth && !ends_at(k); ++k)
      require(!is_beyond(drawn[k], 1), "what follows a cut is behind its plane");
  }
}

inline void tree_options(std::string_view bytes) {
  Random random(Bytes(bytes).word());
  if (random.chance(1, 3)) return cuts_of_orders(random);
  if (random.chance(1, 40)) trees_of_threads(random);
  else if (random.chance(1, 10)) good_planes(random);
  else given_planes(random);
}

}  // namespace fuzz
