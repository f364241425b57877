#pragma once
// What a search leaves open: a check of the subject `weak`, of a share of scenes.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That each line that sees goes through a cell that hardly any search left open, and that events decide such cells, by
/// any bound of edges near them, as the search does.
Check open_check();

}  // namespace sightline::harness
