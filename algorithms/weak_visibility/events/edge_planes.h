#pragma once
// What events in planes are made of: planes of two edges, points in which edges meet, and planes of a vertex and an
// edge.

#include <sightline/algorithms/weak_visibility/events/event_lines.h>
#include <sightline/algorithms/weak_visibility/events/homogeneous.h>
#include <sightline/algorithms/weak_visibility/line_space.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

namespace sightline {

/// Of event lines, the edges that are real. What is left out, in doubles, holds no line from source to target. It
/// refers to the lines. Exact: yes. Proof: P-73
class Edge_planes {
 public:
  using Points = std::set<Homogeneous, Less_entries>;
  using Planes = std::set<Homogeneous, Less_entries>;
  /// Of a plane that holds two edges: these, and the points in which they meet.
  struct Flat {
    std::vector<std::uint32_t> edges;
    Points points;
  };

  /// `in_source`: whether edges in the source's plane count, with others and for vertices.
  Edge_planes(const Near_frame& frame, const Event_lines& lines, bool in_source)
      : frame_(&frame), lines_(&lines), in_source_(in_source) {}

  /// Finds flats and vertices. Returns false where there is no time. Cost: O(n^2)
  bool find(const std::function<bool()>& out_of_time);
  const std::map<Homogeneous, Flat, Less_entries>& flats() const { return flats_; }
  /// Points in which two edges meet that are not in the source's plane, with flats that hold both.
  const std::map<Homogeneous, Planes, Less_entries>& vertices() const { return vertices_; }

  /// A plane and the segment in which it meets the source. It is not usable where there is none, or where it does not
  /// meet the target.
  struct Section {
    Filtered plane;
    bool is_usable, crosses_target;
    std::array<Filtered, 2> ends;
  };
  Section section_of(const Homogeneous& plane) const;

  /// Points of a flat in which two of its edges meet, and those of other edges. `dropped`: how many of these lead from
  /// source to target by no edge of the flat.
  Points points_in(const Homogeneous& plane, const Flat& flat, std::size_t& dropped) const;
  /// Planes of a vertex and an edge. `dropped`: of how many edges no line does.
  Planes planes_through(const Filtered& vertex, std::size_t& dropped) const;

  /// In the plane of the source or behind, or beyond that of the target.
  bool leads_nowhere(const Filtered& vertex) const;
  Filtered point(const Homogeneous& exact) const { return {exact, near(*frame_, exact)}; }

 private:
  /// Not where surely no line through a point and an edge goes from the source to the target.
  bool may_pass(const Filtered& vertex, const Event_lines::Event_line& line) const;

  const Near_frame* frame_;
  const Event_lines* lines_;
  bool in_source_;
  std::map<Homogeneous, Flat, Less_entries> flats_;
  std::map<Homogeneous, Planes, Less_entries> vertices_;
};

}  // namespace sightline
