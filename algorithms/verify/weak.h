#pragma once
// Checks what can be seen from polygons without trusting, or sharing a line with, whatever found it: rationals and
// integers only. Laws: proofs/weak_certificate.md (P-72). To be read in one sitting, from top to bottom, after
// covering.h and weak_lines.h.

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/weak_lines.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
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
  };
  std::vector<Hidden> hidden;

  std::vector<Face_id> undecided;  ///< faces that nothing is claimed about
};

namespace weak_check {

/// A step of the check that would need more products than this, or a leaf whose multipliers have more bits on their
/// common denominator, is rejected.
inline constexpr std::size_t most_products = 10'000'000;
/// The same for cuts that are below one another: each gives a cell a corner more at most.
inline constexpr std::size_t most_cuts = 1000;

// ---- Visible

/// Checks sightlines against all fragments; those whose boxes of coordinates are apart are passed over.
class Sightlines {
 public:
  Sightlines(const Weak_certificate& certificate, const std::vector<Outline>& fragments,
             const std::vector<Outline>& sources);

  /// Rejects unless nothing is between the end points, nor near them but what is in the plane of the source or of the
  /// fragment. Proof: P-72a, P-72b
  void check(std::size_t k) const;

 private:
  struct Box {
    std::size_t place;
    Exact_point low, high;

    Box(std::size_t of, const Polygon& points);
    bool apart(const Box& other) const;
  };
  std::string full_name(std::size_t i) const {
    return name("fragment", i) + " (" + name("face", certificate_.fragments[i].face) + ")";
  }

  const Weak_certificate& certificate_;
  const std::vector<Outline>&fragments_, &sources_;
  std::vector<Box> boxes_;
};

// ---- Hidden

/// A form times a common denominator, and that.
struct Scaled_form {
  Homogeneous values;
  Integer scale;

  explicit Scaled_form(const Weak_certificate::Form& form);
};

/// Checks the proofs that a fragment is hidden from a source.
class Trees {
 public:
  using Node = Weak_certificate::Node;
  using Term = Weak_certificate::Term;

  Trees(const Weak_certificate& certificate, const std::vector<Outline>& fragments,
        const std::vector<Outline>& sources);

  std::size_t leaves() const { return leaves_; }

  /// Rejects unless the tree is one, and each of its leaves holds. `step` is called now and then.
  /// Cost: linear in the nodes, each in the pairs of corners of a cell at most; no recursion. Proof: P-72c .. P-72f
  void check(std::size_t k, const std::function<void()>& step);

 private:
  std::string entry() const {
    return name("hidden", entry_) + " (" + name("face", certificate_.fragments[fragment_].face) + ")";
  }
  [[noreturn]] void refuse(const std::string& why) const {
    reject(entry() + ", " + name("node", node_) + " " + why, {fragment_});
  }

  void decide(std::size_t line, int sign) {
    trail_.push_back({line, path_[line]});
    path_[line] = sign;
  }
  /// 0: undecided.
  int decided(std::size_t line) const { return line < path_.size() ? path_[line] : 0; }

  std::shared_ptr<Cell> cell_of(std::shared_ptr<const Corners> source, std::shared_ptr<const Corners> target,
                                std::size_t cuts) const;

  std::pair<std::shared_ptr<Cell>, std::shared_ptr<Cell>> halves(const Cell& cell, const Node& node) const;

  void check_leaf(Cell& cell, const Node& node);

  /// Nothing of the fragment's part is in front of the source, or nothing of the source's part sees the fragment's
  /// front.
  void check_away(const Cell& cell) const;

  /// All lines of the cell cross the fragment's plane between their ends, inside the fragment. Proof: P-72d
  void check_blocked(Cell& cell, std::size_t f);

  Cell::Signs signs_of(Cell& cell, std::size_t line) const;

  /// What is positive on all of the cell's lines adds up to what is positive on none. Proof: P-72e
  void check_empty(const Cell& cell, const std::vector<Term>& terms) const;

  const Weak_certificate& certificate_;
  const std::vector<Outline>&fragments_, &sources_;
  Lines lines_;                                     // those of the certificate, then those of blockers
  std::vector<Lines::Named> named_;                 // the certificate's
  std::vector<std::vector<Lines::Named>> edges_;    // of fragments that block, when they first do
  std::vector<int> path_;                           // signs of numbered lines
  std::vector<std::pair<std::size_t, int>> trail_;  // lines decided, and what was there before
  std::size_t entry_ = 0, node_ = 0, source_ = 0, fragment_ = 0, leaves_ = 0;
};

// ---- The certificate

/// The certificate, step by step; throws a Rejection. Returns what was shown, in one line.
std::string check(const Polygon_soup& soup, const Weak_certificate& certificate, const Verify_options& options);

}  // namespace weak_check

/// Whether the certificate proves which faces can be seen from the sources: (1) the fragments are the scene (as for
/// orders); (2) each sightline goes from the inside of its source, to its front, to the inside of its fragment, from
/// its front (with `two_sided`, or its back), and no fragment meets it, nor an end of it but in the plane of the source
/// or of the fragment; (3) each tree of a fragment and a source shows that almost no line between them is free; (4)
/// each face that is drawn has a sightline, or a tree for each of its fragments and each source, or is undecided.
/// Degenerate: contact of measure zero is not visibility; a source and a fragment in one plane do not see each other.
/// Pre: none on the certificate; rejects whatever is wrong with it. Post: `why` is one line; where accepted, the counts
/// of faces. Cost: fragments times sightlines, most by their boxes; linear in the nodes of trees, each in the pairs of
/// corners of what is left of source and fragment. Cells of more than 10^7 pairs or below more than 1000 cuts are
/// rejected. Exact: yes, without filters. Proof: P-21, P-22, P-72
inline Verdict verify_weak(const Polygon_soup& soup, const Weak_certificate& certificate,
                           const Verify_options& options = {}) {
  return certificate_check::verdict_of([&] { return weak_check::check(soup, certificate, options); });
}

}  // namespace sightline
