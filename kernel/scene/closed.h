#pragma once
// Whether the faces of a scene close up, as those of solids do.

#include <sightline/kernel/scene/scene.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace sightline {

/// The kept face that a duplicate repeats; nothing where a face is set aside for another reason.
std::optional<Face_id> face_repeated_by(const Set_aside& entry);

/// How often the file has each piece's face: once, and once more for each duplicate of it that was set aside. A
/// duplicate runs the same way round as its face. Cost: O(pieces). Exact: yes
std::vector<int> times_given(const Scene& scene);

/// The lines that the pieces' edges lie on, and whether the pieces close up.
struct Closure {
  bool closed = false;
  std::size_t lines = 0;
};

/// Whether the oriented boundary of all pieces together is zero, each as often as its face is given, so that every
/// point off the faces has a winding number. T-junctions, cracks of width zero and interpenetration are fine; a missing
/// or turned face is not, nor a doubled one, unless all around it is: nested solids may have a face in common.
/// On each line the segments of all boundaries, with sign, form a chain; it is zero iff arrivals equal departures at
/// each point of the line. Degenerate: an empty scene is closed. Cost: O(edges). Exact: yes. Proof: P-08
Closure closure(const Scene& scene);

}  // namespace sightline
