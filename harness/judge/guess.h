#pragma once
// What a program may do instead of what is asked: guesses, in words that say no more than what was seen.

#include <sightline/harness/judge/protocol.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sightline::judge {

/// Another question, or another way to write the answer, that a program may have in mind.
enum class Reading {
  turned,         ///< the front of a face is where it is clockwise
  other_sides,    ///< back sides count where only fronts do, or the other way round
  source_turned,  ///< weak: the source looks to its other side
  nothing_hides,  ///< see: all faces are visible that the eye is in front of
  complement,     ///< hidden faces are listed, not visible ones
  reversed,       ///< order: nearest first
  from_one,       ///< faces are counted from 1
  to_points,      ///< trace: a direction is the point that the ray goes to
  closed_start,   ///< trace: faces that hold the origin are met there
  fronts_only,    ///< trace: faces are met from the front only
  farthest,       ///< trace: the last face is named, not the first
  inside_out,     ///< boolean: fronts look inwards
  swapped,        ///< boolean: the second solid less the first
};

/// Those that make sense for a question.
std::vector<Reading> readings_of(Question question);

/// Whether an answer lists anything: one that does not supports no reading, though it be right under some.
bool lists_faces(const Answer& answer);

/// Whether an answer is right, every face of it, if it is read so. Pre: the query could be asked. Cost: that of the
/// truth. Exact: yes.
bool is_right(Reading reading, const Polygon_soup& soup, const Query& query, const Answer& answer,
              const Truth_options& options);

/// "as if the front of a face were where it is clockwise". `two_sided`: as it was asked.
std::string words_of(Reading reading, bool two_sided);

/// How a scene, moved by so many ulps of its size from where it is degenerate, is answered.
struct Neighbour {
  std::int64_t ulps;
  bool wrong;
};

/// Where a scene is answered wrongly as it is moved, and what that looks like: contact alone, a tolerance, or neither.
/// Pre: some neighbour is wrong. `exactly`: what the scene is where it is moved by nothing, as "degenerate".
std::string words_of(std::vector<Neighbour> neighbours, const std::string& exactly);

/// Of faces that are judged, concave ones and others: how many are right, and how many wrong.
struct Kinds {
  std::size_t concave_right = 0, concave_wrong = 0, convex_right = 0, convex_wrong = 0;
};
/// Empty where the wrong ones are not all of one kind, or none of the other kind was judged.
std::string words_of(const Kinds& kinds);

}  // namespace sightline::judge
