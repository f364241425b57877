#pragma once
// A back-to-front order from one eye by the priority graph: whole faces wherever there is such an order, parts of faces only where there is none.

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/priority/scope.h>

namespace sightline {

/// What ordering took.
struct Eye_order_counters {
  std::uint64_t pieces = 0, edge_on = 0;  ///< polygons given; those in whose plane the eye is
  std::uint64_t cycles = 0, in_cycles = 0;  ///< components of more than one face, and faces in them
  std::uint64_t fragments = 0;            ///< polygons drawn: more than pieces only where cycles were cut
  Index_counters search;
  Bsp_counters cuts;                      ///< of the trees of all cycles
};

/// Polygons, farthest first.
template <class Traits>
struct Eye_order {
  std::vector<Convex_polygon<Traits>> polygons;
  Eye_order_counters counters;
  std::vector<Polygon_store<Traits>> memory;  ///< what the polygons point into
};

/// The same polygon seen from behind: corners in the opposite order, each with the edge that now follows it, and the opposite plane.
template <class Traits>
Convex_polygon<Traits> turned_round(const Convex_polygon<Traits>& polygon, Polygon_store<Traits>& store) {
  std::vector<Corner<Traits>> corners;
  for (std::uint32_t k = polygon.size; k-- > 0;) corners.push_back({polygon.corners[k].vertex, polygon.corners[k == 0 ? polygon.size - 1 : k - 1].edge});
  return store.keep(corners, polygon.piece, polygon.support.opposite());
}

/// Each piece of the scene, from both sides, so that none obscures one drawn after it. Faces are turned to the eye; arcs are those of this eye; a component of the graph
/// that is one face is drawn whole, any other is cut by a BSP tree of its own faces. Degenerate: pieces seen edge-on have no arcs, and come first.
/// Cost: a search of the graph, n^2 pairs of round cones at worst, exact only where they overlap. Exact: yes. Pre: exact traits; `options.pieces` and `first` unset.
/// Source: Fuchs, Kedem, Naylor 1979 (their third scope). Proof: P-35
template <Bounded_traits Traits>
Eye_order<Traits> order_by_graph(const Traits& traits, const Exact_point& eye, Bsp_options options = {}) {
  Eye_order<Traits> order;
  Eye_order_counters& counters = order.counters;
  const typename Traits::Eye viewpoint = traits.eye(eye);

  // 1. Turn all faces to the eye.
  Polygon_store<Traits> store;
  std::vector<Convex_polygon<Traits>> pieces, turned;
  for (std::uint32_t i = 0; i < traits.piece_count(); ++i) {
    const Convex_polygon<Traits> polygon = store.piece(traits, i);
    const Sign side = traits.side(viewpoint, polygon.support, counters.cuts.predicates);
    ++counters.pieces;
    if (side == CGAL::ZERO) {
      ++counters.edge_on;
      order.polygons.push_back(polygon);
      continue;
    }
    pieces.push_back(polygon);
    if (side == CGAL::NEGATIVE) {
      turned.push_back(turned_round(polygon, store));
    } else {
      turned.push_back(polygon);
    }
  }

  // 2. The components from this eye, the farthest first.
  const Priority_relation<Traits> faces(traits, turned);
  const Region_relation<Traits> relation(faces, View_region::eye(eye));
  Implicit_priority_graph<Region_relation<Traits>> graph(relation);
  const Priority_components found = graph.find_components(nullptr, options.progress);
  counters.search = graph.counters();
  options.progress = {};
  for (std::size_t c = found.size(); c-- > 0;) {
    if (found[c].size() == 1) {
      order.polygons.push_back(pieces[found[c][0]]);
      continue;
    }

    // 3. A cycle: cut it.
    ++counters.cycles, counters.in_cycles += found[c].size();
    options.pieces.emplace();
    for (const std::uint32_t i : found[c]) options.pieces->push_back(pieces[i].piece);
    Bsp_tree<Traits> tree = build_bsp(traits, options);
    traverse(traits, tree, viewpoint, Direction::back_to_front, [&](const Fragment<Traits>& fragment, Sign) { order.polygons.push_back(fragment.polygon); });
    counters.cuts.splits += tree.counters.splits, counters.cuts.nodes += tree.counters.nodes, counters.cuts.predicates += tree.counters.predicates;
    std::move(tree.memory.begin(), tree.memory.end(), std::back_inserter(order.memory));
  }
  order.memory.push_back(std::move(store));
  counters.fragments = order.polygons.size();
  return order;
}

}  // namespace sightline
