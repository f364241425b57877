#pragma once
// Checks of the subject `pvs`: which cells see each other.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That cells which a random segment joins see each other, and that all of it is symmetric.
Check segments_check();

/// That two cells by themselves see each other as the table says, with a certificate; that a sightline goes from the
/// one to the other; and that leaves see what their cells do.
Check pairs_check();

}  // namespace sightline::harness
