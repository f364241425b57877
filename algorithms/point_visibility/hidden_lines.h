#pragma once
// Hidden lines with provenance: which parts of the scene's edges, and of the lines where faces cross, an eye sees, and
// which face hides the others, exactly.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/crossings.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/scene_edges.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/located_point.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
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

/// A part of a line, from p + from (q - p) to p + to (q - p).
struct Line_part {
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};
  Rational from, to;
  std::uint32_t hidden_by;  ///< a piece in front of all of it, or nothing: it is visible
};

Edge_class classify(const Exact_view& view, const Scene_edge& edge);

/// Finds the visible parts of lines in a surface that one eye sees. A point q of a line is visible iff the open segment
/// from the eye to q meets no closed piece: grazing hides, and what q lies on does not. Up to finitely many points of
/// each line. Exact: yes. Proof: P-64
class Hidden_lines {
 public:
  /// Pre: the surface is the view's, and both outlive this.
  Hidden_lines(const Exact_view& view, const Visible_surface<Exact_view>& surface);
  Hidden_lines(Exact_view&&, const Visible_surface<Exact_view>&) = delete;
  Hidden_lines(const Exact_view&, Visible_surface<Exact_view>&&) = delete;

  /// The parts of an edge within the surface's cones, one after the other. Degenerate: none where the eye is on the
  /// edge's line. Cost: O(depth of the surface) for each region along the edge; edges in the plane of edge-on pieces
  /// are held to each of these.
  std::vector<Line_part> parts(std::uint32_t p, std::uint32_t q) const;

  /// The same for a line where faces cross, from its first end to its second. Degenerate: none where the eye is in the
  /// plane of one of these faces, which then hide it (or is on the line).
  std::vector<Line_part> parts(const Crossing& crossing) const;

 private:
  using Ray = Exact_view::Ray;
  static constexpr std::uint32_t nothing = Line_part::nothing;

  /// Where an arc of the line ends: at a ray in the plane of eye and line.
  struct Arc {
    Ray from, to;
  };
  struct Walk {
    Exact_view::Plane plane;
    Arc arc;                                          // all of the line
    std::array<Integer, 3> to_p, to_q;                // its ends, from the eye
    Integer scale;                                    // the unit of these, of a direction's
    std::vector<Line_part> within = {}, hidden = {};  // in the cones; behind pieces
    Predicate_counts counts = {};
  };
  std::vector<Line_part> parts(Walk& walk) const;

  // ---- Lines where faces cross

  /// From the eye to an end, times the last coordinate of the end.
  std::array<Integer, 3> direction(const Crossing_end& end) const;
  /// Whether it is a corner, or on an edge that is not in w, of which it has the line's plane.
  bool has_ray(const Crossing_end& end, const Exact_view::Plane& w, Predicate_counts& counts) const;
  /// The ray of an end of a line in plane w, along a direction that it has. Pre: it has one.
  Ray towards(const Crossing_end& end, const Exact_view::Plane& w, const std::array<Integer, 3>& direction,
              Predicate_counts& counts) const;
  /// What a crossing has of parts of a longer piece of its line, by its own ends.
  static std::vector<Line_part> between(const std::vector<Line_part>& parts, const std::array<Crossing_end, 2>& longer,
                                        const std::array<Crossing_end, 2>& ends);

  // ---- Down the trees

  /// The parts in front of a plane and behind it; both where the arc is in the plane.
  std::array<std::optional<Arc>, 2> cut(Walk& walk, const Arc& arc, const Exact_view::Plane& w) const;
  void clip(Walk& walk, std::size_t cone) const;
  void descend(Walk& walk, std::int32_t root, const Arc& whole) const;

