#pragma once
// What `sightline fuzz` can run.

#include <sightline/harness/laws/subject.h>

namespace sightline::app {

/// The subject `io`: a scene that is written and read again is the same, in every format that can hold it.
harness::Subject io_subject();

}  // namespace sightline::app
