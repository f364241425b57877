#pragma once
// Faces of a soup as points, and boundaries as chains. To be read after polygons.h.

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sightline::certificate_check {

/// A face of the soup as points: consecutive repetitions dropped; if it is planar, holes turned so that they run
/// against the outer loop, or, if that has no front, clockwise as seen from the side that `plane` has in front.
struct Face {
  std::vector<Polygon> loops;
  bool planar = true;
  bool has_front = false;  // the outer loop's Newell normal is not zero
  Plane plane;  // of a planar face; if it has no front, either side of its plane; if all points are collinear, zero

  Face(const Polygon_soup& soup, Face_id f);

 private:
  Integer_vector some_normal() const;
};

/// A sum of directed segments as a chain: two sums are the same chain iff on each line, at each point, the net number
/// of arrivals is the same. A line through a known point is its direction, so the key is (direction up to sign, point).
/// Segments with the same two ends cancel first. Proof: P-21b
class Boundary_chain {
 public:
  void add(const Polygon& loop, long multiplicity);
  void add(const std::vector<Polygon>& loops, long multiplicity) {
    for (const Polygon& loop : loops) add(loop, multiplicity);
  }
  /// A point where the chain is not zero, if there is one.
  std::optional<Exact_point> nonzero() const;

 private:
  struct Hash {
    std::size_t operator()(const Exact_point& p) const;
    std::size_t operator()(const std::pair<std::size_t, std::size_t>& ends) const {
      return ends.first * 0x9e3779b97f4a7c15 + ends.second;
    }
  };
  std::size_t number_of(const Exact_point& p);

  std::vector<Exact_point> points_;
  std::unordered_map<Exact_point, std::size_t, Hash> numbers_;
  std::unordered_map<std::pair<std::size_t, std::size_t>, long, Hash> net_;  // from the earlier point to the later one
};

}  // namespace sightline::certificate_check