  /// What a piece that covers all of an arc hides of the line there: what is strictly beyond its plane.
  void hide(Walk& walk, const Arc& arc, std::uint32_t piece) const;
  /// Whether an end is beyond a piece's plane (which does not hold the eye), or on it, and its height over that, up to
  /// one factor for both ends of a walk.
  Sign beyond(Walk& walk, std::uint32_t piece, const Ray& end, const std::array<Integer, 3>& to_end) const;
  bool is_on(Walk& walk, std::uint32_t piece, const Ray& end, const std::array<Integer, 3>& to_end) const;
  Integer height(const Walk& walk, std::uint32_t piece, const std::array<Integer, 3>& to_end) const;
  /// Where on the line a ray of its plane meets it: s with p + s (q - p) along the ray, p and q as seen from the eye.
  Rational parameter(const Walk& walk, const Ray& r) const;

  // ---- Pieces that are held to a line by themselves

  /// A side of a cone that no other cone has from its other side, and what meets its plane: there the surface does not
  /// know what is outside.
  struct Rim {
    Exact_view::Plane plane;
    std::vector<std::uint32_t> pieces;
  };
  void find_rims();
  bool is_rim(std::size_t cone, std::size_t side) const;

  void hide_along_rims(Walk& walk) const;
  /// What is edge-on is in no part of the surface. It hides nothing but lines in its own plane.
  void hide_behind_edge_on(Walk& walk) const;
  /// The directions in an edge-on plane, around the eye, in which something may be: as doubles say, and more.
  struct Turn {
    double middle, half;  ///< angles; half is more than a half turn where all directions are
    bool meets(const Turn& other) const;
  };
  static Turn turn_of(const std::vector<std::array<Integer, 3>>& directions, std::size_t axis);
  /// What one piece hides, by itself. In the plane of the eye and the line a point is eye + x (p - eye) + y (q - eye);
  /// it is in front of the line iff x, y >= 0 and 0 < x + y < 1, at s = y / (x + y).
  void hide_behind(Walk& walk, std::uint32_t piece) const;
  /// What a piece and the plane of the eye and the line have in common, in these coordinates: the corners of a polygon,
  /// the ends of a segment, or a point.
  using Flat = std::array<Rational, 2>;
  std::vector<Flat> section(const Walk& walk, std::uint32_t piece) const;

  // ---- Together

  /// What is within the cones, cut where what hides it changes.
  static std::vector<Line_part> in_order(Walk& walk);

  const Exact_view& view_;
  const Visible_surface<Exact_view>& surface_;
  Predicates predicates_;
  Located_point eye_;
  /// Pieces in a plane that holds the eye, which is not parallel to the axis.
  struct Edge_on_plane {
    std::size_t axis = 0;
    std::vector<std::uint32_t> pieces = {};
    std::vector<Turn> turns = {};  ///< of each piece
  };
  std::map<std::uint32_t, Edge_on_plane> edge_on_;
  std::vector<Rim> rims_;
};

/// What is done, of how much; from any thread.
using Line_progress = std::function<void(std::size_t done, std::size_t all)>;

struct Drawn_edge {
  Scene_edge edge;
  Edge_class kind;
  std::vector<Line_part> parts;
};

/// All edges of a scene with their parts within the surface's cones, by their points. Pre: the surface is the view's.
/// Threads: 0: as many as there are processors; the result is the same for any number. Any of them tells how many lines
/// are done; what `progress` throws ends it. Exact: yes. Proof: P-64
std::vector<Drawn_edge> hidden_lines(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                     int threads = 0, const Line_progress& progress = {});

/// A visible stretch of a line where faces cross, in the file's coordinates.
struct Drawn_crossing {
  std::vector<Face_id> faces;  ///< that cross there, ascending
  std::array<Exact_point, 2> ends;
};

/// Where faces cross in what is seen: each open segment of `crossings(scene, boxes)` within the surface's cones that is
/// visible, as long as can be. The same segments in any order of the faces. Pre: surface and boxes are the view's.
/// Threads and progress as above. Exact: yes. Proof: P-64, P-65
std::vector<Drawn_crossing> visible_crossings(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                              const Piece_boxes& boxes, int threads = 0,
                                              const Line_progress& progress = {});

}  // namespace sightline
