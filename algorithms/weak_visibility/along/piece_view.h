#pragma once
// What stands before one piece, as a moving eye has it: the piece, what may hide it, and the lines of their edges.

#include <sightline/algorithms/verify/along.h>
#include <sightline/algorithms/weak_visibility/along/along_scene.h>
#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>
#include <sightline/algorithms/weak_visibility/line_space.h>

#include <cstdint>
#include <deque>
#include <map>
#include <vector>

namespace sightline {

/// A convex cone of directions: its sides in order, so that two that follow each other meet in a ray, along the product
/// of their normals.
using Eye_cone = std::vector<Line_side>;

/// One piece from one side. A blocker is what of another piece is in front of the piece's plane, on that side; those
/// that are out of the way on all of the path are left out. It refers to the scene. Proof: P-87
class Piece_view {
 public:
  using Blockers = std::vector<std::uint32_t>;  ///< by number

  /// `side`: 1 from the front, -1 from behind. Cost: O(1) for each other piece.
  Piece_view(const Along_scene& scene, std::uint32_t piece, int side);
  Piece_view(const Piece_view&) = delete;
  Piece_view& operator=(const Piece_view&) = delete;

  const Along_scene& scene() const { return *scene_; }
  const Moving_eye& eye() const { return scene_->eye(); }
  const Eye_polygon& target() const { return *target_; }
  const Near_plane& plane() const { return plane_; }
  int side() const { return side_; }
  const Eye_cone& whole() const { return whole_; }  ///< of all of the piece
  const Eye_polygon& blocker(std::uint32_t number) const { return *blockers_[number]; }
  std::size_t blocker_count() const { return blockers_.size(); }
  Blockers all_blockers() const;
  /// Those that are not certainly out of the way throughout a range.
  Blockers left_in(const Parameter_range& range, const Blockers& all) const;

  /// The scene's lines, and behind them those in which blockers meet the piece's plane.
  const Eye_line& line(std::uint32_t number) const;
  std::uint32_t line_count() const { return static_cast<std::uint32_t>(scene_->lines().size() + own_.size()); }
  /// A side as certificates have it, by an edge or by the piece whose plane meets this one's.
  Along_certificate::Side named(const Line_side& side) const;
  /// The eye's side of the piece's plane: 1 where it is on the side from which it looks.
  int side_of_eye(const Quadratic_root& t) const { return side_ * t.sign_of(target_->eye_side); }

 private:
  std::uint32_t number_of(const Exact_pluecker& line, std::uint32_t piece);
  void add_blocker(std::uint32_t piece);
  bool is_out_of_the_way(const Eye_polygon& polygon, const Parameter_range& range) const;

  const Along_scene* scene_;
  const Eye_polygon* target_;
  Near_plane plane_;
  int side_;
  Eye_cone whole_;
  std::vector<const Eye_polygon*> blockers_;
  std::deque<Eye_polygon> parts_;  // blockers that are parts of pieces
  std::vector<Eye_line> own_;
  std::vector<std::uint32_t> own_pieces_;  // that meet the piece's plane there
  std::map<Exact_pluecker, std::uint32_t, Less_entries> own_numbers_;
};

}  // namespace sightline
