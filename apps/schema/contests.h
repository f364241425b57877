#pragma once
// What --json holds of those that ask several methods, or programs, the same questions.

#include "words.h"

namespace sightline::app::schema {

/// What `result` of compare holds, which goes by the question.
Json compare_result();

/// The members of a judgement and of a report, which are of no one scene.
Members judge_members();
Members report_members();

}  // namespace sightline::app::schema
