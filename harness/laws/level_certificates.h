#pragma once
// What is said of cells: the truth is accepted, and what is wrong by corners alone is refused.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness::levels_subject {

/// Of single cells for verify_level_cell(), and of all for verify_level_fill().
Outcome certificates(const Posed_scene& posed, Random& random);

}  // namespace sightline::harness::levels_subject
