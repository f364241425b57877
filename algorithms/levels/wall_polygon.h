#pragma once
// Convex polygons in planes of a tree, with vertices where three planes meet: what walls are cut from.

#include <sightline/kernel/plane.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/vertex.h>

#include <array>
#include <cstddef>
#include <vector>

namespace sightline::levels_detail {

/// Counterclockwise as seen from the front of its plane. Empty: it has no inside.
struct Wall_polygon {
  struct Corner {
    Vertex vertex;
    Plane bound;  ///< through the edge to the next corner, the inside in its front
  };
  Plane plane;
  std::vector<Corner> corners;
  bool empty() const { return corners.empty(); }
};

/// Parts of a polygon in front of a plane and behind it; what lies in the plane is neither, and says so.
struct Wall_halves {
  Wall_polygon front, behind;
  bool is_in_plane = false;
};

/// Cuts walls, and counts what it met.
class Wall_cutter {
 public:
  explicit Wall_cutter(const Predicates& predicates) : predicates_(predicates) {}

  Wall_halves cut(const Wall_polygon& polygon, Plane plane);
  /// A part of it that is on one side of a plane; empty where it only touches that.
  Wall_polygon in_front(const Wall_polygon& polygon, Plane plane) { return cut(polygon, plane).front; }
  /// What of a plane is within a box, of which the planes are given, low and high by axis, fronts inwards.
  Wall_polygon section(Plane plane, const std::array<std::array<Plane, 2>, 3>& box);

  const Predicates& predicates() const { return predicates_; }
  std::size_t contacts() const { return contacts_; }
  std::size_t splits() const { return splits_; }
  Predicate_counts& counts() { return counts_; }

 private:
  const Predicates& predicates_;
  Predicate_counts counts_;
  std::vector<Sign> sides_;
  std::size_t contacts_ = 0, splits_ = 0;
};

}  // namespace sightline::levels_detail
