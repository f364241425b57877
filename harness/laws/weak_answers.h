#pragma once
// Other answers about sources, held to brute force and to the search: checks of the subject `weak`, each of a share of
// scenes.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// That possibly_visible() hides what looks away and what one piece hides, by brute force in rationals, and nothing
/// else; that it hides nothing visible; and that its certificate is accepted.
Check conservative_check();

/// That events in parts of source and target that a short search left open decide what the search does.
Check settle_check();

/// That lines and events agree where one more piece lies along a segment from the source to a face: its plane is
/// across both.
Check along_check();

}  // namespace sightline::harness
