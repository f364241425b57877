#pragma once
// Checks the components of a priority graph and their order from first principles: rationals and integers only, all
// pairs of faces. Laws: proofs/priority.md (P-34).

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <vector>

namespace sightline {

/// The claim "these are the strongly connected components of the priority graph on these polygons, over all viewpoints,
/// highest priority first".
struct Graph_certificate : Covering {
  std::vector<std::size_t> sizes;  ///< of the components: consecutive stretches of the fragments

  /// An arc from < to between members of one component (places among the fragments), by a corner of `from` strictly in
  /// front of `to`'s plane and a corner of `to` strictly behind `from`'s.
  struct Arc {
    std::size_t from, to;
    std::size_t corner_from, corner_to;
  };
  std::vector<Arc> arcs;
};

/// Whether the certificate proves the strongly connected components of the priority graph and a consistent enumeration
/// of them: (1) the fragments are the scene (as for orders), each convex face and each triangle of a face that is not
/// planar one fragment, other faces cut at their own points in any way, which the verdict counts; (2) the arcs hold, by
/// their corners, and join each component both ways; (3) no fragment may obscure one of an earlier component.
/// Degenerate: as the relation (algorithms/priority/relation.h). Cost: quadratic in the fragments. Exact: yes, without
/// filters. Proof: P-21, P-22, P-34
Verdict verify_graph(const Polygon_soup& soup, const Graph_certificate& certificate,
                     const Verify_options& options = {});

}  // namespace sightline
