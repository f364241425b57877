#pragma once
// What a scene holds ready for searches among lines: planes and edges in doubles, boxes, and which pieces a bundle of
// lines can meet at all.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/kernel/located_point.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace sightline {

/// The pieces of a scene as occluders. Doubles propose; sides are exact where they are asked for. It serves any number
/// of threads. Cost: O(n log n)
class Occluders {
 public:
  explicit Occluders(const Scene& scene);
  explicit Occluders(Scene&&) = delete;

  const Scene& scene() const { return *scene_; }
  const Near_frame& frame() const { return frame_; }
  const Near_plane& plane(std::uint32_t piece) const { return planes_[piece]; }
  const Piece_boxes& boxes() const { return boxes_; }
  std::size_t size(std::uint32_t piece) const { return scene_->pieces()[piece].size; }
  std::span<const Pluecker> edges(std::uint32_t piece) const { return {edges_.data() + first_[piece], size(piece)}; }
  std::span<const Triple> corners(std::uint32_t piece) const { return {corners_.data() + first_[piece], size(piece)}; }
  /// The points of a piece's edge, from corner `corner` to the next.
  std::array<std::uint32_t, 2> edge_points(std::uint32_t piece, std::size_t corner) const {
    const std::span<const Piece_corner> all = scene_->corners(scene_->pieces()[piece]);
    return {all[corner].point, all[(corner + 1) % all.size()].point};
  }
  std::array<Integer, 3> grid_point(std::uint32_t point) const {
    return {grid(point, 0), grid(point, 1), grid(point, 2)};
  }
  Triple near_point_of(std::uint32_t point) const { return near(point); }
  /// A point that need not be one of the scene. Exact: yes.
  Near_point located(const Exact_point& p) const {
    const Located_point at = scene_->locate(p);
    return near_point(frame_, {at.x, at.y, at.z, at.w});
  }
  /// What its coordinates leave, as in Near_point.
  Triple rest_of(std::uint32_t point) const { return rests_.empty() ? Triple{} : rests_[point]; }
  Near_polygon polygon(std::uint32_t piece) const;
  /// The pieces that have a corner at a point, in order.
  std::span<const std::uint32_t> pieces_at(std::uint32_t point) const {
    return {pieces_at_.data() + first_at_[point], first_at_[point + 1] - first_at_[point]};
  }
  /// Where a piece is: side(h, polygon(piece)). Exact: yes.
  int side_of(std::uint32_t piece, const Near_plane& h) const;
  Exact_pluecker exact_pluecker_of(const std::array<std::uint32_t, 2>& points) const {
    return pluecker_of_edge(grid_point(points[0]), grid_point(points[1]));
  }

  /// The sign of side(p, q, e) for the line e from one point of the scene to another one, where all four are integers
  /// of at most 40 bits; else nothing. Exact: yes. Proof: P-70
  std::optional<int> small_side(const Near_point& p, const Near_point& q,
                                const std::array<std::uint32_t, 2>& points) const;

  /// All pieces that meet a segment between the two polygons, and others that no plane beside both of them keeps away;
  /// by rank. Exact: none is missing. Proof: P-70
  std::vector<std::uint32_t> near_shaft(const Near_polygon& s, const Near_polygon& t) const;
  /// Of a piece in the tree of boxes: those that are near each other mostly have ranks that are.
  std::uint32_t rank(std::uint32_t piece) const { return first_[piece]; }

