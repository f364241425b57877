#pragma once
// Scenes without faces, or with none that has an area: a check of any subject.

#include <sightline/harness/laws/subject.h>

#include <functional>

namespace sightline::harness {

/// That of a scene without its faces, or with all of them flattened to points and segments, nothing is said of any
/// face, and that without a flaw. Of one scene in sixteen.
Check empty_scenes_check(std::function<Answer(const Posed_scene&)> answer);

}  // namespace sightline::harness
