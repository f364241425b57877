#pragma once
// What an eye sees, by two trees: near to far through the BSP tree of the scene, with a BSP tree of the directions that
// are covered so far.

#include <sightline/algorithms/bsp/query.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/sign.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sightline {

struct Bsp2d_options {
  bool skip_hidden = true;  ///< passes over subtrees whose box is covered
  int threads = 0;          ///< of building a tree; 0: as many as there are processors. The rest is one after the other
  std::uint64_t seed = 1;   ///< of building a tree
  std::function<void(std::size_t done, std::size_t all)> progress = {};  ///< fragments; may throw to give up
};

struct Bsp2d_counters {
  std::uint64_t nodes = 0, fragments = 0;  ///< of the scene's tree, that were visited
  std::uint64_t nodes_skipped = 0, fragments_skipped = 0,
                faces_skipped = 0;  ///< not visited, behind what was covered; of faces, all fragments
  std::uint64_t hidden = 0;         ///< fragments visited of which nothing was left
  std::uint64_t on_planes = 0;      ///< nodes visited in whose plane the eye is
  std::uint64_t edge_on = 0;        ///< fragments visited in whose plane the eye is
  std::uint64_t cells = 0;          ///< nodes and leaves of the tree of directions
  std::uint64_t clips = 0;          ///< fragments, or parts of them, cut by one of its planes
  Predicate_counts predicates;
  /// Each by its key in reports.
  template <class Visit>
  static void each(Visit visit) {
    visit("nodes", &Bsp2d_counters::nodes);
    visit("fragments", &Bsp2d_counters::fragments);
    visit("nodes_skipped", &Bsp2d_counters::nodes_skipped);
    visit("fragments_skipped", &Bsp2d_counters::fragments_skipped);
    visit("faces_skipped", &Bsp2d_counters::faces_skipped);
    visit("hidden", &Bsp2d_counters::hidden);
    visit("eye_on_planes", &Bsp2d_counters::on_planes);
    visit("edge_on", &Bsp2d_counters::edge_on);
    visit("cells", &Bsp2d_counters::cells);
    visit("clips", &Bsp2d_counters::clips);
    visit("", &Bsp2d_counters::predicates);
  }
};

struct Bsp2d {
  Visible_surface<Exact_view> surface;
  /// The fragments of which an open part is seen, ties included, nearest first: their places in tree.fragments.
  std::vector<std::uint32_t> seen;
  Bsp2d_counters counters;
};

/// What visible_surface() gives in the given cones, which must have no open set in common: parts that fill them, each
/// showing the same; their cuts differ. Fragments come near to far by the scene's tree, and no depth is ever compared.
/// Each is clipped by a tree of planes through the eye, whose leaves are covered or free: what comes to a free leaf is
/// seen, and the leaf is cut along its sides. Nothing goes below a node that is covered whole, and subtrees of the
/// scene's tree are passed over whose box is covered, in doubles to be safe. Pre: the tree is of view.scene().
/// Degenerate: of fragments on one node's plane the one seen from its front comes first, then by face id, then by
/// number; those in whose plane the eye is are not seen; an empty scene is one part for each cone. Cost: fragments
/// visited, each times the leaves that it meets and the way to them; cuts of the scene's tree are edges here, too.
/// Exact: filtered. Ref: the slides' "modern approach"; Naylor, Partitioning tree image representation and generation
/// from 3D geometric models, 1992. Proof: P-84
Bsp2d bsp2d(const Exact_view& view, const Exact_tree& tree, Cones<Exact_view> cones, const Bsp2d_options& options = {});
/// The same by a tree of its own.
Bsp2d bsp2d(const Exact_view& view, Cones<Exact_view> cones, const Bsp2d_options& options = {});

}  // namespace sightline