  /// The pieces that the segment from p to q may cross, by rank: but for those with both ends on one side, and those
  /// that it passes outside an edge, by more than `margin` of the plane's value or the edge's. In doubles, for
  /// proposals.
  std::vector<std::uint32_t> near_segment(const Triple& p, const Triple& q, double margin) const;
  using Segment = std::array<Triple, 2>;
  /// Of the pieces that a segment crosses, inside all of their edges, the first one that is accepted; only in boxes
  /// that the segments `beside` it meet, too (a piece of more than 32 corners has several boxes, and may be passed
  /// over). In doubles, for proposals.
  std::optional<std::uint32_t> on_segment(const Segment& segment, const std::function<bool(std::uint32_t)>& accept,
                                          std::span<const Segment> beside = {}) const;
  /// Those from either of two points to either of two others: what blocks all lines between their surroundings is in
  /// boxes that all four meet.
  static std::array<Segment, 4> segments_between(const Segment& from, const Segment& to) {
    return {{{from[0], to[0]}, {from[1], to[1]}, {from[0], to[1]}, {from[1], to[0]}}};
  }

  /// Whether one piece blocks all lines from the inside of a source to that of a target: its plane is between them, and
  /// on no pair of corners does a line pass an edge outside. `pairs`: of the corners, those of the target next to each
  /// other. Exact: yes. Proof: P-70
  bool blocks_all(std::uint32_t piece, const Near_polygon& source, const Near_polygon& target,
                  std::span<const Pluecker> pairs) const;

  /// What a ray hits first, in doubles: the piece, and whether from its front; nothing within a billionth of its length
  /// 1 counts. For samples. Exact: no
  struct Hit {
    std::uint32_t piece;
    bool front;
  };
  std::optional<Hit> first_hit(const Triple& p, const Triple& direction) const;

  /// A closed piece that the closed segment from p to q meets, if there is one, other than those in the plane of the
  /// polygon that p or q is inside of: those meet only that end, also of all segments near this one. A segment within a
  /// piece's plane counts as meeting it where their boxes meet. So where there is none, all segments near this one are
  /// free; where there is one, that is certain but for such planes. Exact: yes.
  std::optional<std::uint32_t> blocker(const Near_point& p, const Near_point& q, const Near_plane& of_p,
                                       const Near_plane& of_q) const;

 private:
  /// A piece for those who walk the tree of boxes.
  struct Entry {
    std::array<double, 4> plane;  // as in Near_plane
    std::uint32_t piece, first, size;
  };
  std::span<const Entry> entries_of(const Piece_boxes::Node& node) const {
    return {entries_.data() + node.first, node.count};
  }
  std::span<const Pluecker> edges_of(const Entry& entry) const { return {edges_.data() + entry.first, entry.size}; }
  std::span<const Triple> corners_of(const Entry& entry) const { return {corners_.data() + entry.first, entry.size}; }

  /// By rank, each once: as they come from the tree, but for those with several chunks.
  void put_in_order(std::vector<std::uint32_t>& pieces) const;

  void list_pieces_at_points();

  Integer grid(std::uint32_t point, int axis) const { return scene_->points().integer(point, axis); }
  Triple near(std::uint32_t point) const {
    return {frame_.near(*scene_, point, 0), frame_.near(*scene_, point, 1), frame_.near(*scene_, point, 2)};
  }

  template <class Open, class Visit>
  void each_box(Open open, Visit visit) const;

  bool meets(std::uint32_t piece, const Near_point& p, const Near_point& q, const Near_plane& of_p,
             const Near_plane& of_q, const Exact_pluecker& pair, const Pluecker& near_pair) const;

  /// Whether doubles tell that such a line passes outside of an edge, or that the plane is not between them.
  bool lets_pass(std::uint32_t piece, const Near_polygon& source, const Near_polygon& target,
                 std::span<const Pluecker> pairs) const;

  const Scene* scene_;
  Near_frame frame_;
  Piece_boxes boxes_;
  std::vector<Near_plane> planes_;
  std::vector<Triple> rests_;         // by point; none where all are 0
  std::vector<Entry> entries_;        // of the chunks of boxes_, one for each
  std::vector<std::uint32_t> first_;  // by piece, in the two that follow: in the order of the tree
  std::vector<Triple> corners_;
  std::vector<Pluecker> edges_;
  std::vector<std::uint32_t> first_at_, pieces_at_;  // by point: of the pieces at it, the first one's place
};

}  // namespace sightline
