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
  std::vector<Face_id> face_of;     ///< the face before that each is, or is a triangle of
  std::size_t moved = 0;            ///< points
  double farthest = 0;              ///< no coordinate was moved by more
  std::vector<Face_id> not_planar;  ///< faces before, now triangles
  std::vector<Face_id> collapsed;   ///< without area now
  std::vector<Face_id> turned;      ///< whose normals point to the other side of their planes now
  /// Pairs that have a segment in common inside one of them, though the faces before had not, or go through each other
  /// there, though of those one only stood upon the other; a face that crosses itself is a pair.
  std::vector<std::pair<Face_id, Face_id>> crossing;
  /// Where none of these is: faces beside which the surface winds otherwise than once, or not at all, as where a thin
  /// solid is turned inside out and no normal is.
  std::vector<Face_id> misplaced;
  std::size_t rounds = 0, snapped = 0;  ///< of snapping; points that it put elsewhere than at the nearest numbers

  /// Whether it bounds what it goes round: no face is turned over or without area, no pair crosses that did not, and it
  /// winds once round each point, or not at all.
  bool is_sound() const { return faults() == 0; }
  std::size_t faults() const { return collapsed.size() + turned.size() + crossing.size() + misplaced.size(); }
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

/// Rounds likewise, then moves the corners of faces that this breaks: round by round to the nearest point of a grid of
/// the numbers' step, then to another one beside it, then of a grid twice as coarse, ... until the surface is sound.
/// Points that meet become one, and faces without two different neighbours vanish. Post: sound, or, after a bound of
/// rounds (40), what rounded() returns, with that number of rounds. A surface that was closed
/// is closed. Pre, Exact, `progress`: as above. Cost: that of rounded(), for each round.
Rounded_surface snapped(const Polygon_soup& soup, Rounding to, bool triangulate = false,
                        const Rounding_progress& progress = {});

}  // namespace sightline
