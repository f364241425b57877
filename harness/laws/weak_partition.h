#pragma once
// Partitions of faces by the light of a source, held to which faces the source sees.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That a face is hidden iff all of it is in umbra, of a share of small scenes; one of its faces each.
Check partition_check();

}  // namespace sightline::harness
