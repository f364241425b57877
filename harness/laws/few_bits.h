#pragma once
// Images in floats and doubles of scenes whose numbers have few bits: a check of the subject `render`.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That methods which take each sign from corners show what exact rays do off ties, and that those which cut or
/// construct do so, too, at pixels whose neighbours show the same.
Check few_bits_check();

}  // namespace sightline::harness
