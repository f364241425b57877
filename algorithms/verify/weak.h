#pragma once
// Checks what can be seen from polygons without trusting, or sharing a line with, whatever found it: rationals and
// integers only. Laws: proofs/weak_certificate.md (P-72).

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace sightline {

/// The claim "from these polygons, these faces are weakly visible, and these are not". The fragments are the convex
/// pieces of the scene, in any order; all else refers to them by their places.
struct Weak_certificate : Covering {
  std::vector<std::vector<Exact_point>>
      sources;             ///< convex planar polygons, counterclockwise as seen from the side that they look to
  bool two_sided = false;  ///< a fragment's back counts as visible too

  /// Proves that a fragment is visible: a point inside a source and one inside the fragment, with nothing between them.
  struct Sightline {
    std::size_t fragment = 0, source = 0;
    Exact_point from, to;
  };
  std::vector<Sightline> visible;

  /// The line through a corner of a fragment and the next one, in that sense.
  struct Edge {
    std::size_t fragment = 0, corner = 0;
  };
  std::vector<Edge> lines;

  using Form = std::array<Rational, 4>;  ///< (a, b, c, d) is a x + b y + c z + d

  /// A positive multiple of a line's side, times a form in the point of the source and one in the point of the
  /// fragment, where there are such.
  struct Term {
    std::size_t line = 0;  ///< its place in `lines`
    Rational factor;
    std::optional<Form> source, target;
  };
  struct Node {
    enum class Kind { line, cut_source, cut_target, blocked, empty, away } kind = Kind::empty;
    std::size_t index = 0;    ///< line: its place in `lines`; blocked: the place of a fragment
    Form plane;               ///< cut_*
    std::vector<Term> terms;  ///< empty
  };
  /// Proves that nothing of a fragment is visible from a source: a tree over the lines between them, in preorder.
  /// A line has first its positive side, then its negative one; a cut likewise.
  struct Hidden {
    std::size_t fragment = 0, source = 0;
    std::vector<Node> proof;
    std::vector<std::size_t> also = {};  ///< fragments of which a proof of one leaf, or of a polygon, holds as well
    /// A convex polygon that holds all of these fragments, in their plane and looking to where they do, of which the
    /// proof is; empty: it is of the fragments themselves.
    std::vector<Exact_point> target = {};

    /// Calls visit(fragment) for the fragment, then for the others.
    template <class Visit>
    void for_each_fragment(const Visit& visit) const {
      visit(fragment);
      for (const std::size_t other : also) visit(other);
    }
  };
  std::vector<Hidden> hidden;

  std::vector<Face_id> undecided;  ///< faces that nothing is claimed about
};

/// Whether the certificate proves which faces can be seen from the sources: (1) the fragments are the scene (as for
/// orders); (2) each sightline goes from the inside of its source, to its front, to the inside of its fragment, from
/// its front (with `two_sided`, or its back), and no fragment meets it, nor an end of it but in the plane of the source
/// or of the fragment; (3) each tree of a fragment, or of a polygon that holds it, and
/// a source shows that almost no line between them is free; (4)
/// each face that is drawn has a sightline, or a tree for each of its fragments and each source, or is undecided.
/// Degenerate: contact of measure zero is not visibility; a source and a fragment in one plane do not see each other.
/// Pre: none on the certificate; rejects whatever is wrong with it. Post: `why` is one line; where accepted, the counts
/// of faces. Cost: for each sightline the fragments near it, which a tree of boxes finds; linear in the nodes of trees,
/// each in the pairs of corners of what is left of source and fragment. Blocked and empty cells of more than 10^7
/// pairs, and cells below more than 1000 cuts, are rejected. Exact: yes; doubles are asked only for what is surely not
/// near a sightline. Proof: P-21, P-22, P-72
Verdict verify_weak(const Polygon_soup& soup, const Weak_certificate& certificate, const Verify_options& options = {});

}  // namespace sightline
