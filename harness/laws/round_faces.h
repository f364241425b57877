#pragma once
// Faces of many corners against the same in triangles: a check of any subject whose labels of parts are united.

#include <sightline/harness/laws/subject.h>

#include <cstddef>
#include <functional>

namespace sightline::harness {

/// That with strictly convex polygons of up to `most_corners` among the scene's faces the answer is that with their
/// fans of triangles instead. Of one scene in `share`.
Check round_faces_check(std::function<Answer(const Posed_scene&)> answer, std::size_t most_corners, std::size_t share);

}  // namespace sightline::harness
