#pragma once
// What events between two convex polygons are made of: the lines of edges, and for each piece the signs with which a
// line between the polygons is blocked by it.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace sightline {

// ---- Points, planes and lines in homogeneous integers
//
// A line has Plücker coordinates (direction, moment), as pluecker_of_edge() gives them. side(a, b) = det[p, q, r, s]
// for the points p, q that a is joined from, and r, s of b.

using Homogeneous = std::array<Integer, 4>;

Exact_pluecker join(const Homogeneous& a, const Homogeneous& b);
/// The plane through a point and a line; zero where the point is on the line. Linear in the point.
Homogeneous join(const Homogeneous& x, const Exact_pluecker& e);
/// The point in which a line meets a plane; zero where it lies in it.
Homogeneous meet(const Homogeneous& h, const Exact_pluecker& e);
/// The line in which two planes meet. Bilinear.
Exact_pluecker meet(const Homogeneous& g, const Homogeneous& h);
Integer dot(const Homogeneous& a, const Homogeneous& b);
Integer side(const Exact_pluecker& a, const Exact_pluecker& b);
template <std::size_t n>
bool all_zero(const std::array<Integer, n>& a) {
  return std::all_of(a.begin(), a.end(), [](const Integer& x) { return sgn(x) == 0; });
}
/// Divided by the common factor, the last entry other than zero positive. Returns the sign that it had. Pre: not zero.
template <std::size_t n>
int make_canonical(std::array<Integer, n>& a) {
  Integer common = 0;
  int sign = 0;
  for (const Integer& x : a) {
    common = gcd(common, x);
    if (sgn(x) != 0) sign = sgn(x);
  }
  for (Integer& x : a) x = x / common * sign;
  return sign;
}
struct Less_entries {
  template <std::size_t n>
  bool operator()(const std::array<Integer, n>& a, const std::array<Integer, n>& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                        [](const Integer& x, const Integer& y) { return cmp(x, y) < 0; });
  }
};

// ---- The lines between two polygons

/// Which lines from the inside of a convex source to that of a convex target are blocked, as signs of their sides of
/// lines: of the edges, and of those in which planes of pieces meet source or target, as p is beyond such a plane iff
/// (p, q) passes the line in which it meets the source's plane on one side. Pre: the target is in front of the source's
/// plane, the source on one side of the target's; both may touch. Cost: O(n log n). Exact: yes. Proof: P-73
class Event_lines {
 public:
  struct Event_line {
    Exact_pluecker pluecker;
    bool in_source = false;             ///< in the source's plane
    bool real = false;                  ///< whether some of it is an edge that an event may touch: then all of that is
    std::array<Homogeneous, 2> hull{};  ///< between these points, in the line's direction
  };
  /// sense * side > 0
  struct Literal {
    std::uint32_t line;
    int sense;
  };
  /// A piece blocks a line iff all literals hold.
  struct Blocker {
    std::uint32_t piece;
    std::vector<Literal> literals;
  };

  /// `beside`: the side of the target's plane, 1 or -1, on which the source is. Pieces come first that are large.
  Event_lines(const Occluders& occluders, const Near_polygon& source, const Near_plane& source_plane,
              const Near_polygon& target, const Near_plane& target_plane, int beside);

  const Near_polygon& source() const { return source_; }
  const Near_polygon& target() const { return target_; }
  const Near_plane& near_source_plane() const { return near_source_plane_; }
  const Near_plane& near_target_plane() const { return near_target_plane_; }
  const Homogeneous& source_plane() const { return near_source_plane_.exact; }
  const Homogeneous& target_plane() const { return near_target_plane_.exact; }
  int beside() const { return beside_; }
  const std::vector<Event_line>& lines() const { return lines_; }
  const std::vector<Literal>& from() const { return from_; }  ///< hold iff a line leaves through the source
  const std::vector<Literal>& to() const { return to_; }      ///< hold iff it arrives within the target
  const std::vector<Blocker>& blockers() const { return blockers_; }

  /// Whether a point on a line's real part. Pre: it is on the line, and real.
  static bool in_hull(const Event_line& line, const Homogeneous& x);

 private:
  /// The line's number, the same for all edges on it.
  std::uint32_t line(Exact_pluecker pluecker);
  std::uint32_t edge(const Homogeneous& a, const Homogeneous& b);
  int sense_of(const Homogeneous& a, const Homogeneous& b, std::uint32_t number) const;
  /// Whether both points are behind the source, or both beyond the target.
  bool is_outside(const Homogeneous& a, const Homogeneous& b) const;
  /// The line in which a piece's plane meets that of the source or the target; where the piece itself crosses, an edge.
  std::uint32_t trace(const Near_polygon& polygon, const Homogeneous& plane, const Homogeneous& other);

  void add_piece(const Occluders& occluders, std::uint32_t piece);

  Near_polygon source_, target_;
  Near_plane near_source_plane_, near_target_plane_;
  int beside_;
  std::map<Exact_pluecker, std::uint32_t, Less_entries> numbers_;
  std::vector<Event_line> lines_;
  std::vector<Literal> from_, to_;
  std::vector<Blocker> blockers_;
};

}  // namespace sightline
