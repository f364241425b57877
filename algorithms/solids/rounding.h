#pragma once
// What becomes of an exact surface whose points are rounded to floating-point numbers, as most formats hold them.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sightline {

enum class Rounding { to_double, to_float };

/// A rounded surface, and all that it is not any more. Faces are the rounded soup's.
struct Rounded_surface {
  Polygon_soup soup;
  std::vector<Face_id> face_of;     ///< the face before that each is, or is a part of
  std::size_t moved = 0;            ///< points before
  double farthest = 0;              ///< no coordinate of the surface was moved by more, in all rounds together
  std::vector<Face_id> not_planar;  ///< faces before, now triangles, or parts of some
  std::vector<Face_id> turned;      ///< whose normals point to the other side of their planes now
  std::vector<Face_id> collapsed;   ///< without area now
  /// Pairs that have a segment in common inside one of them, though the faces before had not, or go through each other
  /// there, though of those one only stood upon the other; a face that crosses itself is a pair.
  std::vector<std::pair<Face_id, Face_id>> crossing;
  /// Where none of these two is: faces of which not the one side is wound round once and the other not at all, as where
  /// a thin solid is turned inside out and no normal is, or which lie upon others.
  std::vector<Face_id> misplaced;
  std::size_t rounds = 0;          ///< of snapping
  int coarser = 0;                 ///< of snapping: its grid's step is 2^coarser of the numbers'
  std::vector<Point_id> vanished;  ///< by snapping: points before, at whose nearest numbers no corner is
  std::vector<Point_id> added;     ///< by snapping: the surface's points that are nearest to none before

  /// Whether it bounds a solid: no face is without area, no pair crosses that did not, and each has its inside on one
  /// side, wound round once. Slivers may be turned over.
  bool is_sound() const { return faults() == 0; }
  std::size_t faults() const { return collapsed.size() + crossing.size() + misplaced.size(); }
};

using Rounding_progress = std::function<void(std::size_t done, std::size_t total)>;

/// Rounds each coordinate to the nearest number, ties to even. Faces stay as they are if they are planar still, else
/// they become the triangles that they would be cut into exactly. `triangulate`: all faces become triangles.
/// Pre: a closed planar soup without holes that winds once round what is inside, as results do; coordinates within the
/// numbers' range, or std::domain_error. `progress` is told of what is done now and then, never of all; what it throws
/// ends the work. Cost: O(n log n) and the pairs whose boxes meet. Exact: yes, all that it says of the rounded surface.
/// Proof: P-117
Rounded_surface rounded(const Polygon_soup& soup, Rounding to, bool triangulate = false,
                        const Rounding_progress& progress = {});

/// On one grid. Twice as many as any surface has taken that was tried, unless they broke more and more.
inline constexpr std::size_t most_snap_rounds = 40;

/// Rounds likewise; where that is not sound, snaps, in rounds: of the rounded surface, in triangles where faces are not
/// planar any more, the exact surface of what it winds round positively is made, whose new points, where faces crossed,
/// are rounded in the next round, to a grid of the step that the numbers have at their greatest coordinate; every third
/// round to one beside the nearest. Points that meet become one, and faces without two different neighbours vanish.
/// Where `most_rounds` are not enough, or one breaks more than four times as many pairs of faces as the first, and
/// 1,000, the surface is snapped anew, all its points to one grid 16 times as coarse, and so on.
/// Post: sound. Each point before is at its nearest numbers, or no corner any more, unless the grid is `coarser`; then
/// all points are of one grid. Off `farthest` from the surface before, along each axis, what was inside is, and nothing
/// else. Degenerate: what is thinner than the grid's step vanishes, all of it perhaps: no faces then. Pre, Exact,
/// `progress`: as above; most_rounds > 0. Cost: that of rounded() and of a union, of coordinates of few digits, for
/// each round. Ref: Lazard and Valque, Removing self-intersections in 3D meshes while preserving floating-point
/// coordinates. Proof: P-117
Rounded_surface snapped(const Polygon_soup& soup, Rounding to, bool triangulate = false,
                        const Rounding_progress& progress = {}, std::size_t most_rounds = most_snap_rounds);

}  // namespace sightline
