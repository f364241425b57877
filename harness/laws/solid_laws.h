#pragma once
// Points and rays against a BSP tree, convex parts of faces, the face graph, and closedness, held to brute force in
// rationals: checks of the subject `order`. Each asks a share of the scenes.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// The cell of a point and the faces that hold it; whether faces bound a solid, and whether the point is inside.
Check points_check();

/// The first point of a ray on a face, its face and its fragment.
Check first_hit_check();

/// The pieces of faces are convex, lie apart, and make up what the loops bound; planes hold their corners.
Check parts_check();

/// Which faces share an edge, what hangs together, where it closes up, and what is convex.
Check face_graph_check();

}  // namespace sightline::harness
