#pragma once
// The same questions of weak visibility asked otherwise: from both sides, in several threads, without an end: checks of
// the subject `weak`, each of a share of scenes.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That lines and events agree from both sides, proved, that no less is seen than from the front, and that threads and
/// what is told of progress change nothing; and that events that keep surfaces say the same.
Check two_sided_check();

/// That what hardly any cells and no events decided is decided by going on, as by the search.
Check rest_check();

}  // namespace sightline::harness
