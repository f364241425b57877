#pragma once
// A case that is answered wrongly, as a scene to turn around.

#include "../support/common.h"
#include "picture.h"

#include <sightline/harness/judge/explain.h>

namespace sightline::app {

/// What a page's block of data holds (apps/page/README.md): the scene, the eye or the source, faces that the answer has
/// wrong in groups of their own, which `words` name - of an order the pair that the line is about -, and the line that
/// refutes it.
/// `question` is that of a command; of those that are not asked from an eye there is none. Of more than 3,000 triangles
/// the largest faces are shown; null for a scene without points. Exact: as pages are.
Json view_of(const std::string& command, const std::string& question, const Polygon_soup& soup,
             const judge::Query& query, const judge::Grade& grade, const judge::Explanation& why,
             const Wrong_words& words);

}  // namespace sightline::app
