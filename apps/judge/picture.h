#pragma once
// The picture of a case that is answered wrongly.

#include "../support/common.h"

#include <sightline/harness/judge/explain.h>
#include <sightline/kernel/scene/scene.h>

#include <array>

namespace sightline::app {

/// What a face is that an answer has wrong, in a few words: one of wrong_hidden, and one of wrong_visible.
struct Wrong_words {
  std::string hidden, visible;
};
Wrong_words words_of_wrong(judge::Question question);

/// A direction in which the line that refutes is seen at length and the face in question from its front, if that can
/// be. Pre: there is a line.
std::array<double, 3> look_at_front(const Scene& scene, const judge::Explanation& why);

/// The scene from outside, from where the line that refutes is seen at length: faces that are missing, shown though
/// hidden, or right by their colours, which `words` name, the eye or the source, and the line, dashed beyond what it
/// meets. SVG, 480 x 360.
std::string picture_of(const Polygon_soup& soup, const judge::Query& query, const judge::Grade& grade,
                       const judge::Explanation& why, const Wrong_words& words);

}  // namespace sightline::app
