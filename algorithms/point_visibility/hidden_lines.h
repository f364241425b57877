#pragma once
// Hidden lines with provenance: which parts of the scene's edges an eye sees, and which face hides the others, exactly.

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace sightline {

/// What an edge is to its pieces and to the eye.
enum class Edge_class : char {
  boundary,    ///< of one piece
  silhouette,  ///< between pieces that the eye is in front of and others, that it is behind or in the plane of
  smooth,      ///< between two pieces in one plane
  crease       ///< any other
};

/// An edge of the scene: its points, and the pieces that it bounds. Edges between pieces of one face are none.
struct Scene_edge {
  std::uint32_t p, q;  ///< p < q
  std::vector<std::uint32_t> pieces;
};

/// A part of a line, from p + from (q - p) to p + to (q - p).
struct Line_part {
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};
  Rational from, to;
  std::uint32_t hidden_by;  ///< a piece in front of all of it, or nothing: it is visible
};

/// The edges of a scene, by their points. Cost: O(n log n).
std::vector<Scene_edge> scene_edges(const Scene& scene);

Edge_class classify(const Exact_view& view, const Scene_edge& edge);

/// Finds the visible parts of edges in a surface that one eye sees. A point q of an edge is visible iff the open
/// segment from the eye to q meets no closed piece: grazing hides, and what q lies on does not. Up to finitely many
/// points of each edge. Exact: yes. Proof: P-64
class Hidden_lines {
 public:
  /// Pre: the surface is the view's, and both outlive this.
  Hidden_lines(const Exact_view& view, const Visible_surface<Exact_view>& surface);

  /// The parts of an edge within the surface's cones, one after the other. Degenerate: none where the eye is on the
  /// edge's line. Cost: O(depth of the surface) for each region along the edge; edges in the plane of edge-on pieces
  /// are held to each of these.
  std::vector<Line_part> parts(std::uint32_t p, std::uint32_t q) const;

 private:
  using Ray = Exact_view::Ray;
  static constexpr std::uint32_t nothing = Line_part::nothing;

  /// Where an arc of the edge ends: at a ray in the edge's plane.
  struct Arc {
    Ray from, to;
  };
  struct Walk {
    std::uint32_t p, q;
    Exact_view::Plane plane;
    std::array<Integer, 3> to_p, to_q;      // from the eye
    std::vector<Line_part> within, hidden;  // in the cones; behind pieces
    Predicate_counts counts;
  };

  // ---- Down the trees

  /// The parts in front of a plane and behind it; both where the arc is in the plane.
  std::array<std::optional<Arc>, 2> cut(Walk& walk, const Arc& arc, const Exact_view::Plane& w) const;
  void clip(Walk& walk, std::size_t cone) const;
  void descend(Walk& walk, std::int32_t root, const Arc& whole) const;

  /// What a piece that covers all of an arc hides of the edge there: what is strictly beyond its plane.
  void hide(Walk& walk, const Arc& arc, std::uint32_t piece) const;
  /// Over a piece's plane, in grid coordinates.
  Rational height(std::uint32_t piece, std::uint32_t point) const;
  /// Where on the edge a ray of its plane meets it: s with p + s (q - p) along the ray, p and q as seen from the eye.
  Rational parameter(const Walk& walk, const Ray& r) const;

  // ---- Pieces that are edge-on

  /// They hide nothing but edges in their own plane.
  void hide_behind_edge_on(Walk& walk) const;
  /// In the plane of the eye and the edge a point is eye + x (p - eye) + y (q - eye); it is in front of the edge iff x,
  /// y >= 0 and 0 < x + y < 1, at s = y / (x + y).
  void hide_behind_edge_on(Walk& walk, std::uint32_t piece) const;

  // ---- Together

  /// What is within the cones, cut where what hides it changes.
  static std::vector<Line_part> in_order(Walk& walk);

  const Exact_view& view_;
  const Visible_surface<Exact_view>& surface_;
  Predicates predicates_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> edge_on_;  // pieces by plane
};

struct Drawn_edge {
  Scene_edge edge;
  Edge_class kind;
  std::vector<Line_part> parts;
};

/// All edges of a scene with their parts within the surface's cones, by their points. Pre: the surface is the view's.
/// Threads: 0: as many as there are processors; the result is the same for any number. Exact: yes. Proof: P-64
std::vector<Drawn_edge> hidden_lines(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                     int threads = 0);

}  // namespace sightline
