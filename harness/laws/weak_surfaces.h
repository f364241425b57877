#pragma once
// Surfaces of events: a check of the subject `weak`, of a share of the smallest scenes.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That each ruling of a surface goes from source to piece, and through no piece between; and that the lines that touch
/// three edges, or a corner and an edge, and are blocked by nothing are on some surface: lines through random points of
/// edges, each decided by brute force in rationals.
Check surfaces_check();

}  // namespace sightline::harness
