#pragma once
// A check of the subject `pvs`: tables that are made in haste.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Of one scene in four with up to 12 faces: what cells see of faces and of each other, by searches of hardly any
/// cells, with events or without, until time runs out or not, in parts or not: what is decided is what a long search
/// decides, and what that sees is seen or undecided.
Check hasty_levels_check();

}  // namespace sightline::harness
